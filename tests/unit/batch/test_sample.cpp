// sample_uniform(): one key point per voxel, the one nearest to its center; sample_centroids(): the mean of its points.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

#include "fixtures.hpp"

namespace test_sample {
namespace {

using namespace unit;
using ss::Status;

std::vector<std::uint32_t> sampled(const TestCloud& cloud, float leaf) {
  std::vector<std::uint32_t> keypoints{99};
  REQUIRE(ss::sample_uniform(cloud.view(), leaf, keypoints) == Status::ok);
  return keypoints;
}

/// By definition, in double; exact for a cloud and a leaf of powers of two.
std::vector<std::uint32_t> expected_sample(const TestCloud& cloud, double leaf) {
  using Voxel = std::tuple<double, double, double>;
  std::map<Voxel, std::pair<double, std::uint32_t>> best;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const ss::Point p = cloud.at(i);
    if (!ss::is_finite(p)) continue;
    double d2 = 0.0;
    const auto voxel = [&d2, leaf](float v) {
      const double position = static_cast<double>(v) / leaf;
      const double number = std::floor(position);
      d2 += (position - number - 0.5) * (position - number - 0.5);
      return number;
    };
    const double x = voxel(p.x), y = voxel(p.y), z = voxel(p.z);
    const std::pair<double, std::uint32_t> candidate{d2, static_cast<std::uint32_t>(i)};
    const auto place = best.emplace(Voxel{x, y, z}, candidate).first;
    place->second = std::min(place->second, candidate);
  }
  std::vector<std::uint32_t> indices;
  for (const auto& each : best) indices.push_back(each.second.second);
  std::sort(indices.begin(), indices.end());
  return indices;
}

TestCloud dyadic_cloud(std::uint32_t seed, std::size_t points, int digits) {
  Random random(seed);
  TestCloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const float x = random.dyadic(-1.0f, 1.0f, digits);
    const float y = random.dyadic(-1.0f, 1.0f, digits);
    cloud.add(x, y, random.dyadic(-1.0f, 1.0f, digits));
  }
  return cloud;
}

}  // namespace

TEST_CASE("sample: one per voxel, nearest to the center, ties by index, in ascending order") {
  // Ten digits: hardly any ties. Four: many points are equally near, and many coincide.
  for (const int digits : {10, 4}) {
    const TestCloud cloud = dyadic_cloud(1, 3000, digits);
    for (const float leaf : {0.125f, 0.25f, 4.0f}) {
      const std::vector<std::uint32_t> keypoints = sampled(cloud, leaf);
      CHECK(std::is_sorted(keypoints.begin(), keypoints.end()));
      CHECK(keypoints == expected_sample(cloud, static_cast<double>(leaf)));
    }
  }
}

TEST_CASE("sample: voxels on both sides of zero are different voxels") {
  TestCloud cloud;
  cloud.add(0.1f, 0.1f, 0.1f);
  cloud.add(-0.1f, 0.1f, 0.1f);
  cloud.add(0.1f, -0.1f, 0.1f);
  cloud.add(0.1f, 0.1f, -0.1f);
  cloud.add(-0.0f, 0.0f, 0.0f);  // in the first one's voxel, farther from its center
  CHECK(sampled(cloud, 0.25f) == std::vector<std::uint32_t>{0, 1, 2, 3});
}

TEST_CASE("sample: points that are not finite are never chosen") {
  TestCloud cloud = dyadic_cloud(2, 500, 8);
  for (std::size_t i = 0; i < cloud.xyz.size(); i += 4) cloud.xyz[i] = i % 8 == 0 ? not_a_number : infinity;
  const std::vector<std::uint32_t> keypoints = sampled(cloud, 0.25f);
  CHECK(keypoints == expected_sample(cloud, 0.25));
}

