// Pairs of RGB-D frames, on folders that are made here.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "dataset_samples.hpp"
#include "paper/datasets/pair_sets.hpp"
#include "tools/input/image.hpp"

namespace test_datasets_frames {
namespace {

using namespace dataset_test;
using shortshot_bench::read_color_image;
using shortshot_bench::read_depth_image;
using shortshot_bench::RgbdCloud;
using shortshot_bench::datasets::open_pair_sets;
using shortshot_bench::datasets::PairSet;
using shortshot_bench::datasets::ViewPair;

constexpr auto intrinsics = "2.0e+00 0 1\n0 4 0.5\n0 0 1\n";

// 3 x 2 pixels of 8 bits, each channel of each another value.
std::string png8(PngColor color) {
  std::string samples;
  for (int i = 0; i < (color == PngColor::rgb ? 18 : 6); ++i) samples += static_cast<char>(10 * i);
  return png(samples, 3, 2, 8, color);
}

// Two frames; the camera of b stands half a meter along x from a's and looks along its own z, a quarter turn about z.
void add_frames(const Folder& folder) {
  folder.add("frame_pairs.csv", "frame_a,frame_b,overlap\na,b,1.0\na,a,1.0\n");
  folder.add("camera-intrinsics.txt", intrinsics);
  folder.add("a.depth.png", depth_png({1000, 0, 65535, 3000, 3001, 500}, 3));
  folder.add("b.depth.png", depth_png({1000, 1000, 1000, 1000, 1000, 1000}, 3));
  folder.add("a.pose.txt", no_motion());
  folder.add("b.pose.txt", quarter_turn());
  folder.add("a.color.jpg", gray_jpeg(3, 2));
  folder.add("b.color.png", png8(PngColor::rgb));
}

std::string error_of_loading(const Folder& folder) {
  return error_in(folder, [&] { open_pair_sets(folder.path()).front().load(0); });
}

std::array<float, 3> point(const RgbdCloud& cloud, std::size_t i) {
  return {cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]};
}

bool is_missing(const RgbdCloud& cloud, std::size_t i) {
  const auto p = point(cloud, i);
  return std::isnan(p[0]) && std::isnan(p[1]) && std::isnan(p[2]);
}

}  // namespace

TEST_CASE("frames are back-projected into organized clouds with all their colors") {
  const Folder folder;
  add_frames(folder);
  const auto sets = open_pair_sets(folder.path());
  REQUIRE(sets.size() == 1);
  CHECK(sets[0].name == "frames");
  CHECK(sets[0].has_color);
  CHECK(sets[0].pair_names == std::vector<std::string>{"a b", "a a"});
  CHECK(sets[0].groups == std::vector<std::string>{"a", "a"});
  const ViewPair pair = sets[0].load(0);
  const RgbdCloud& cloud = pair.source;
  CHECK(cloud.width == 3);
  CHECK(cloud.height == 2);
  REQUIRE(cloud.size() == 6);
  CHECK(point(cloud, 0) == std::array<float, 3>{-0.5F, -0.125F, 1.0F});  // (0 - 1) / 2 and (0 - 0.5) / 4
  CHECK(is_missing(cloud, 1));
  CHECK(is_missing(cloud, 2));
  CHECK(point(cloud, 3) == std::array<float, 3>{-1.5F, 0.375F, 3.0F});
  CHECK(is_missing(cloud, 4));
  CHECK(point(cloud, 5) == std::array<float, 3>{0.25F, 0.0625F, 0.5F});
  CHECK(cloud.rgb == std::vector<std::uint8_t>(18, 128));
  CHECK(pair.target.rgb[17] == 170);
}

TEST_CASE("the largest depth is an option") {
  const Folder folder;
  add_frames(folder);
  const RgbdCloud near = open_pair_sets(folder.path(), 0.75).front().load(0).source;
  CHECK(is_missing(near, 0));
  CHECK_FALSE(is_missing(near, 5));
  const RgbdCloud far = open_pair_sets(folder.path(), 10.0).front().load(0).source;
  CHECK(point(far, 4)[2] == 3.001F);
}

