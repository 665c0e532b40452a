// extract(): one row and one status per key point, and no key point spoils another.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace test_extract {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Scsh336;

constexpr float radius = 0.05f;

template <class Descriptor>
std::vector<float> row_of(const ss::Features<Descriptor>& features, std::size_t row) {
  return std::vector<float>(features[row], features[row] + Descriptor::size);
}

template <class Key>
std::vector<float> described(const TestCloud& cloud, const Key& key, const ss::Support& support = radius) {
  static ss::Workspace<4000> workspace;
  std::vector<float> out = garbage<D>();
  REQUIRE(ss::describe_at<D>(cloud.view(), ss::BruteSearch{cloud.view()}, key, support, workspace, out.data()) ==
          Status::ok);
  return out;
}

}  // namespace

TEST_CASE("extract: rows, statuses and numbers of neighbors are those of each key point alone") {
  const TestCloud cloud = curved_surface(1, 1500);
  const ss::GridSearch grid(cloud.view(), radius);
  const std::vector<std::uint32_t> keypoints{5, 900, 5, 77, 1499, 0};
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, features) == Status::ok);
  REQUIRE(features.size() == keypoints.size());
  CHECK(features.values.size() == keypoints.size() * D::size);
  Room room(cloud.size());
  for (std::size_t row = 0; row < keypoints.size(); ++row) {
    CHECK(features.status[row] == Status::ok);
    CHECK(features.neighbors[row] == found_by(grid, cloud.at(keypoints[row]), radius, room).size());
    CHECK(same_bits(row_of(features, row), described(cloud, std::size_t{keypoints[row]})));
  }
}

TEST_CASE("extract: key points that cannot be described get their own status and zeros, the others are undisturbed") {
  TestCloud cloud = curved_surface(2, 1500);
  cloud.add(5.0f, 5.0f, 5.0f);                                                         // 1500: alone
  cloud.add(not_a_number, 0.0f, 1.0f);                                                 // 1501
  for (int k = 0; k < 9; ++k) cloud.add(0.001f * static_cast<float>(k), -5.0f, 0.0f);  // 1502: on a line
  const ss::GridSearch grid(cloud.view(), radius);
  for (const unsigned threads : {1u, 3u}) {
    ss::Features<D> features;
    const std::vector<std::uint32_t> keypoints{3, 1511, 1500, 0xFFFFFFFFu, 1501, 1502, 4};
    REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, features, threads) == Status::ok);
    const std::vector<Status> expected{Status::ok,
                                       Status::bad_keypoint,
                                       Status::too_few_neighbors,
                                       Status::bad_keypoint,
                                       Status::invalid_keypoint,
                                       Status::ambiguous_frame,
                                       Status::ok};
    CHECK(features.status == expected);
    for (std::size_t row = 1; row <= 5; ++row) CHECK(all_zero(row_of(features, row)));
    CHECK(features.neighbors[1] == 0);
    CHECK(features.neighbors[2] == 1);
    CHECK(same_bits(row_of(features, 0), described(cloud, std::size_t{3})));
    CHECK(same_bits(row_of(features, 6), described(cloud, std::size_t{4})));
  }
}

TEST_CASE("extract: key points off the cloud have a position and a color of their own") {
  const TestCloud cloud = curved_surface(3, 1500);
  const ss::Point p = cloud.at(10);
  const std::vector<ss::KeyPoint> keypoints{{{p.x + 0.003f, p.y, p.z - 0.002f}, {10, 200, 30}},
                                            {p, cloud.color_at(10)},
                                            {p, {10, 200, 30}},
                                            {{infinity, 0.0f, 0.0f}, {}}};
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud.view(), ss::GridSearch(cloud.view(), radius), keypoints, radius, features) == Status::ok);
  CHECK(same_bits(row_of(features, 0), described(cloud, keypoints[0])));
  CHECK(same_bits(row_of(features, 1), described(cloud, std::size_t{10})));
  CHECK(!same_bits(row_of(features, 2), row_of(features, 1)));  // another reference color
  CHECK(features.status[3] == Status::invalid_keypoint);
}

TEST_CASE("extract: the viewpoint and the frame's own radius are passed on") {
  const TestCloud cloud = curved_surface(4, 1500);
  const ss::Point behind{0.0f, 0.0f, 2.0f};
  ss::Support support = radius;
  support.frame_radius = 0.03f;
  support.viewpoint = ss::Viewpoint::towards(behind);
  ss::Features<D> features;
  const std::vector<std::uint32_t> keypoints{1, 2, 3};
  REQUIRE(ss::extract(cloud.view(), ss::GridSearch(cloud.view(), radius), keypoints, support, features) == Status::ok);
  for (std::size_t row = 0; row < 3; ++row) {
    CHECK(same_bits(row_of(features, row), described(cloud, std::size_t{keypoints[row]}, support)));
    CHECK(!same_bits(row_of(features, row), described(cloud, std::size_t{keypoints[row]})));
  }
}

