// The readers on the real recordings, where they are there.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>

#include "paper/datasets/pair_sets.hpp"
#include "real_data.hpp"
#include "tools/labels/view_sets.hpp"

namespace test_datasets {
namespace {

using namespace shortshot_bench::datasets;
using shortshot_bench::RgbdCloud;

bool has_point_within(const RgbdCloud& cloud, const std::array<double, 3>& place, double distance) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    double square = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double difference = static_cast<double>(cloud.xyz[3 * i + axis]) - place[axis];
      square += difference * difference;
    }
    if (square <= distance * distance) return true;  // a missing point is NaN, and not near
  }
  return false;
}

// The share of the source's points, a few hundred of them, that the motion brings to within `distance` meters of the
// target.
double overlap(const ViewPair& pair, double distance) {
  std::size_t valid = 0;
  std::size_t near = 0;
  for (std::size_t i = 0; i < pair.source.size(); i += 1 + pair.source.size() / 300) {
    const float* p = &pair.source.xyz[3 * i];
    if (std::isnan(p[2])) continue;
    std::array<double, 3> moved{};
    for (std::size_t row = 0; row < 3; ++row) {
      const double* t = &pair.truth[4 * row];
      moved[row] =
          t[0] * static_cast<double>(p[0]) + t[1] * static_cast<double>(p[1]) + t[2] * static_cast<double>(p[2]) + t[3];
    }
    ++valid;
    near += has_point_within(pair.target, moved, distance) ? 1 : 0;
  }
  return static_cast<double>(near) / static_cast<double>(valid);
}

// The pair that a motion in the wrong direction would miss the most.
std::size_t widest(const PairSet& set) {
  const auto& angles = set.rotation_deg;
  return static_cast<std::size_t>(std::max_element(angles.begin(), angles.end()) - angles.begin());
}

}  // namespace

TEST_CASE("real Kinect pairs: the true motion brings the source onto the target") {
  const std::string directory = real_data("data/kinect_tombari");
  if (directory.empty()) return;
  const auto sets = open_pair_sets(directory);
  REQUIRE(sets.size() == 2);
  CHECK(sets[0].size() == 17);
  CHECK(sets[1].size() == 30);
  const ViewPair scene = sets[0].load(0);
  CHECK(scene.source.has_colors());
  CHECK(overlap(scene, 0.01) >= 0.5);
  const ViewPair views = sets[1].load(widest(sets[1]));
  CHECK(views.rotation_deg > 45.0);
  CHECK(overlap(views, 0.01) >= 0.5);
}

TEST_CASE("real RGB-D frames: the true motion brings the one onto the other") {
  const std::string directory = real_data("data/redkitchen_rgbd");
  if (directory.empty()) return;
  const auto sets = open_pair_sets(directory);
  REQUIRE(sets.size() == 1);
  CHECK(sets[0].size() == 153);
  const ViewPair pair = sets[0].load(widest(sets[0]));
  CHECK(pair.source.width == 640);
  CHECK(pair.source.height == 480);
  CHECK(overlap(pair, 0.05) >= 0.25);  // the pairs were chosen for 0.3
}

TEST_CASE("real labeled views") {
  const std::string directory = real_data("data/mosd_object_views");
  if (directory.empty()) return;
  const auto sets = open_view_sets(directory);
  REQUIRE(sets.size() == 1);
  CHECK(sets[0].views.size() == 77);
  std::set<std::string> classes;
  std::set<std::string> instances;
  for (const LabeledView& view : sets[0].views) {
    classes.insert(view.object_class);
    instances.insert(view.instance);
    CHECK(view.is_training != view.is_test);
  }
  CHECK(classes.size() == 4);
  CHECK(instances.size() == 14);
  for (std::size_t i = 0; i < 77; i += 19) CHECK(sets[0].load(i).size() > 2000);
}

TEST_CASE("real W-RGB-D clouds: y is the depth axis, the camera in the origin") {
  const std::string directory = real_data("data/wrgbd_samples");
  if (directory.empty()) return;
  const auto sets = open_view_sets(directory);
  REQUIRE(sets.size() == 1);
  REQUIRE(sets[0].views.size() == 2);
  CHECK(sets[0].views[0].instance == "apple_1");
  CHECK(sets[0].views[1].instance == "banana_1");
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(sets[0].views[i].is_training);
    const RgbdCloud cloud = sets[0].load(i);
    CHECK(cloud.size() > 3000);
    CHECK(cloud.viewpoint == std::array<float, 3>{0, 0, 0});
    for (std::size_t p = 0; p < cloud.size(); p += 100) CHECK(cloud.xyz[3 * p + 1] > 0.5F);
  }
}

}  // namespace test_datasets