TEST_CASE("the true motion leads from frame a's camera to frame b's") {
  const Folder folder;
  add_frames(folder);
  const PairSet set = open_pair_sets(folder.path()).front();
  CHECK(set.rotation_deg[0] == doctest::Approx(90.0));
  CHECK(set.rotation_deg[1] == doctest::Approx(0.0));
  const auto truth = set.load(0).truth;
  // The inverse of the quarter turn: (x, y, z) -> (y, -(x - 0.5), z).
  const std::array<double, 16> expected{0, 1, 0, 0, -1, 0, 0, 0.5, 0, 0, 1, 0, 0, 0, 0, 1};
  for (std::size_t i = 0; i < 16; ++i) CHECK(truth[i] == doctest::Approx(expected[i]));
}

TEST_CASE("pairs are loaded from many threads at once") {
  const Folder folder;
  add_frames(folder);
  const PairSet set = open_pair_sets(folder.path()).front();
  std::array<std::vector<std::uint8_t>, 4> colors;
  std::vector<std::thread> threads;
  for (auto& loaded : colors) {
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) loaded = set.load(0).target.rgb;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& loaded : colors) CHECK(loaded == set.load(0).target.rgb);
}

TEST_CASE("broken frames are refused by the file's name") {
  const Folder folder;
  add_frames(folder);
  folder.add("b.depth.png", depth_png({1, 2, 3, 4}, 2));
  CHECK(error_of_loading(folder) == "SET/b.depth.png: expected the color image's 3 x 2 pixels, found 2 x 2");
  folder.add("b.depth.png", png8(PngColor::gray));
  const std::string not_depth =
      "SET/b.depth.png: expected a depth image of one channel of 16 bits, found another image";
  CHECK(error_of_loading(folder) == not_depth);
  folder.add("b.depth.png", png8(PngColor::rgb));
  CHECK(error_of_loading(folder) == not_depth);
  folder.add("b.depth.png", depth_png({1, 2, 3, 4, 5, 6}, 3).substr(0, 60));
  CHECK(error_of_loading(folder).rfind("SET/b.depth.png: expected a depth image, found: ", 0) == 0);
  folder.remove("b.depth.png");
  CHECK(error_of_loading(folder) ==
        "SET/b.depth.png: expected a cloud's file, found no file of this name; 1 of 4 are missing");
  folder.add("b.depth.png", depth_png({1, 2, 3, 4, 5, 6}, 3));
  folder.add("a.color.jpg", "no image");
  CHECK(error_of_loading(folder).rfind("SET/a.color.jpg: expected a color image, found: ", 0) == 0);
  folder.remove("a.color.jpg");
  CHECK(error_of_loading(folder) ==
        "SET/a.color.png: expected a cloud's file, found no file of this name; 1 of 4 are missing");
  folder.add("b.pose.txt", "1 0 0\n");
  CHECK(error_of_loading(folder) ==
        "SET/b.pose.txt:1: expected 4 rows of 4 numbers for a rigid motion, found another one of 3");
}

TEST_CASE("an image that claims more pixels than any camera has is refused before it is read") {
  const Folder folder;
  std::string huge = depth_png({0}, 1);
  huge.replace(16, 8, big_endian(16384) + big_endian(8192));
  folder.add("huge.png", huge);
  const std::string expected = "SET/huge.png: expected at most 2^26 pixels, found 134217728";
  CHECK(error_in(folder, [&] { read_depth_image(folder.path("huge.png")); }) == expected);
  CHECK(error_in(folder, [&] { read_color_image(folder.path("huge.png")); }) == expected);
}

TEST_CASE("what is no camera matrix is refused") {
  const auto error_of_matrix = [](const std::string& matrix) {
    const Folder folder;
    add_frames(folder);
    folder.add("camera-intrinsics.txt", matrix);
    return error_of_loading(folder);
  };
  const std::string file = "SET/camera-intrinsics.txt: ";
  CHECK(error_of_matrix(intrinsics) == "no error");
  CHECK(error_of_matrix("0 0 1\n0 4 0.5\n0 0 1\n") == file + "expected focal lengths above 0");
  CHECK(error_of_matrix("2 0.1 1\n0 4 0.5\n0 0 1\n") == file + "expected the rows fx 0 cx, 0 fy cy, 0 0 1");
  CHECK(error_of_matrix("2 0 1\n0 4 0.5\n0 0 2\n") == file + "expected the rows fx 0 cx, 0 fy cy, 0 0 1");
  CHECK(error_of_matrix("2 0 1\n0 4 inf\n") ==
        "SET/camera-intrinsics.txt:2: expected finite numbers for a camera matrix, found 'inf'");
}

}  // namespace test_datasets_frames
