// The local reference frame: SHOT's rules, and its refusals.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "fixtures.hpp"

namespace test_frame {
namespace {

using namespace unit;
using ss::Status;

constexpr ss::Point origin{0.0f, 0.0f, 0.0f};

Status frame_at(const TestCloud& cloud, const ss::Point& center, float radius, ss::Frame& frame,
                const ss::Viewpoint& viewpoint = {}) {
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(center, radius, n) == Status::ok);
  frame = {{not_a_number}, {not_a_number}, {not_a_number}};
  return ss::estimate_frame(n, radius, frame, viewpoint);
}

bool is_zero(const ss::Frame& f) {
  return all_zero({f.x[0], f.x[1], f.x[2], f.y[0], f.y[1], f.y[2], f.z[0], f.z[1], f.z[2]});
}

/// A thin plate; `signs[k]` is the side along x of the point that is k-th by distance.
TestCloud plate(const std::vector<int>& signs) {
  TestCloud cloud;
  for (std::size_t k = 0; k < signs.size(); ++k) {
    const float rank = static_cast<float>(k);
    cloud.add(static_cast<float>(signs[k]) * (0.02f + 0.005f * rank), k % 2 == 0 ? 0.004f : -0.004f,
              k % 4 < 2 ? 0.0005f : -0.0005f);
  }
  return cloud;
}

float x_side(const std::vector<int>& signs) {
  ss::Frame frame{};
  REQUIRE(frame_at(plate(signs), origin, 0.2f, frame) == Status::ok);
  REQUIRE(std::abs(frame.x[0]) > 0.9f);
  return frame.x[0] > 0.0f ? 1.0f : -1.0f;
}

}  // namespace

TEST_CASE("frame: orthonormal and right-handed, at every point of any cloud") {
  for (const TestCloud& cloud : {curved_surface(1, 800), blob(2, 800)}) {
    for (std::size_t i = 0; i < cloud.size(); i += 8) {
      ss::Frame f{};
      REQUIRE(frame_at(cloud, cloud.at(i), 0.05f, f) == Status::ok);
      // A handful of float roundings each.
      CHECK(ss::extend::dot(f.x, f.x) == doctest::Approx(1.0).epsilon(1e-6));
      CHECK(ss::extend::dot(f.y, f.y) == doctest::Approx(1.0).epsilon(1e-6));
      CHECK(ss::extend::dot(f.z, f.z) == doctest::Approx(1.0).epsilon(1e-6));
      CHECK(std::abs(ss::extend::dot(f.x, f.z)) < 1e-6f);
      const float y[3] = {f.z[1] * f.x[2] - f.z[2] * f.x[1], f.z[2] * f.x[0] - f.z[0] * f.x[2],
                          f.z[0] * f.x[1] - f.z[1] * f.x[0]};
      CHECK(ss::extend::dot(f.y, y) == doctest::Approx(1.0).epsilon(1e-6));
    }
  }
}

TEST_CASE("frame: x points to the side with more neighbors, however close they are") {
  CHECK(x_side({1, 1, 1, 1, -1, -1, -1}) == 1.0f);
  CHECK(x_side({-1, -1, -1, -1, 1, 1, 1}) == -1.0f);
  CHECK(x_side({-1, -1, -1, 1, 1, 1, 1}) == 1.0f);
}

TEST_CASE("frame: a tied vote is decided by the five neighbors in the middle of the order by distance") {
  // Ranks 2 to 6 of 8; what the others would say is the opposite.
  CHECK(x_side({-1, -1, 1, 1, 1, -1, 1, -1}) == 1.0f);
  CHECK(x_side({1, 1, -1, -1, -1, 1, -1, 1}) == -1.0f);
  CHECK(x_side({-1, 1, 1, -1, 1, -1, 1, -1}) == 1.0f);
  CHECK(x_side({1, -1, -1, 1, -1, 1, -1, 1}) == -1.0f);
  // Six neighbors: ranks 1 to 5, all but the closest.
  CHECK(x_side({-1, 1, 1, -1, -1, 1}) == 1.0f);
  CHECK(x_side({1, -1, -1, 1, 1, -1}) == -1.0f);
}