TEST_CASE("sample: extents that no integer could number") {
  TestCloud cloud = dyadic_cloud(3, 200, 8);
  for (const float far : {1e6f, 1e12f, 1e30f, 3e38f}) {
    cloud.add(far, 0.0f, 0.0f);
    cloud.add(-far, far, -far);
    cloud.add(far, 0.0f, 0.0f);  // a copy: the same voxel, the larger index
  }
  const std::vector<std::uint32_t> near = expected_sample(dyadic_cloud(3, 200, 8), 0.25);
  std::vector<std::uint32_t> expected = near;
  for (std::uint32_t k = 0; k < 4; ++k) expected.insert(expected.end(), {200 + 3 * k, 201 + 3 * k});
  CHECK(sampled(cloud, 0.25f) == expected);
  // With millimeter voxels the farthest points' numbers leave float's range altogether: still no crash, still sorted.
  const std::vector<std::uint32_t> fine = sampled(cloud, 1e-3f);
  CHECK(std::is_sorted(fine.begin(), fine.end()));
  CHECK(fine.size() > near.size());
}

TEST_CASE("sample: the order of the points does not matter") {
  const TestCloud cloud = dyadic_cloud(4, 2000, 12);
  std::vector<std::uint32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0u);
  Random random(5);
  for (std::size_t k = order.size() - 1; k > 0; --k) std::swap(order[k], order[random.below(k + 1)]);
  TestCloud shuffled;
  for (const std::uint32_t i : order) shuffled.add(cloud.at(i));
  std::vector<std::uint32_t> mapped;
  for (const std::uint32_t i : sampled(shuffled, 0.125f)) mapped.push_back(order[i]);
  std::sort(mapped.begin(), mapped.end());
  CHECK(mapped == sampled(cloud, 0.125f));
}

TEST_CASE("sample: every finite voxel size above zero is a voxel size") {
  const TestCloud cloud = dyadic_cloud(6, 50, 6);
  CHECK(sampled(cloud, 1e25f).size() == 8);  // one an octant
  CHECK(sampled(cloud, 1e-25f).size() == 50);
}

TEST_CASE("sample: centroids are the means of each voxel's points and colors") {
  TestCloud cloud = dyadic_cloud(7, 3000, 10);
  Random random(8);
  for (std::uint8_t& value : cloud.rgb) value = static_cast<std::uint8_t>(random.below(256));
  cloud.xyz[0] = not_a_number;
  struct Sum {
    double of[6] = {};
    double count = 0.0;
  };
  std::map<std::tuple<double, double, double>, Sum> voxels;  // by z, y, x
  for (std::size_t i = 1; i < cloud.size(); ++i) {
    const auto value = [&](std::size_t axis) { return static_cast<double>(cloud.xyz[3 * i + axis]); };
    const auto number = [&](std::size_t axis) { return std::floor(value(axis) / 0.25); };
    Sum& sum = voxels[{number(2), number(1), number(0)}];
    for (std::size_t k = 0; k < 3; ++k) {
      sum.of[k] += value(k);
      sum.of[3 + k] += static_cast<double>(cloud.rgb[3 * i + k]);
    }
    sum.count += 1.0;
  }
  std::vector<ss::KeyPoint> found;
  REQUIRE(ss::sample_centroids(cloud.view(), 0.25f, found) == Status::ok);
  REQUIRE(found.size() == voxels.size());
  std::size_t k = 0;
  for (const auto& [voxel, sum] : voxels) {
    const ss::KeyPoint& c = found[k++];
    const float position[3] = {c.position.x, c.position.y, c.position.z};
    const std::uint8_t color[3] = {c.color.r, c.color.g, c.color.b};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(std::abs(static_cast<double>(position[axis]) - sum.of[axis] / sum.count) < 1e-6);
      CHECK(color[axis] == std::floor(sum.of[3 + axis] / sum.count + 0.5));
    }
  }
}

