// Files as people really have them, tests/bench/clouds: each is read as it is meant, and what is not is said.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cloud_file_samples.hpp"
#include "note_of.hpp"
#include "tools/demo/hints.hpp"
#include "tools/demo/run.hpp"
#include "tools/io/repeated_points.hpp"

namespace test_cloud_file_cases {

using namespace shortshot_bench;
using cloud_file_test::note_of;
using Strings = std::vector<std::string>;

namespace {

RgbdCloud cloud_of(const std::string& name) {
  return read_cloud(std::string(SHORTSHOT_TEST_DATA) + "/../bench/clouds/" + name);
}

std::size_t described(const RgbdCloud& cloud, const std::string& descriptor) {
  DemoOptions options;
  options.descriptor = descriptor;
  const DemoResult result = run_demo(cloud, options);
  return static_cast<std::size_t>(std::count(result.status.begin(), result.status.end(), shortshot::Status::ok));
}

using Rgb = std::vector<std::uint8_t>;
Rgb first_color(const RgbdCloud& cloud) {
  REQUIRE(cloud.has_colors());
  return {cloud.rgb.begin(), cloud.rgb.begin() + 3};
}

}  // namespace

TEST_CASE("cloud cases: colors of doubles under capital names") {
  const RgbdCloud cloud = cloud_of("pdal_f8_rgb.pcd");
  CHECK(first_color(cloud) == Rgb{149, 87, 62});
  CHECK(cloud.has_intensities());
  CHECK(note_of(cloud, "colors") == "colors are Red Green Blue, F8: taken as 0 to 255, as the largest is 170");
  CHECK(note_of(cloud, "intensities") == "intensities are Intensity");
  CHECK(described(cloud, "scsh336") == 88);
}

TEST_CASE("cloud cases: float colors of 0 to 255") {
  const RgbdCloud cloud = cloud_of("float_colors_255.ply");
  CHECK(first_color(cloud) == Rgb{149, 87, 62});
  CHECK(note_of(cloud, "colors") == "colors are red green blue, F4: taken as 0 to 255, as the largest is 170");
}

TEST_CASE("cloud cases: a packed color in a double leaves the points alone") {
  const RgbdCloud cloud = cloud_of("all_size8_rgb.pcd");
  CHECK(cloud.size() == 1600);
  CHECK_FALSE(cloud.has_colors());
  CHECK(note_of(cloud, "ignored").find("rgb (F8: a packed color has 4 bytes") != std::string::npos);
  CHECK(described(cloud, "ssh96") == 88);
}

TEST_CASE("cloud cases: normals of the file, of unit length or made so") {
  const RgbdCloud unit = cloud_of("with_normals.pcd");
  REQUIRE(unit.normals.size() == 3 * unit.size());
  CHECK(unit.notes ==
        Strings{"normals are normal_x normal_y normal_z", "all points have one normal", "ignored: curvature"});
  const RgbdCloud cloud = cloud_of("meshlab_long_normals.ply");
  REQUIRE(cloud.normals.size() == 3 * cloud.size());
  CHECK(cloud.normals[0] == doctest::Approx(3.93 / 6.27).epsilon(0.01));
  CHECK(std::hypot(cloud.normals[0], cloud.normals[1], cloud.normals[2]) == doctest::Approx(1));
  CHECK(note_of(cloud, "normals") ==
        "normals are nx ny nz, 1600 of them made unit length (they are 6.27 to 6.27 long)");
  CHECK(note_of(cloud, "all points") == "all points have one normal");
  CHECK(note_of(cloud, "ignored") == "ignored: alpha; elements face (2)");
}

TEST_CASE("cloud cases: doubles far from the origin") {
  const RgbdCloud cloud = cloud_of("utm_double.ply");
  CHECK(cloud.origin == std::array<double, 3>{465123, 5412346, 0});
  CHECK(cloud.xyz[0] == 0.17F);
  CHECK(cloud.xyz[2] == 0.8005F);
  CHECK(cloud.viewpoint == std::array<float, 3>{-465123, -5412346, 0});
  CHECK(note_of(cloud, "origin") == "origin 465123 5412346 0 subtracted: floats are 0.5 apart out there");
  CHECK(note_of(cloud, "the viewpoint is 0 0 0, far away") != "");
  CHECK(described(cloud, "scsh336") > 80);
}

TEST_CASE("cloud cases: zeros for what was not measured are named, and can be left out") {
  RgbdCloud cloud = cloud_of("zeros_for_invalid.ply");
  CHECK(note_of(cloud, "1600 of 3200") ==
        "1600 of 3200 points (50 %) are 0 0 0, which often means \"no measurement\": --drop-zeros leaves them out");
  CHECK(drop_zeros(cloud) == 1600);
  CHECK(std::count_if(cloud.xyz.begin(), cloud.xyz.end(), [](float v) { return std::isnan(v); }) == 4800);
  CHECK(count_zeros(cloud) == 0);
  CHECK(described(cloud, "scsh336") == 88);
}

TEST_CASE("cloud cases: millimeters") {
  DemoOptions options;
  const RgbdCloud cloud = cloud_of("millimeters.ply");
  const auto hints_of = [&] { return hints(cloud, options, run_demo(cloud, options)); };
  Strings hint = hints_of();
  REQUIRE(hint.size() == 1);
  CHECK(hint[0].find("most likely millimeters and the radius meters (--radius 40 --leaf 20") != std::string::npos);
  options.radius = 40;
  options.leaf = 20;
  CHECK(hints_of().empty());
  options.radius = 1000;
  hint = hints_of();
  REQUIRE_FALSE(hint.empty());
  CHECK(hint[0].find("all of the cloud, 1.6e+02 large, is within the radius") != std::string::npos);
}

TEST_CASE("cloud cases: line ends of LF CR, a byte order mark, a blank behind the first word, capitals, old NaNs") {
  const RgbdCloud cloud = cloud_of("lfcr_binary.ply");
  CHECK(cloud.xyz[0] == -0.08F);
  CHECK(first_color(cloud) == Rgb{149, 87, 62});
  for (const char* name : {"bom.ply", "data_uppercase.pcd"}) {
    const RgbdCloud text = cloud_of(name);
    REQUIRE(text.size() == cloud.size());
    CHECK(static_cast<double>(text.xyz[4799]) == doctest::Approx(static_cast<double>(cloud.xyz[4799])));
  }
  CHECK(first_color(cloud_of("trailing_space_first.ply")) == Rgb{0, 0, 90});
  const RgbdCloud old = cloud_of("nan_msvc_old.pcd");
  CHECK(old.size() == 1603);
  CHECK(std::count_if(old.xyz.begin(), old.xyz.end(), [](float v) { return !std::isfinite(v); }) == 9);
  for (const RgbdCloud& silent : {cloud, old}) CHECK(silent.notes == Strings{});
}

TEST_CASE("cloud cases: a range grid") {
  const RgbdCloud cloud = cloud_of("range_grid.ply");
  CHECK(cloud.width == 20);
  CHECK(cloud.height == 20);
  CHECK(cloud.notes == Strings{"organized by its range grid, 20 x 20"});
}

}  // namespace test_cloud_file_cases