TEST_CASE("frame: equal distances in a tied vote are ordered by index, whatever the search") {
  // The corners of a box: both votes are tied, all distances equal, and the axes those of the coordinates, exactly.
  // Copies of the key point stand between them and count for nothing.
  Random random(3);
  std::vector<int> corners(8);
  std::iota(corners.begin(), corners.end(), 0);
  for (int round = 0; round < 200; ++round) {
    for (std::size_t k = 7; k > 0; --k) std::swap(corners[k], corners[random.below(k + 1)]);
    TestCloud cloud;
    int x_votes = 0;
    int z_votes = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const float x = (corners[k] & 1) != 0 ? 0.5f : -0.5f;
      const float z = (corners[k] & 4) != 0 ? 0.125f : -0.125f;
      if (random.below(2) == 0) cloud.add(origin);
      cloud.add(x, (corners[k] & 2) != 0 ? 0.25f : -0.25f, z);
      if (k >= 2 && k <= 6) x_votes += x > 0.0f ? 1 : 0;
      if (k >= 2 && k <= 6) z_votes += z > 0.0f ? 1 : 0;
    }
    const ss::GridSearch grid(cloud.view(), 0.3f);
    Room room(cloud.size());
    ss::Neighborhood n = room.neighborhood();
    ss::Frame frame{};
    REQUIRE(grid.gather(origin, 1.0f, n) == Status::ok);
    REQUIRE(ss::estimate_frame(n, 1.0f, frame) == Status::ok);
    CHECK(frame.x[0] == (x_votes >= 3 ? 1.0f : -1.0f));
    CHECK(frame.z[2] == (z_votes >= 3 ? 1.0f : -1.0f));
  }
}

TEST_CASE("frame: a viewpoint turns z towards the camera and leaves x to the vote") {
  const TestCloud cloud = curved_surface(4, 800);
  Random random(5);
  int turned = 0;
  for (std::size_t i = 0; i < cloud.size(); i += 16) {
    const ss::Point p = cloud.at(i);
    const ss::Point camera{random.between(-9.0f, 9.0f), random.between(-9.0f, 9.0f), random.between(-9.0f, 9.0f)};
    const float towards[3] = {camera.x - p.x, camera.y - p.y, camera.z - p.z};
    ss::Frame by_vote{};
    ss::Frame by_view{};
    REQUIRE(frame_at(cloud, cloud.at(i), 0.05f, by_vote) == Status::ok);
    REQUIRE(frame_at(cloud, p, 0.05f, by_view, ss::Viewpoint::towards(camera)) == Status::ok);
    CHECK(ss::extend::dot(towards, by_view.z) >= 0.0f);
    const float sign = ss::extend::dot(towards, by_vote.z) >= 0.0f ? 1.0f : -1.0f;
    turned += sign < 0.0f ? 1 : 0;
    for (int k = 0; k < 3; ++k) {
      CHECK(by_view.x[k] == by_vote.x[k]);
      CHECK(by_view.y[k] == sign * by_vote.y[k]);
      CHECK(by_view.z[k] == sign * by_vote.z[k]);
    }
  }
  CHECK(turned > 0);
}

TEST_CASE("frame: five neighbors are enough, four and any number of copies of the key point are not") {
  TestCloud cloud = plate({1, -1, 1, 1});
  for (int copy = 0; copy < 10; ++copy) cloud.add(-0.0f, 0.0f, -0.0f);
  ss::Frame frame{};
  CHECK(frame_at(cloud, origin, 0.2f, frame) == Status::too_few_neighbors);
  CHECK(is_zero(frame));
  cloud.add(0.0f, 0.1f, 0.01f);
  CHECK(frame_at(cloud, origin, 0.2f, frame) == Status::ok);
  cloud.xyz[3 * cloud.size() - 2] = 0.2f;  // to the rim, and out
  CHECK(frame_at(cloud, origin, 0.2f, frame) == Status::too_few_neighbors);
}

TEST_CASE("frame: neighbors beyond the frame's radius have no say") {
  TestCloud cloud = curved_surface(6, 800);
  const ss::Point center = cloud.at(3);
  ss::Frame expected{};
  REQUIRE(frame_at(cloud, center, 0.03f, expected) == Status::ok);
  Room room(cloud.size());
  ss::Neighborhood wide = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(center, 0.05f, wide) == Status::ok);
  ss::Frame frame{};
  REQUIRE(ss::estimate_frame(wide, 0.03f, frame) == Status::ok);
  for (int k = 0; k < 3; ++k) {
    // The number of neighbors sets the grid that sums are rounded to, so not to the last bit.
    CHECK(frame.x[k] == doctest::Approx(static_cast<double>(expected.x[k])).epsilon(1e-5));
    CHECK(frame.z[k] == doctest::Approx(static_cast<double>(expected.z[k])).epsilon(1e-5));
  }
}

