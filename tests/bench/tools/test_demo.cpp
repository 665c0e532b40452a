// The demo: what its command line accepts, and what it makes of a cloud.

#include <doctest/doctest.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "tools/demo/options.hpp"
#include "tools/demo/run.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/scene/tabletop.hpp"

namespace test_demo {
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
  CHECK(exit_code_of({"a.pcd", "--drop-zeros"}) == -1);
  CHECK(exit_code_of({"--help"}) == 0);
  CHECK(exit_code_of({"--descriptor", "intensity336"}) == -1);
  CHECK(exit_code_of({"a.pcd", "--descriptor", "cshot1344", "--normal-radius", "0.02"}) == -1);
  for (const char* radius : {"0", "-1", "nan", "inf", "1e99", "", "4cm"}) {
    CAPTURE(radius);
    CHECK(exit_code_of({"--radius", radius}) == 2);
    CHECK(exit_code_of({"--leaf", radius}) == 2);
    CHECK(exit_code_of({"--normal-radius", radius}) == 2);
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
  for (const std::string descriptor :
       {"ssh32", "ssh96", "scsh336", "scsh696", "intensity336", "shot352", "cshot1344"}) {
    CAPTURE(descriptor);
    options.descriptor = descriptor;
    const DemoResult result = run_demo(scene, options);
    CHECK(result.size == std::stoul(descriptor.substr(descriptor.find_first_of("0123456789"))));
    const bool shape_alone = descriptor == "shot352" || descriptor.substr(0, 3) == "ssh";
    CHECK(result.layout.size() == (shape_alone ? 1 : 2));
    CHECK(result.normals.size() == (descriptor.find("shot") == std::string::npos ? 0 : scene.size()));
    REQUIRE(result.keypoints.size() > 1000);
    CHECK(result.values.size() == result.keypoints.size() * result.size);
    CHECK(result.status.size() == result.keypoints.size());
    CHECK(result.neighbors.size() == result.keypoints.size());
  }
  options.descriptor = "scsh336";
  CHECK(check_searches(scene, options));
  options.descriptor = "shapecolor95";
  CHECK(check_searches(scene, options));
  options.descriptor = "scsh336";
  options.towards_camera = true;
  CHECK(check_searches(scene, options));
  for (const char* descriptor : {"cshot1344", "intensity336"}) {
    options.descriptor = descriptor;
    CHECK(check_searches(scene, options));
  }
}

TEST_CASE("the demo's compact descriptors look at the camera, and have two values for each byte in their names") {
  const RgbdCloud scene = small_scene();
  DemoOptions options;
  for (const std::string descriptor :
       {"shapecolor95", "shapecolor32", "roomcolor95", "heightshape96", "colorrings27"}) {
    CAPTURE(descriptor);
    options.descriptor = descriptor;
    options.towards_camera = false;
    const DemoResult result = run_demo(scene, options);
    CHECK(result.size == 2 * std::stoul(descriptor.substr(descriptor.find_first_of("0123456789"))));
    CHECK(result.values.size() == result.keypoints.size() * result.size);
    options.towards_camera = true;
    CHECK(run_demo(scene, options).values == result.values);
  }
}

TEST_CASE(
    "the demo's normals are the library's, within a quarter of the radius or what is asked for, on the camera's side") {
  RgbdCloud scene = small_scene();
  scene.viewpoint = {0.1f, -0.2f, -0.3f};
  const shortshot::CloudView view = view_of_cloud(scene);
  DemoOptions options;
  options.descriptor = "shot352";
  options.radius = 0.06f;
  const auto has_normals_within = [&](float radius) {
    std::vector<shortshot::SurfaceNormal> expected;
    const shortshot::GridSearch search(view, radius);
    const auto camera = shortshot::Viewpoint::towards({0.1f, -0.2f, -0.3f});
    REQUIRE(shortshot::estimate_normals(view, search, radius, camera, expected) == shortshot::Status::ok);
    const DemoResult result = run_demo(scene, options);
    REQUIRE(result.normals.size() == expected.size());
    return std::memcmp(result.normals.data(), expected.data(), expected.size() * sizeof(shortshot::SurfaceNormal)) == 0;
  };
  CHECK(has_normals_within(0.015f));
  options.normal_radius = 0.02f;
  CHECK_FALSE(has_normals_within(0.015f));
  CHECK(has_normals_within(0.02f));
}

TEST_CASE("the demo's normals are those of the cloud, where it has them and no radius is asked for") {
  RgbdCloud scene = small_scene();
  scene.normals.assign(scene.xyz.size(), 0.0f);
  for (std::size_t i = 0; i < scene.size(); ++i) scene.normals[3 * i + 2] = -1.0f;
  DemoOptions options;
  for (const char* descriptor : {"shot352", "cshot1344"}) {
    options.descriptor = descriptor;
    options.normal_radius.reset();
    const DemoResult result = run_demo(scene, options);
    CHECK(result.normals_of_file);
    REQUIRE(result.normals.size() == scene.size());
    CHECK(result.normals[7].z == -1.0f);
    options.normal_radius = 0.01f;
    const DemoResult estimated = run_demo(scene, options);
    CHECK_FALSE(estimated.normals_of_file);
    CHECK(estimated.values != result.values);
  }
  options.descriptor = "ssh96";
  CHECK(run_demo(scene, options).normals.empty());
}

TEST_CASE("the layout is told in the order of the values") {
  DemoOptions options;
  options.descriptor = "cshot1344";
  CHECK(run_demo(small_scene(), options).layout ==
        std::vector<std::string>{
            "normal cosine: 8 azimuth x 2 radial x 2 elevation cells x 11 bins, the last index fastest",
            "color distance: 8 azimuth x 2 radial x 2 elevation cells x 31 bins, the last index fastest"});
  options.descriptor = "scsh336";
  CHECK(run_demo(small_scene(), options).layout ==
        std::vector<std::string>{
            "occupancy: 8 azimuth x 4 elevation x 3 radial cells x 1 bins, the last index fastest",
            "color distance: 4 azimuth x 2 elevation x 2 radial cells x 15 bins, the last index fastest"});
  options.descriptor = "intensity336";
  CHECK(run_demo(small_scene(), options).layout ==
        std::vector<std::string>{
            "occupancy: 8 azimuth x 4 elevation x 3 radial cells x 1 bins, the last index fastest",
            "intensity: 4 azimuth x 2 elevation x 2 radial cells x 15 bins, the last index fastest"});
}

TEST_CASE("a cloud that cannot be described is refused in the library's words, with a way out") {
  RgbdCloud scene = small_scene();
  scene.rgb.clear();
  DemoOptions options;
  CHECK_THROWS_WITH(run_demo(scene, options),
                    "the descriptor needs colors and the cloud has none (--descriptor ssh96 needs none)");
  options.descriptor = "intensity336";
  CHECK_NOTHROW(run_demo(scene, options));
  scene.intensity.clear();
  CHECK_THROWS_WITH(run_demo(scene, options),
                    "the descriptor needs intensities and there are none (--descriptor ssh96 needs none)");
  options.descriptor = "ssh96";
  CHECK_NOTHROW(run_demo(scene, options));
  scene.width *= scene.height;
  scene.height = 1;
  options.search = "organized";
  CHECK_THROWS_AS(run_demo(scene, options), std::runtime_error);
  CHECK_THROWS_WITH(run_demo(RgbdCloud{}, options), "the cloud has no valid point");
}

}  // namespace test_demo
