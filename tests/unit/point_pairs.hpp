// Pairs of points before and after a motion, and what a pose must be.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "fixtures.hpp"
#include "synthetic_objects.hpp"

namespace unit {

inline ss::Pose random_pose(Random& random) {
  const Motion m = random_motion(random);
  const auto& r = m.rotation;
  return {{r[0][0], r[0][1], r[0][2], r[1][0], r[1][1], r[1][2], r[2][0], r[2][1], r[2][2]},
          {m.translation.x, m.translation.y, m.translation.z}};
}

inline ss::Point point_in_box(Random& random) {
  const float x = random.between(-0.3f, 0.3f);
  const float y = random.between(-0.3f, 0.3f);
  return {x, y, 1.0f + random.between(-0.3f, 0.3f)};
}

/// Pairs of one motion, up to `noise` in each coordinate of the target.
inline std::vector<ss::PointPair> moved(Random& random, const ss::Pose& pose, std::size_t count, float noise = 0.0f) {
  std::vector<ss::PointPair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const ss::Point source = point_in_box(random);
    const ss::Point target = ss::transform_point(pose, source);
    pairs.push_back({source,
                     {target.x + random.between(-noise, noise), target.y + random.between(-noise, noise),
                      target.z + random.between(-noise, noise)}});
  }
  return pairs;
}

inline float largest_difference(const ss::Pose& a, const ss::Pose& b) {
  float largest = 0.0f;
  for (int k = 0; k < 9; ++k) largest = std::fmax(largest, std::fabs(a.rotation[k] - b.rotation[k]));
  for (int k = 0; k < 3; ++k) largest = std::fmax(largest, std::fabs(a.translation[k] - b.translation[k]));
  return largest;
}

inline float determinant(const ss::Pose& pose) {
  const float* const r = pose.rotation;
  return r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) + r[2] * (r[3] * r[7] - r[4] * r[6]);
}

inline bool is_rotation(const ss::Pose& pose) {
  const float* const r = pose.rotation;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const float dot = r[3 * i] * r[3 * k] + r[3 * i + 1] * r[3 * k + 1] + r[3 * i + 2] * r[3 * k + 2];
      if (!(std::fabs(dot - (i == k ? 1.0f : 0.0f)) < 1e-5f)) return false;
    }
  }
  return std::fabs(determinant(pose) - 1.0f) < 1e-5f;
}

inline bool same_bits(const ss::Pose& a, const ss::Pose& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

inline ss::Pose garbage_pose() {
  ss::Pose pose;
  std::memset(&pose, 0xFF, sizeof pose);
  return pose;
}

/// Both ways to a pose refuse these pairs with this status, and leave zeros.
inline void check_refused(const std::vector<ss::PointPair>& pairs, ss::Status expected,
                          const ss::RansacOptions& options = {}) {
  ss::Pose pose = garbage_pose();
  std::vector<std::uint32_t> inliers{1, 2};
  CHECK(ss::estimate_pose(pairs, options, pose, inliers) == expected);
  CHECK(same_bits(pose, ss::Pose{}));
  CHECK(inliers.empty());
  if (expected == ss::Status::bad_option) return;
  pose = garbage_pose();
  CHECK(ss::fit_pose(pairs, pose) == expected);
  CHECK(same_bits(pose, ss::Pose{}));
}

}  // namespace unit
