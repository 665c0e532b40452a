// Depth images in the place of clouds: what read_input() makes of them, and that match finds one in another.

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "dataset_samples.hpp"
#include "tools/input/pinhole_camera.hpp"
#include "tools/input/read_input.hpp"
#include "tools/match/match.hpp"
#include "tools/match/options.hpp"
#include "tools/match/run.hpp"
#include "tools/scene/tabletop.hpp"

namespace test_depth_images {
namespace {

using namespace dataset_test;
using namespace shortshot_bench;

constexpr auto matrix = "2 0 1\n0 4 0.5\n0 0 1\n";

InputOptions camera_of(const std::string& intrinsics, double unit = 0.001) { return {intrinsics, unit, false}; }

std::string color_png(const RgbdCloud& cloud) {
  return png(std::string(cloud.rgb.begin(), cloud.rgb.end()), cloud.width, cloud.height, 8, PngColor::rgb);
}

std::string depth_png_of(const RgbdCloud& cloud) {
  std::string samples;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float z = cloud.xyz[3 * i + 2];
    const auto count = static_cast<std::uint32_t>(std::isfinite(z) ? std::lround(5000.0f * z) : 0);
    samples += {static_cast<char>(count >> 8), static_cast<char>(count & 255)};
  }
  return png(samples, cloud.width, cloud.height, 16, PngColor::gray);
}

std::string error_of(const Folder& folder, const std::string& input, const std::string& intrinsics) {
  return error_in(folder, [&] { read_input(input, camera_of(intrinsics)); });
}

}  // namespace

TEST_CASE("a depth image becomes an organized cloud, with colors if there is an image of them") {
  const Folder folder;
  folder.add("d.png", depth_png({1000, 0, 65535, 3000, 500, 2000}, 3));
  folder.add("c,of,three.png", png(std::string(18, '\x07'), 3, 2, 8, PngColor::rgb));
  const RgbdCloud plain = read_input(folder.path("d.png"), camera_of("2,4,1,0.5"));
  CHECK(plain.width == 3);
  CHECK(plain.height == 2);
  CHECK_FALSE(plain.has_colors());
  CHECK(plain.xyz[0] == -0.5f);
  CHECK(plain.xyz[1] == -0.125f);
  CHECK(plain.xyz[2] == 1.0f);
  CHECK(std::isnan(plain.xyz[3]));
  CHECK(std::isnan(plain.xyz[6]));
  CHECK(plain.xyz[3 * 5] == 1.0f);  // 2 m away, one pixel beside the center
  folder.add("matrix.txt", matrix);
  const std::string both = folder.path("d.png") + "," + folder.path("c,of,three.png");
  const RgbdCloud colored = read_input(both, camera_of(folder.path("matrix.txt"), 0.002));
  CHECK(colored.rgb == std::vector<std::uint8_t>(18, 7));
  CHECK(colored.xyz[2] == 2.0f);
  folder.add("a,b.pcd", pcd_at(3.0f));  // a name that has a comma
  CHECK(read_input(folder.path("a,b.pcd"), {}).xyz[0] == 3.0f);
  folder.add("zeros.ply",
             "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
             "property float z\nend_header\n1 2 3\n0 0 0\n");
  InputOptions drop;
  drop.drop_zeros = true;
  const RgbdCloud rest = read_input(folder.path("zeros.ply"), drop);
  CHECK(std::isnan(rest.xyz[3]));
  CHECK(rest.notes.back() == "1 points of 0 0 0 left out");
}

TEST_CASE("images and cameras that cannot be used are named") {
  const Folder folder;
  folder.add("d.png", depth_png({1000, 0, 65535, 3000, 500, 2000}, 3));
  folder.add("torn.png", depth_png({1000, 0, 65535, 3000, 500, 2000}, 3).substr(0, 50));
  folder.add("c.png", png(std::string(18, '\x07'), 3, 2, 8, PngColor::rgb));
  folder.add("wide.png", png(std::string(18, '\x07'), 6, 1, 8, PngColor::rgb));
  const std::string d = folder.path("d.png"), good = "2,4,1,0.5";
  CHECK(error_of(folder, d, good) == "no error");
  CHECK(error_of(folder, d, "") == "SET/d.png: a depth image needs --camera FX,FY,CX,CY, its intrinsics in pixels");
  for (const char* wrong :
       {"2,4,1", "2,4,1,0.5,3", "-2,4,1,0.5", "2,0,1,0.5", "nan,4,1,0.5", "2,4,1,inf", "none.txt"}) {
    CHECK(error_of(folder, d, wrong).find(std::string("--camera ") + wrong + ": expected FX,FY,CX,CY") == 0);
  }
  CHECK(error_of(folder, folder.path("c.png"), good) ==
        "SET/c.png: expected a depth image of one channel of 16 bits, found another image");
  CHECK(error_of(folder, folder.path("torn.png"), good).find("SET/torn.png: expected a depth image") == 0);
  CHECK(error_of(folder, d + "," + folder.path("wide.png"), good) ==
        "SET/d.png: expected the color image's 6 x 1 pixels, found 3 x 2");
  CHECK(error_of(folder, d + "," + folder.path("none.png"), good) ==
        "SET/none.png: expected a color image, found no file of this name");
  CHECK(error_of(folder, folder.path("none.png") + "," + d, good) ==
        "SET/none.png: expected a depth image, found no file of this name");
}

TEST_CASE("no tool writes over what it reads") {
  const Folder folder;
  folder.add("d,1.png", depth_png({1000, 0, 65535, 3000, 500, 2000}, 3));
  folder.add("c.png", png(std::string(18, '\x07'), 3, 2, 8, PngColor::rgb));
  const std::string both = folder.path("d,1.png") + "," + folder.path("c.png");
  CHECK(read_input(both, camera_of("2,4,1,0.5")).has_colors());
  for (const char* name : {"d,1.png", "c.png"}) {
    CHECK(error_in(folder, [&] { keep_input(both, folder.path(name)); }) ==
          std::string("SET/") + name + ": writing this file would destroy what is read");
  }
  CHECK(error_in(folder, [&] { keep_input(both, folder.path("new.png")); }) == "no error");
  MatchCommand command;
  command.clouds = {both, both};
  command.input = camera_of("2,4,1,0.5");
  command.out = folder.path("c");
  CHECK(error_in(folder, [&] { run_match(command); }) == "SET/c.png: writing this file would destroy what is read");
}

TEST_CASE("a view of a scene is found in another one, both given as images") {
  const Folder folder;
  TabletopOptions options;
  options.width = 320;
  options.height = 240;
  RgbdCloud clouds[2];
  for (int i = 0; i < 2; ++i) {
    options.turn = 0.25 * i;
    const RgbdCloud scene = make_tabletop(options);
    folder.add("d.png", depth_png_of(scene));
    folder.add("c.png", color_png(scene));
    clouds[i] =
        read_input(folder.path("d.png") + "," + folder.path("c.png"), camera_of("262.5,262.5,159.5,119.5", 0.0002));
  }
  const MatchResult result = match_clouds(clouds[0], clouds[1], {});
  CHECK(result.is_found);
  CHECK(degrees_of(result.pose) == doctest::Approx(std::atan2(0.25, 0.75) * 57.29578).epsilon(0.02));
}

}  // namespace test_depth_images