TEST_CASE("frame: collinear neighborhoods are ambiguous") {
  const ss::Point directions[] = {{1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, {0.6f, 0.0f, 0.8f}, {0.3f, -0.5f, 0.81f}};
  for (const ss::Point& d : directions) {
    TestCloud cloud;
    for (int k = -9; k <= 9; ++k) {
      const float t = 0.01f * static_cast<float>(k);
      cloud.add(t * d.x, t * d.y, t * d.z);
    }
    ss::Frame frame{};
    CHECK(frame_at(cloud, origin, 0.1f, frame) == Status::ambiguous_frame);
    CHECK(is_zero(frame));
  }
}

TEST_CASE("frame: collinear neighborhoods are ambiguous, however little of the radius they fill") {
  // Radius 10 cm; the neighbors reach out to 5, 1 and a fifth of a millimeter.
  for (const float spacing : {5e-4f, 1e-4f, 2e-5f}) {
    CAPTURE(spacing);
    TestCloud cloud;
    for (int k = -10; k <= 10; ++k) {
      const float t = spacing * static_cast<float>(k);
      cloud.add(0.3f * t, -0.5f * t, 0.81f * t);
    }
    ss::Frame frame{};
    CHECK(frame_at(cloud, origin, 0.1f, frame) == Status::ambiguous_frame);
  }
}

TEST_CASE("frame: neighborhoods without a preferred direction are ambiguous") {
  for (const float spacing : {0.25f, 0.4f}) {  // a ball of a cubic lattice; the six neighbors along the axes
    TestCloud cloud;
    for (int i = 0; i < 1331; ++i) {
      const auto at = [spacing](int k) { return spacing * static_cast<float>(k - 5); };
      cloud.add(at(i % 11), at(i / 11 % 11), at(i / 121));
    }
    ss::Frame frame{};
    CHECK(frame_at(cloud, origin, 1.0f, frame) == Status::ambiguous_frame);
    CHECK(is_zero(frame));
  }
}

TEST_CASE("frame: an exactly planar neighborhood has one, with z along the normal") {
  Random random(7);
  TestCloud flat;
  for (int k = 0; k < 100; ++k) flat.add(random.between(-0.1f, 0.1f), 0.25f, 0.5f * random.between(-0.1f, 0.1f));
  ss::Frame frame{};
  REQUIRE(frame_at(flat, {0.0f, 0.25f, 0.0f}, 0.1f, frame) == Status::ok);
  CHECK(std::abs(frame.z[1]) == 1.0f);
  const auto below = ss::Viewpoint::towards({0.0f, -1.0f, 0.0f});
  REQUIRE(frame_at(flat, {0.0f, 0.25f, 0.0f}, 0.1f, frame, below) == Status::ok);
  CHECK(frame.z[1] == -1.0f);
}

TEST_CASE("frame: check() accepts rotations and refuses everything else") {
  const ss::Frame unit{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  CHECK(ss::validate(unit) == Status::ok);
  CHECK(ss::validate(ss::Frame{{0.6f, 0.8f, 0}, {-0.8f, 0.6f, 0}, {0, 0, 1}}) == Status::ok);
  CHECK(ss::validate(ss::Frame{}) == Status::bad_frame);
  CHECK(ss::validate(ss::Frame{{1, 0, 0}, {1, 0, 0}, {0, 0, 1}}) == Status::bad_frame);
  CHECK(ss::validate(ss::Frame{{1.01f, 0, 0}, {0, 1, 0}, {0, 0, 1}}) == Status::bad_frame);
  CHECK(ss::validate(ss::Frame{{1, 0, 0}, {0, 0.99f, 0}, {0, 0, 1}}) == Status::bad_frame);
  CHECK(ss::validate(ss::Frame{{1, 0, 0}, {0, 1, 0}, {0.01f, 0, 1}}) == Status::bad_frame);
  CHECK(ss::validate(ss::Frame{{1, 0, 0}, {0, 1, 0}, {0, -0.01f, 1}}) == Status::bad_frame);
  for (const float bad : {not_a_number, infinity, -infinity, 3e38f}) {
    for (int k = 0; k < 9; ++k) {
      ss::Frame frame = unit;
      (k < 3 ? frame.x : k < 6 ? frame.y : frame.z)[k % 3] = bad;
      CHECK(ss::validate(frame) == Status::bad_frame);
    }
  }
}

}  // namespace test_frame
