// The library on bun0, next to what PCL computes there: the cloud of PCL's own tests of SHOT, its border included.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "bun0_facts.hpp"
#include "real_data.hpp"
#include "shortshot/shortshot.hpp"
#include "tools/golden/case.hpp"

namespace test_bun0_facts {
namespace {

namespace ss = shortshot;
namespace golden = shortshot_bench::golden;

/// The points, colors and normals of a setting.
struct Cloud {
  std::vector<float> xyz;
  std::vector<std::uint8_t> rgb;
  std::vector<ss::SurfaceNormal> normals;

  ss::CloudView view() const {
    return ss::with_normals(ss::view_xyz_rgb(xyz.data(), rgb.data(), normals.size()), normals.data());
  }
};

/// With the golden case's normals, which PCL has estimated.
Cloud golden_cloud(const golden::Case& bun0_case) {
  Cloud cloud{bun0_case.points, {}, {}};
  const std::vector<float>& normals = bun0_case.normals;
  for (std::size_t i = 0; i < bun0::golden_setting.points; ++i) {
    const ss::Rgb c = bun0::color_at(i);
    cloud.rgb.insert(cloud.rgb.end(), {c.r, c.g, c.b});
    cloud.normals.push_back({normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]});
  }
  return cloud;
}

/// With our own normals: those that PCL estimates are not part of the golden case.
Cloud pcl_cloud(const golden::Case& bun0_case) {
  Cloud cloud = golden_cloud(bun0_case);
  cloud.xyz.resize(3 * bun0::pcl_setting.points);
  cloud.rgb.resize(3 * bun0::pcl_setting.points);
  const ss::CloudView view = ss::view_xyz(cloud.xyz.data(), bun0::pcl_setting.points);
  const auto radius = ss::Radius::from_double(bun0::pcl_setting.normal_radius);
  REQUIRE(ss::estimate_normals(view, ss::GridSearch(view, radius.value), radius, ss::Viewpoint::towards({}),
                               cloud.normals) == ss::Status::ok);
  return cloud;
}

template <class D>
ss::Features<D> describe(const Cloud& cloud, const bun0::Setting& setting, const std::vector<std::size_t>& keypoints) {
  const auto radius = ss::Radius::from_double(setting.radius);
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud.view(), ss::GridSearch(cloud.view(), radius.value), keypoints, radius, features) ==
          ss::Status::ok);
  return features;
}

/// Describes all points, as key points can be any of them.
template <class D>
void check_facts(const Cloud& cloud, const bun0::Setting& setting, const std::vector<bun0::Fact>& facts) {
  std::vector<std::size_t> all(setting.points);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const ss::Features<D> features = describe<D>(cloud, setting, all);
  REQUIRE(facts.size() >= 7 * setting.keypoints.size());
  for (const bun0::Fact& fact : facts) {
    CAPTURE(fact.keypoint);
    CAPTURE(fact.entry);
    REQUIRE(features.status[fact.keypoint] == ss::Status::ok);
    const float value = features[fact.keypoint][fact.entry];
    CAPTURE(value);
    CHECK(std::abs(value - fact.value) <= 1e-5f);
  }
  for (const std::size_t lonely : setting.lonely) CHECK(features.status[lonely] == ss::Status::too_few_neighbors);

  const ss::Features<D> some = describe<D>(cloud, setting, setting.keypoints);
  for (std::size_t row = 0; row < some.size(); ++row) {
    const float* alone = some[row];
    CHECK(std::equal(alone, alone + D::size, features[setting.keypoints[row]]));
  }
}

}  // namespace

TEST_CASE("bun0: the numbers that PCL computes") {
  const std::string folder = real_data("golden/bun0");
  if (folder.empty()) return;
  const golden::Case bun0_case = golden::read_case(folder);
  const Cloud golden = golden_cloud(bun0_case);
  check_facts<ss::PclShot352>(golden, bun0::golden_setting, bun0::golden_shot352);
  check_facts<ss::PclCshot1344>(golden, bun0::golden_setting, bun0::golden_cshot1344);
}

TEST_CASE("bun0: the numbers that PCL computes in the setting of its own tests, with our normals") {
  const std::string folder = real_data("golden/bun0");
  if (folder.empty()) return;
  const Cloud cloud = pcl_cloud(golden::read_case(folder));
  check_facts<ss::PclShot352>(cloud, bun0::pcl_setting, bun0::pcl_shot352);
  check_facts<ss::PclCshot1344>(cloud, bun0::pcl_setting, bun0::pcl_cshot1344);
}

}  // namespace test_bun0_facts
