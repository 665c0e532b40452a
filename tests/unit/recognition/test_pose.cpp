// fit_pose(): known motions are found again, and where there is none, that is said, by estimate_pose(), too.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"
#include "point_pairs.hpp"

namespace test_pose {
namespace {

using namespace unit;
using ss::Status;

double sum_of_squares(const ss::Pose& pose, const std::vector<ss::PointPair>& pairs) {
  double sum = 0.0;
  for (const ss::PointPair& pair : pairs) {
    const ss::Point p = ss::transform_point(pose, pair.source);
    sum += std::pow(p.x - pair.target.x, 2) + std::pow(p.y - pair.target.y, 2) + std::pow(p.z - pair.target.z, 2);
  }
  return sum;
}

}  // namespace

TEST_CASE("pose: a turn by a right angle about z, written down by hand") {
  const std::vector<ss::PointPair> pairs{{{1.0f, 0.0f, 0.0f}, {5.0f, 1.0f, 2.0f}},
                                         {{0.0f, 1.0f, 0.0f}, {4.0f, 0.0f, 2.0f}},
                                         {{0.0f, 0.0f, 1.0f}, {5.0f, 0.0f, 3.0f}}};
  const ss::Pose expected{{0.0f, -1.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f}, {5.0f, 0.0f, 2.0f}};
  ss::Pose pose = garbage_pose();
  REQUIRE(ss::fit_pose(pairs, pose) == Status::ok);
  CHECK(largest_difference(pose, expected) < 2e-6f);
  const ss::Point p = ss::transform_point(expected, {2.0f, 3.0f, 4.0f});
  CHECK((p.x == 2.0f && p.y == 2.0f && p.z == 6.0f));
}

TEST_CASE("pose: exact motions are found again, by three pairs or more") {
  Random random(1);
  for (const std::size_t count : {3u, 4u, 10u, 1000u}) {
    for (int trial = 0; trial < 20; ++trial) {
      const ss::Pose expected = random_pose(random);
      const std::vector<ss::PointPair> pairs = moved(random, expected, count);
      ss::Pose pose = garbage_pose();
      REQUIRE(ss::fit_pose(pairs, pose) == Status::ok);
      CHECK(is_rotation(pose));
      CHECK(sum_of_squares(pose, pairs) < 1e-11 * static_cast<double>(count));
      if (count > 3) CHECK(largest_difference(pose, expected) < 2e-5f);
    }
  }
}

TEST_CASE("pose: no turn, and half turns, whose quaternions have no real part") {
  Random random(9);
  const float axes[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6f, 0.8f, 0}, {0, -0.6f, 0.8f}, {0.48f, 0.6f, -0.64f}};
  ss::Pose expected{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.1f, -0.2f, 0.3f}};
  ss::Pose pose = garbage_pose();
  REQUIRE(ss::fit_pose(moved(random, expected, 30), pose) == Status::ok);
  CHECK(largest_difference(pose, expected) < 2e-6f);
  for (const auto& axis : axes) {
    for (int k = 0; k < 9; ++k) {
      expected.rotation[k] = 2.0f * axis[k / 3] * axis[k % 3] - (k / 3 == k % 3 ? 1.0f : 0.0f);
    }
    REQUIRE(ss::fit_pose(moved(random, expected, 30), pose) == Status::ok);
    CHECK(is_rotation(pose));
    CHECK(largest_difference(pose, expected) < 3e-6f);
  }
}

TEST_CASE("pose: of noisy pairs it is the motion with the least squares") {
  Random random(2);
  const ss::Pose expected = random_pose(random);
  const std::vector<ss::PointPair> pairs = moved(random, expected, 500, 0.01f);
  ss::Pose pose = garbage_pose();
  REQUIRE(ss::fit_pose(pairs, pose) == Status::ok);
  CHECK(is_rotation(pose));
  CHECK(largest_difference(pose, expected) < 0.005f);
  const double least = sum_of_squares(pose, pairs);
  CHECK(least < sum_of_squares(expected, pairs));
  for (int trial = 0; trial < 50; ++trial) {  // any small motion after it makes it worse
    const float angle = random.between(1e-3f, 3e-3f);
    ss::Pose other = pose;
    const int axis = static_cast<int>(random.below(3));
    for (int k = 0; k < 3; ++k) {
      const float a = pose.rotation[3 * axis + k];
      const float b = pose.rotation[3 * ((axis + 1) % 3) + k];
      other.rotation[3 * axis + k] = std::cos(angle) * a - std::sin(angle) * b;
      other.rotation[3 * ((axis + 1) % 3) + k] = std::sin(angle) * a + std::cos(angle) * b;
    }
    CHECK(sum_of_squares(other, pairs) > least);
    other = pose;
    other.translation[axis] += angle;
    CHECK(sum_of_squares(other, pairs) > least);
  }
}

