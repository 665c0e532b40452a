// shortshot/recognition/fit_pose.hpp: the rigid motion that takes points to their correspondences, by least squares.
// Hosted only.
#pragma once

#include <cstddef>
#include <limits>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../base/symmetric_eigen.hpp"
#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A rigid motion: target = rotation * source + translation, in meters. Trivial type.
struct Pose {
  float rotation[9];     ///< row by row; orthonormal, determinant +1
  float translation[3];  ///< meters
};

/// Two points that may be the same one of an object, before and after its motion.
struct PointPair {
  Point source;  ///< before
  Point target;  ///< after
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Where a motion takes a point.
[[nodiscard]] inline Point transform_point(const Pose& pose, const Point& p) noexcept {
  const auto component = [&](std::size_t row) {
    const float* const r = pose.rotation + 3 * row;
    return ((extend::unfused(r[0] * p.x) + extend::unfused(r[1] * p.y)) + extend::unfused(r[2] * p.z)) +
           pose.translation[row];
  };
  return {component(0), component(1), component(2)};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Pairs, borrowed.
class PairsView {
 public:
  template <class Pairs>
  explicit PairsView(const Pairs& pairs) noexcept : data_(pairs.data()), size_(pairs.size()) {}

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] const PointPair& operator[](std::size_t i) const noexcept { return data_[i]; }
  [[nodiscard]] const PointPair* begin() const noexcept { return data_; }
  [[nodiscard]] const PointPair* end() const noexcept { return data_ + size_; }

 private:
  const PointPair* data_;
  std::size_t size_;
};

/// ok, too_few_pairs or invalid_keypoint.
[[nodiscard]] inline Status check_pairs(const PairsView& pairs) noexcept {
  if (pairs.size() < 3) return Status::too_few_pairs;
  for (const PointPair& pair : pairs) {
    if (!is_finite(pair.source) || !is_finite(pair.target)) return Status::invalid_keypoint;
  }
  return Status::ok;
}

[[nodiscard]] inline Point operator-(const Point& a, const Point& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// The mean of one of the points of each pair. Offsets from the first are summed up: clouds may lie far from the
/// origin.
[[nodiscard]] inline Point centroid(const PairsView& pairs, Point PointPair::*point) noexcept {
  const Point first = pairs[0].*point;
  Point sum{};
  for (const PointPair& pair : pairs) {
    const Point offset = pair.*point - first;
    sum = {sum.x + offset.x, sum.y + offset.y, sum.z + offset.z};
  }
  const auto n = static_cast<float>(pairs.size());
  return {first.x + sum.x / n, first.y + sum.y / n, first.z + sum.z / n};
}

/// The rotation that a unit quaternion (w, x, y, z) stands for, row by row.
inline void rotation_of(const float (&q)[4], float (&rotation)[9]) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;  // the axes after axis i, in cyclic order
    const std::size_t k = (i + 2) % 3;
    const auto product = [&q](std::size_t a, std::size_t b) { return unfused(q[a] * q[b]); };
    rotation[3 * i + i] = 1.0f - unfused(2.0f * (product(1 + j, 1 + j) + product(1 + k, 1 + k)));
    rotation[3 * i + j] = 2.0f * (product(1 + i, 1 + j) - product(0, 1 + k));
    rotation[3 * i + k] = 2.0f * (product(1 + i, 1 + k) + product(0, 1 + j));
  }
}

/// The rotation that best aligns points with a given covariance, source by target: of the unit quaternions that with
/// the largest value of a quadratic form (Horn 1987), hence an eigenvector. ok or no_pose.
[[nodiscard]] inline Status best_rotation(const float (&covariance)[3][3], float (&rotation)[9]) noexcept {
  using simd::all;
  float scale = 0.0f;
  for (const auto& row : covariance) {
    for (const float value : row) scale += __builtin_fabsf(value);
  }
  if (!math::is_finite(scale) || !(scale >= std::numeric_limits<float>::min())) return Status::no_pose;
  const auto c = [&](std::size_t i, std::size_t k) { return covariance[i][k] / scale; };
  const SymmetricMatrices<4> form{{all((c(0, 0) + c(1, 1)) + c(2, 2)), all(c(1, 2) - c(2, 1)), all(c(2, 0) - c(0, 2)),
                                   all(c(0, 1) - c(1, 0)), all((c(0, 0) - c(1, 1)) - c(2, 2)), all(c(0, 1) + c(1, 0)),
                                   all(c(2, 0) + c(0, 2)), all((c(1, 1) - c(0, 0)) - c(2, 2)), all(c(1, 2) + c(2, 1)),
                                   all((c(2, 2) - c(0, 0)) - c(1, 1))}};
  const Eigenvectors<4> eigen = decompose(form);
  const auto number = [](simd::F32 lanes) { return simd::largest(lanes); };  // all of them are the same

  // Two rotations that align equally well: points on a line, or the mirror image of something symmetric.
  const float quality = number(eigen.value(3));
  constexpr float tolerance = 1e-5f;  // a hundred times float's rounding
  if (!(quality - number(eigen.value(2)) > tolerance * quality)) return Status::no_pose;
  rotation_of(
      {number(eigen.vector(3, 0)), number(eigen.vector(3, 1)), number(eigen.vector(3, 2)), number(eigen.vector(3, 3))},
      rotation);
  return Status::ok;
}

/// Least squares for three pairs or more, all finite.
[[nodiscard]] inline Status align(const PairsView& pairs, Pose& pose) noexcept {
  pose = Pose{};
  const Point source = centroid(pairs, &PointPair::source);
  const Point target = centroid(pairs, &PointPair::target);
  if (!is_finite(source) || !is_finite(target)) return Status::no_pose;
  float covariance[3][3] = {};
  for (const PointPair& pair : pairs) {
    const Point s = pair.source - source;
    const Point t = pair.target - target;
    for (std::size_t k = 0; k < 9; ++k) {
      covariance[k / 3][k % 3] += unfused(coordinate(s, k / 3) * coordinate(t, k % 3));
    }
  }
  Pose aligned{};
  const Status status = best_rotation(covariance, aligned.rotation);
  if (status != Status::ok) return status;
  const Point translation = target - transform_point(aligned, source);
  if (!is_finite(translation)) return Status::no_pose;
  for (std::size_t k = 0; k < 3; ++k) aligned.translation[k] = coordinate(translation, k);
  pose = aligned;
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The rigid motion with the least sum of squared distances between targets and moved sources: Kabsch's problem, solved
/// with quaternions, so that a reflection is never an answer (B. Horn, "Closed-form solution of absolute orientation
/// using unit quaternions", 1987).
///
/// `pairs`   PointPairs, all of the same weight: a std::vector, a std::array or the like
///
/// Statuses: too_few_pairs (fewer than three), invalid_keypoint (a coordinate is not finite), no_pose (all points on a
/// line, or squares outside of float's range). `pose` is all zeros then. The same bits on every machine, for pairs in
/// the same order. O(pairs); allocates nothing.
template <class Pairs>
[[nodiscard]] Status fit_pose(const Pairs& pairs, Pose& pose) noexcept {
  pose = Pose{};
  const Status usable = detail::check_pairs(detail::PairsView(pairs));
  return usable == Status::ok ? detail::align(detail::PairsView(pairs), pose) : usable;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
