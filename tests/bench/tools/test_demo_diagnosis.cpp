// The demo's --diagnose: each number that cannot work gets a sentence, and a sound cloud gets none.

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "tools/demo/advice.hpp"
#include "tools/demo/diagnose.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/scene/tabletop.hpp"

namespace test_demo_diagnosis {
namespace {

using namespace shortshot_bench;

RgbdCloud small_scene() {
  TabletopOptions options;
  options.width = 320;
  options.height = 240;
  return make_tabletop(options);
}

RgbdCloud scaled(RgbdCloud cloud, float scale, float shift = 0.0f) {
  for (float& v : cloud.xyz) v = scale * v + shift;
  return cloud;
}

/// All advice, in lines.
std::string advice_of(const RgbdCloud& cloud, const DemoOptions& options = {}) {
  std::string lines;
  for (const std::string& line : advice_on(diagnosis_of(cloud, options), view_of_cloud(cloud), options)) {
    lines += line + "\n";
  }
  return lines;
}

bool says(const std::string& lines, const std::string& part) {
  CAPTURE(lines);
  return lines.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("diagnosis: nothing is wrong with the generated scene, but with what is done to it") {
  const RgbdCloud scene = small_scene();
  CHECK(advice_of(scene) == "");
  CHECK(print_diagnosis(scene, {}));

  const std::string millimeters = advice_of(scaled(scene, 1000.0f));
  CHECK(says(millimeters, "most likely millimeters"));
  CHECK(says(millimeters, "--radius 40 --leaf 20"));
  CHECK_FALSE(print_diagnosis(scaled(scene, 1000.0f), {}));

  CHECK(says(advice_of(scaled(scene, 1.0f, 5.4e6f)), "Subtract an origin"));
  CHECK(says(advice_of(scaled(scene, 1e25f)), "no coordinates"));
  CHECK(says(advice_of(scaled(scene, 10.0f)), "too small for points"));

  RgbdCloud zeros = scene;
  for (std::size_t i = 0; i < zeros.xyz.size(); i += 30) zeros.xyz[i] = zeros.xyz[i + 1] = zeros.xyz[i + 2] = 0.0f;
  CHECK(says(advice_of(zeros), "are (0, 0, 0)"));

  RgbdCloud gray = scene;
  gray.rgb.assign(gray.rgb.size(), 128);
  CHECK(says(advice_of(gray), "the same color"));

  RgbdCloud twice = scene;
  twice.xyz.insert(twice.xyz.end(), scene.xyz.begin(), scene.xyz.end());
  twice.rgb.insert(twice.rgb.end(), scene.rgb.begin(), scene.rgb.end());
  twice.intensity.clear();
  twice.width = twice.size();
  twice.height = 1;
  CHECK(says(advice_of(twice), "exactly on another one"));

  RgbdCloud nothing = scene;
  nothing.xyz.assign(nothing.xyz.size(), std::numeric_limits<float>::quiet_NaN());
  CHECK(says(advice_of(nothing), "no valid point"));
}

TEST_CASE("diagnosis: options that do not fit the points") {
  const RgbdCloud scene = small_scene();
  DemoOptions options;
  options.leaf = 1e-4f;
  CHECK(says(advice_of(scene, options), "every point is a key point"));
  options = {};
  options.descriptor = "shot352";
  options.normal_radius = 0.002f;
  CHECK(says(advice_of(scene, options), "--normal-radius"));
  options = {};
  options.radius = 0.018f;
  CHECK(says(advice_of(scene, options), "take a larger radius"));
}

TEST_CASE("diagnosis: what is suggested is said as options") {
  shortshot::Suggestion suggested{};
  suggested.status = shortshot::Status::empty_cloud;
  CHECK(fitting_options(suggested).empty());
  suggested = {shortshot::Status::ok, 0.04f, 0.02f, 0.01f, 0.002f, 1.0f};
  CHECK(fitting_options(suggested) == "--radius 0.04 --leaf 0.02 --normal-radius 0.01");
}

TEST_CASE("diagnosis: normals of another length, and key points off the surface") {
  shortshot::Diagnosis d{};
  const float point[3] = {};
  const shortshot::SurfaceNormal normal{0.0f, 0.0f, 6.0f};
  const shortshot::CloudView view = shortshot::with_normals(shortshot::view_xyz(point, 1), &normal);
  d.other_length = 1.0f;
  d.off_surface = 3;
  const std::vector<std::string> advice = advice_on(d, view, {});
  REQUIRE(advice.size() == 2);
  CHECK(says(advice[0], "not of length 1"));
  CHECK(says(advice[1], "3 key points"));
}

}  // namespace test_demo_diagnosis