TEST_CASE("pose: of points in a plane, and far from the origin") {
  Random random(3);
  const ss::Pose expected = random_pose(random);
  std::vector<ss::PointPair> plane = moved(random, expected, 20);
  std::vector<ss::PointPair> far = plane;
  for (ss::PointPair& pair : plane) {
    pair.source.z = 1.0f;
    pair.target = ss::transform_point(expected, pair.source);
  }
  ss::Pose pose = garbage_pose();
  REQUIRE(ss::fit_pose(plane, pose) == Status::ok);
  CHECK(largest_difference(pose, expected) < 1e-5f);
  for (ss::PointPair& pair : far) {
    pair.source.x += 1024.0f;
    pair.target.y -= 512.0f;
  }
  REQUIRE(ss::fit_pose(far, pose) == Status::ok);
  for (int k = 0; k < 9; ++k) CHECK(std::fabs(pose.rotation[k] - expected.rotation[k]) < 1e-3f);
}

TEST_CASE("pose: a mirror image gets a rotation, or none, but no reflection") {
  Random random(4);
  std::vector<ss::PointPair> pairs = moved(random, random_pose(random), 50);
  for (ss::PointPair& pair : pairs) pair.target.x = -pair.target.x;
  ss::Pose pose = garbage_pose();
  REQUIRE(ss::fit_pose(pairs, pose) == Status::ok);
  CHECK(is_rotation(pose));
  ss::RansacOptions options;
  options.inlier_distance = 0.1f;
  std::vector<std::uint32_t> inliers;
  REQUIRE(ss::estimate_pose(pairs, options, pose, inliers) == Status::ok);
  CHECK(is_rotation(pose));
  CHECK(inliers.size() < pairs.size());

  const float corners[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};  // which rotation is as good as any
  pairs.clear();
  for (const auto& c : corners) pairs.push_back({{c[0], c[1], c[2]}, {-c[0], -c[1], -c[2]}});
  CHECK(ss::fit_pose(pairs, pose) == Status::no_pose);
  CHECK(same_bits(pose, ss::Pose{}));
}

TEST_CASE("pose: no motion where points are on a line, coincide, or move by their own rules") {
  Random random(8);
  const ss::Pose pose = random_pose(random);
  std::vector<ss::PointPair> line;
  for (int i = 0; i < 30; ++i) {
    const float t = random.between(-1.0f, 1.0f);
    const ss::Point p{0.3f + 0.1f * t, -0.2f + 0.3f * t, 1.0f - 0.2f * t};
    line.push_back({p, ss::transform_point(pose, p)});
  }
  check_refused(line, Status::no_pose);
  check_refused({line[0], line[1], line[2]}, Status::no_pose);
  check_refused(std::vector<ss::PointPair>(5, line[0]), Status::no_pose);

  std::vector<ss::PointPair> huge = moved(random, pose, 5);
  for (ss::PointPair& pair : huge) pair.source.x *= 1e38f;
  check_refused(huge, Status::no_pose);

  std::vector<ss::PointPair> scaled = moved(random, pose, 30);
  for (ss::PointPair& pair : scaled) pair.target = {2 * pair.target.x, 2 * pair.target.y, 2 * pair.target.z};
  ss::Pose found = garbage_pose();
  std::vector<std::uint32_t> inliers{1};
  CHECK(ss::estimate_pose(scaled, {}, found, inliers) == Status::no_pose);
  CHECK(same_bits(found, ss::Pose{}));
  CHECK(inliers.empty());
}

TEST_CASE("pose: too few pairs, and coordinates that are no numbers, are refused") {
  Random random(9);
  const std::vector<ss::PointPair> good = moved(random, random_pose(random), 10);
  check_refused({}, Status::too_few_pairs);
  check_refused({good[0], good[1]}, Status::too_few_pairs);
  for (const float value : {not_a_number, infinity, -infinity}) {
    for (std::size_t component = 0; component < 6; ++component) {
      std::vector<ss::PointPair> pairs = good;
      ss::Point& p = component < 3 ? pairs[9].source : pairs[9].target;
      (component % 3 == 0 ? p.x : component % 3 == 1 ? p.y : p.z) = value;
      check_refused(pairs, Status::invalid_keypoint);
    }
  }
}

}  // namespace test_pose
