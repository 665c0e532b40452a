// The demo: what its command line accepts, and what it makes of a cloud.

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "demo/options.hpp"
#include "demo/run.hpp"
#include "scene/tabletop.hpp"

namespace {

using namespace shortshot_bench;

/// The exit code of a command line, or -1 if the demo would go on.
int exit_code_of(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "demo");
  DemoOptions options;
  int exit_code = -2;
  return parse_options(static_cast<int>(arguments.size()), arguments.data(), options, exit_code) ? -1 : exit_code;
}

RgbdCloud small_scene() {
  TabletopOptions options;
  options.width = 160;
  options.height = 120;
  return make_tabletop(options);
}

}  // namespace

TEST_CASE("the demo's command line: good ones go on, help ends well, bad ones end with 2") {
  CHECK(exit_code_of({}) == -1);
  CHECK(exit_code_of({"a.pcd", "b.ply", "--descriptor", "ssh32", "--radius", "0.1", "--threads", "2"}) == -1);
  CHECK(exit_code_of({"a.pcd", "--out", "x.npy", "--search", "brute", "--check", "--towards-camera"}) == -1);
  CHECK(exit_code_of({"--help"}) == 0);
  for (const char* radius : {"0", "-1", "nan", "inf", "1e99", "", "4cm"}) {
    CAPTURE(radius);
    CHECK(exit_code_of({"--radius", radius}) == 2);
    CHECK(exit_code_of({"--leaf", radius}) == 2);
  }
  CHECK(exit_code_of({"--descriptor", "sift"}) == 2);
  CHECK(exit_code_of({"--search", "magic"}) == 2);
  CHECK(exit_code_of({"--threads", "0"}) == 2);
  CHECK(exit_code_of({"--threads", "-3"}) == 2);
  CHECK(exit_code_of({"--out", "x.txt"}) == 2);
  CHECK(exit_code_of({"a.pcd", "b.pcd", "--out", "x.npy"}) == 2);
  CHECK(exit_code_of({"--no-such-option"}) == 2);
}

TEST_CASE("the demo describes the generated scene, and every search and thread count gives the same bits") {
  const RgbdCloud scene = small_scene();
  DemoOptions options;
  for (const char* descriptor : {"ssh32", "ssh96", "scsh336", "scsh696"}) {
    options.descriptor = descriptor;
    const DemoResult result = run_demo(scene, options);
    CHECK(result.size == std::stoul(std::string(descriptor).substr(result.layout.size() == 2 ? 4 : 3)));
    REQUIRE(result.keypoints.size() > 1000);
    CHECK(result.values.size() == result.keypoints.size() * result.size);
    CHECK(result.status.size() == result.keypoints.size());
    CHECK(result.neighbors.size() == result.keypoints.size());
  }
  options.descriptor = "scsh336";
  CHECK(check_searches(scene, options));
  options.towards_camera = true;
  CHECK(check_searches(scene, options));
}

TEST_CASE("a cloud that cannot be described is refused in the library's words, with a way out") {
  RgbdCloud scene = small_scene();
  scene.rgb.clear();
  DemoOptions options;
  CHECK_THROWS_WITH(run_demo(scene, options),
                    "the descriptor needs colours and the cloud has none (--descriptor ssh96 needs none)");
  options.descriptor = "ssh96";
  CHECK_NOTHROW(run_demo(scene, options));
  scene.width *= scene.height;
  scene.height = 1;
  options.search = "organized";
  CHECK_THROWS_AS(run_demo(scene, options), std::runtime_error);
  CHECK_THROWS_WITH(run_demo(RgbdCloud{}, options), "the cloud has no valid point");
}