TEST_CASE("sample: centroids are sums of floats in one order, the nearest to the voxel's center first") {
  for (const float leaf : {0.3f, 0.125f, 1e-4f}) {
    TestCloud cloud = blob(9, 3000);
    for (std::size_t i = 0; i < 300; ++i) cloud.add(cloud.at(7 * i));  // ties
    struct Member {
      float d2;
      std::uint32_t index;
      float place[3];
    };
    std::map<std::tuple<float, float, float>, std::vector<Member>> voxels;
    for (std::uint32_t i = 0; i < cloud.size(); ++i) {
      Member member{0.0f, i, {}};
      float number[3], square[3];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float position = cloud.xyz[3 * i + axis] / leaf;
        number[axis] = std::floor(position);
        member.place[axis] = position - number[axis];
        square[axis] = (member.place[axis] - 0.5f) * (member.place[axis] - 0.5f);
      }
      member.d2 = (square[0] + square[1]) + square[2];
      voxels[{number[2], number[1], number[0]}].push_back(member);
    }
    std::vector<ss::KeyPoint> found;
    REQUIRE(ss::sample_centroids(cloud.view(), leaf, found) == Status::ok);
    REQUIRE(found.size() == voxels.size());
    std::size_t k = 0;
    for (auto& voxel : voxels) {
      const auto& number = voxel.first;
      std::vector<Member>& members = voxel.second;
      std::sort(members.begin(), members.end(),
                [](const Member& a, const Member& b) { return std::tie(a.d2, a.index) < std::tie(b.d2, b.index); });
      float sum[3] = {};
      for (const Member& member : members)
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += member.place[axis];
      const auto mean = [&](float corner, std::size_t axis) {
        return (corner + sum[axis] / static_cast<float>(members.size())) * leaf;
      };
      const ss::Point at = found[k++].position;
      REQUIRE((at.x == mean(std::get<2>(number), 0) && at.y == mean(std::get<1>(number), 1) &&
               at.z == mean(std::get<0>(number), 2)));
    }
  }
}

TEST_CASE("sample: a sampler that has seen other clouds chooses as a new one does") {
  ss::KeypointSampler sampler;
  for (const unsigned points : {20000u, 3u, 1u, 5000u, 0u, 20000u, 700u}) {
    const TestCloud cloud = dyadic_cloud(7, points, 12);
    for (const float leaf : {0.01f, 0.5f, 0.0f}) {
      std::vector<std::uint32_t> indices, expected_indices;
      std::vector<ss::KeyPoint> centroids, expected_centroids;
      CHECK(sampler.sample_uniform(cloud.view(), leaf, indices) ==
            ss::sample_uniform(cloud.view(), leaf, expected_indices));
      CHECK(indices == expected_indices);
      CHECK(sampler.sample_centroids(cloud.view(), leaf, centroids) ==
            ss::sample_centroids(cloud.view(), leaf, expected_centroids));
      REQUIRE(centroids.size() == expected_centroids.size());
      for (std::size_t k = 0; k < centroids.size(); ++k) {
        const ss::Point a = centroids[k].position, b = expected_centroids[k].position;
        REQUIRE((a.x == b.x && a.y == b.y && a.z == b.z));
      }
    }
  }
}

TEST_CASE("sample: centroids of bad input, without color, and beyond all voxel numbers") {
  std::vector<ss::KeyPoint> found(3);
  CHECK(ss::sample_centroids(ss::CloudView{}, 0.1f, found) == Status::empty_cloud);
  CHECK(found.empty());
  TestCloud cloud;
  cloud.add(1.0f, 2.0f, 3.0f);
  CHECK(ss::sample_centroids(cloud.view(), 0.0f, found) == Status::bad_leaf);
  CHECK(ss::sample_centroids(cloud.view(), not_a_number, found) == Status::bad_leaf);
  REQUIRE(ss::sample_centroids(ss::view_xyz(cloud.xyz.data(), 1), 1e-38f, found) == Status::ok);
  REQUIRE(found.size() == 1);
  CHECK(found[0].position.z == 3.0f);
  CHECK((found[0].color.r == 0 && found[0].color.g == 0 && found[0].color.b == 0));
}

}  // namespace test_sample
