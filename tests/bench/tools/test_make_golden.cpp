// The golden vectors of the compact descriptors: the committed files are what their oracle makes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cloud_file_samples.hpp"
#include "golden_case_copy.hpp"
#include "tools/golden/case.hpp"
#include "tools/make_golden/clouds.hpp"
#include "tools/make_golden/rows.hpp"
#include "tools/make_golden/write_case.hpp"

namespace test_make_golden {
namespace {

using namespace shortshot_bench::make_golden;
using cloud_file_test::read_bytes;
using golden_test::test_data;

// Largest difference of numbers; a NaN is equal to a NaN, and infinitely far from all else.
template <class Value>
double largest_difference(const std::vector<float>& committed, const std::vector<Value>& made) {
  if (committed.size() != made.size()) return HUGE_VAL;
  double largest = 0.0;
  for (std::size_t i = 0; i < made.size(); ++i) {
    const double a = static_cast<double>(committed[i]), b = static_cast<double>(made[i]);
    if (std::isnan(a) && std::isnan(b)) continue;
    largest = std::max(largest, std::isnan(a - b) ? HUGE_VAL : std::fabs(a - b));
  }
  return largest;
}

}  // namespace

TEST_CASE("make_golden: clouds and lists are the committed ones, byte for byte") {
  const cloud_file_test::TemporaryDirectory directory;
  for (const Cloud& cloud : make_clouds()) {
    CAPTURE(cloud.name);
    const std::string made = directory.file(cloud.name);
    const Frames frames = make_frames(cloud);
    write_case(made, cloud, frames, make_rows(cloud, frames.axes));
    std::size_t files = 0;
    for (const auto& file : std::filesystem::directory_iterator(made)) {
      const std::string name = file.path().filename().string();
      CAPTURE(name);
      const std::string committed = read_bytes(test_data + "/" + cloud.name + "/" + name);
      CHECK(committed.size() == std::filesystem::file_size(file));
      for (const char* exact : {"case.json", "points.bin", "rgb.bin", "keypoints.bin", "neighbor_count.bin"}) {
        if (name == exact) CHECK(committed == read_bytes(file.path().string()));
      }
      ++files;
    }
    CHECK(files == 16);
  }
}

TEST_CASE("make_golden: frames and rows are the oracle's, as near as libraries' roots and eigenvectors are") {
  for (const Cloud& cloud : make_clouds()) {
    CAPTURE(cloud.name);
    const shortshot_bench::golden::Case committed = shortshot_bench::golden::read_case(test_data + "/" + cloud.name);
    CHECK(largest_difference(committed.frames, make_frames(cloud).axes) <= 1e-6);
    for (const Rows& rows : make_rows(cloud, committed.frames)) {
      CAPTURE(rows.name);
      const auto* values = committed.find(rows.name);
      const auto* nibbles = committed.find(rows.name + "_nibbles");
      REQUIRE(values != nullptr);
      REQUIRE(nibbles != nullptr);
      CHECK(largest_difference(floats_of(*values), rows.values) <= 1e-7);
      CHECK(bytes_of(*nibbles) == rows.nibbles);
    }
  }
}

}  // namespace test_make_golden