TEST_CASE("extract: no key points give no rows") {
  const TestCloud cloud = curved_surface(5, 100);
  ss::Features<D> features;
  const ss::GridSearch grid(cloud.view(), radius);
  CHECK(ss::extract(cloud.view(), grid, std::vector<std::uint32_t>{}, radius, features, 4) == Status::ok);
  CHECK(features.size() == 0);
  CHECK(features.values.empty());
}

TEST_CASE("extract: what is wrong with all key points is returned, and said in every row") {
  const TestCloud cloud = curved_surface(6, 100);
  const ss::GridSearch grid(cloud.view(), radius);
  const std::vector<std::uint32_t> keypoints{1, 2};
  const auto check_refused = [&](const ss::CloudView& view, const auto& search, const ss::Support& support,
                                 Status expected) {
    ss::Features<D> features;
    REQUIRE(ss::extract(cloud.view(), grid, std::vector<std::uint32_t>{9, 8, 7}, 0.2f, features) == Status::ok);
    CHECK(ss::extract(view, search, keypoints, support, features) == expected);
    CHECK(features.status == std::vector<Status>{expected, expected});
    CHECK(features.neighbors == std::vector<std::uint32_t>{0, 0});
    CHECK(features.values.size() == 2 * D::size);
    CHECK(all_zero(features.values));
  };
  check_refused(ss::CloudView{}, grid, radius, Status::empty_cloud);
  check_refused(ss::view_xyz(cloud.xyz.data(), 100), grid, radius, Status::missing_colors);
  check_refused(cloud.view(), grid, not_a_number, Status::bad_radius);
  check_refused(cloud.view(), ss::GridSearch(cloud.view(), 0.0f), radius, Status::bad_radius);
  check_refused(cloud.view(), ss::GridSearch(), radius, Status::empty_cloud);
  ss::Support bad_frame_radius = radius;
  bad_frame_radius.frame_radius = -1.0f;
  check_refused(cloud.view(), grid, bad_frame_radius, Status::bad_radius);
}

TEST_CASE("extract: features can be used again for another cloud, larger or smaller, with no trace of the last") {
  ss::Features<D> reused;
  for (const std::size_t points : {2000u, 300u, 3000u}) {  // up to all of them in one neighborhood
    const TestCloud cloud = curved_surface(static_cast<std::uint32_t>(points), points);
    const ss::GridSearch grid(cloud.view(), 0.3f);
    std::vector<std::uint32_t> keypoints;
    for (std::uint32_t i = 0; i < points; i += 150) keypoints.push_back(i);
    ss::Features<D> fresh;
    REQUIRE(ss::extract(cloud.view(), grid, keypoints, 0.3f, reused, 2) == Status::ok);
    REQUIRE(ss::extract(cloud.view(), grid, keypoints, 0.3f, fresh, 1) == Status::ok);
    CHECK(same_bits(reused.values, fresh.values));
    CHECK(reused.status == fresh.status);
    CHECK(reused.neighbors == fresh.neighbors);
    CHECK(fresh.neighbors[0] == points);
  }
}

TEST_CASE("extract: a row that cannot be described is zeros, also where the last frame's descriptor was") {
  const TestCloud cloud = curved_surface(8, 1500);
  const ss::GridSearch grid(cloud.view(), radius);
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud.view(), grid, std::vector<int>{1, 2, 3}, radius, features) == Status::ok);
  const std::vector<ss::KeyPoint> none{{{9.0f, 9.0f, 9.0f}, {}}, {{not_a_number, 0.0f, 0.0f}, {}}};
  REQUIRE(ss::extract(cloud.view(), grid, none, radius, features) == Status::ok);
  CHECK(features.status == std::vector<Status>{Status::too_few_neighbors, Status::invalid_keypoint});
  CHECK(features.neighbors == std::vector<std::uint32_t>{0, 0});
  CHECK(all_zero(features.values));
  REQUIRE(ss::extract(cloud.view(), grid, std::vector<int>{1, -1}, radius, features) == Status::ok);
  CHECK(same_bits(row_of(features, 0), described(cloud, std::size_t{1})));
  CHECK(all_zero(row_of(features, 1)));
}

TEST_CASE("extract: more threads than key points, and zero threads, are fine") {
  const TestCloud cloud = curved_surface(7, 500);
  const ss::GridSearch grid(cloud.view(), radius);
  ss::Features<ss::Ssh32> one, many, none;
  const std::vector<std::uint32_t> keypoints{1, 2, 3};
  REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, one, 1) == Status::ok);
  REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, many, 64) == Status::ok);
  REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, none, 0) == Status::ok);
  CHECK(same_bits(one.values, many.values));
  CHECK(same_bits(one.values, none.values));
}

}  // namespace test_extract
