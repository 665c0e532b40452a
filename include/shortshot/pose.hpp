// shortshot/pose.hpp: the rigid motion that takes points to their correspondences, by least squares, and by RANSAC
// where some correspondences are wrong. Hosted only: allocates.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "cloud.hpp"
#include "config.hpp"
#include "math.hpp"
#include "neighborhood.hpp"
#include "rounded.hpp"
#include "simd.hpp"
#include "status.hpp"
#include "symmetric_eigen.hpp"

namespace shortshot {

/// A rigid motion: target = rotation * source + translation, in meters. Trivial type.
struct Pose {
  float rotation[9];  ///< row by row; orthonormal, determinant +1
  float translation[3];
};

/// Two points that may be the same one of an object, before and after its motion.
struct PointPair {
  Point source;
  Point target;
};

/// Options of estimate_pose().
struct RansacOptions {
  std::uint32_t iterations = 5000;  ///< samples of three pairs, from 1 on
  float inlier_distance = 0.01f;    ///< meters between target and moved source; above 0, and its square a normal float
  float edge_similarity = 0.9f;     ///< 0 to 1: samples with an edge whose lengths differ by more are skipped
  std::uint32_t seed = 1;           ///< of the samples' sequence
};

inline namespace SHORTSHOT_ISA {

/// Where a motion takes a point.
[[nodiscard]] inline Point apply(const Pose& pose, const Point& p) noexcept {
  const auto component = [&](std::size_t row) {
    const float* const r = pose.rotation + 3 * row;
    return ((rounded(r[0] * p.x) + rounded(r[1] * p.y)) + rounded(r[2] * p.z)) + pose.translation[row];
  };
  return {component(0), component(1), component(2)};
}

/// ok or bad_option.
[[nodiscard]] inline Status check(const RansacOptions& options) noexcept {
  const bool similarity =
      math::is_finite(options.edge_similarity) && options.edge_similarity >= 0.0f && options.edge_similarity <= 1.0f;
  const bool distance = check(Radius(options.inlier_distance)) == Status::ok;
  return options.iterations > 0 && similarity && distance ? Status::ok : Status::bad_option;
}

namespace detail {

/// ok, too_few_pairs or invalid_keypoint.
template <class Pairs>
[[nodiscard]] Status check_pairs(const Pairs& pairs) noexcept {
  if (pairs.size() < 3) return Status::too_few_pairs;
  const bool finite = std::all_of(pairs.begin(), pairs.end(), [](const PointPair& pair) {
    return is_finite(pair.source) && is_finite(pair.target);
  });
  return finite ? Status::ok : Status::invalid_keypoint;
}

/// The mean of some points. Offsets from the first are summed up: clouds may lie far from the origin.
template <class PointAt>
[[nodiscard]] Point centroid(std::size_t count, const PointAt& point_at) noexcept {
  const Point first = point_at(0);
  Point sum{};
  for (std::size_t i = 1; i < count; ++i) {
    const Point p = point_at(i);
    sum = {sum.x + (p.x - first.x), sum.y + (p.y - first.y), sum.z + (p.z - first.z)};
  }
  const auto n = static_cast<float>(count);
  return {first.x + sum.x / n, first.y + sum.y / n, first.z + sum.z / n};
}

/// The rotation that a unit quaternion (w, x, y, z) stands for, row by row.
inline void rotation_of(const float (&q)[4], float (&rotation)[9]) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;  // the axes after axis i, in cyclic order
    const std::size_t k = (i + 2) % 3;
    const auto product = [&q](std::size_t a, std::size_t b) { return rounded(q[a] * q[b]); };
    rotation[3 * i + i] = 1.0f - rounded(2.0f * (product(1 + j, 1 + j) + product(1 + k, 1 + k)));
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
template <class Pairs>
[[nodiscard]] Status align(const Pairs& pairs, Pose& pose) noexcept {
  pose = Pose{};
  const std::size_t count = pairs.size();
  const Point source = centroid(count, [&](std::size_t i) { return pairs[i].source; });
  const Point target = centroid(count, [&](std::size_t i) { return pairs[i].target; });
  const auto offset = [](const Point& p, const Point& from) { return Point{p.x - from.x, p.y - from.y, p.z - from.z}; };
  float covariance[3][3] = {};
  for (std::size_t i = 0; i < count; ++i) {
    const Point s = offset(pairs[i].source, source);
    const Point t = offset(pairs[i].target, target);
    for (std::size_t k = 0; k < 9; ++k) {
      covariance[k / 3][k % 3] += rounded(coordinate(s, k / 3) * coordinate(t, k % 3));
    }
  }
  Pose aligned{};
  const Status status = best_rotation(covariance, aligned.rotation);
  if (status != Status::ok) return status;
  const Point translation = offset(target, apply(aligned, source));
  if (!is_finite(translation)) return Status::no_pose;
  for (std::size_t k = 0; k < 3; ++k) aligned.translation[k] = coordinate(translation, k);
  pose = aligned;
  return Status::ok;
}

/// Samples of three different numbers below `count`, from 3 on: the same on every machine, which the standard library's
/// distributions are not. From SplitMix64 (G. Steele, D. Lea, C. Flood: Fast splittable pseudorandom number generators,
/// 2014), which takes any seed; <random> alone would cost whoever includes this a third of a second.
class Samples {
 public:
  Samples(std::uint32_t seed, std::size_t count) noexcept : state_(seed), count_(count) {}

  [[nodiscard]] std::array<std::size_t, 3> draw() noexcept {
    const std::size_t a = below(count_);
    std::size_t b = below(count_ - 1);
    b += b >= a ? 1 : 0;
    std::size_t c = below(count_ - 2);
    c += c >= std::min(a, b) ? 1 : 0;
    c += c >= std::max(a, b) ? 1 : 0;
    return {a, b, c};
  }

 private:
  [[nodiscard]] std::size_t below(std::size_t n) noexcept {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t mixed = (state_ ^ state_ >> 30) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ mixed >> 27) * 0x94D049BB133111EBu;
    return static_cast<std::size_t>((((mixed ^ mixed >> 31) >> 32) * n) >> 32);
  }

  std::uint64_t state_;
  std::size_t count_;
};

/// Has each edge about the same length in source and target? Motions keep lengths, so that most samples with a wrong
/// pair are found out here, for a hundredth of the cost.
[[nodiscard]] inline bool has_similar_edges(const std::array<PointPair, 3>& sample, float similarity) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    const PointPair& a = sample[i];
    const PointPair& b = sample[(i + 1) % 3];
    const float source = squared_distance(a.source, b.source);
    const float target = squared_distance(a.target, b.target);
    if (!(std::min(source, target) >= similarity * similarity * std::max(source, target))) return false;
  }
  return true;
}

/// Pairs, and how near to its target a motion must take a source.
template <class Pairs>
struct Consensus {
  const Pairs& pairs;
  Radius reach;

  [[nodiscard]] bool agrees(const Pose& pose, const PointPair& pair) const noexcept {
    return squared_distance(pair.target, apply(pose, pair.source)) < reach.squared;
  }
  [[nodiscard]] std::size_t count(const Pose& pose) const noexcept {
    return static_cast<std::size_t>(
        std::count_if(pairs.begin(), pairs.end(), [&](const PointPair& pair) { return agrees(pose, pair); }));
  }
  void find(const Pose& pose, std::vector<std::uint32_t>& inliers) const {
    inliers.clear();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (agrees(pose, pairs[i])) inliers.push_back(static_cast<std::uint32_t>(i));
    }
  }

  /// Fits the pose to its inliers, and again while their number grows.
  void refine(Pose& pose, std::vector<std::uint32_t>& inliers) const {
    constexpr int most_fits = 5;
    std::vector<PointPair> agreeing;
    std::vector<std::uint32_t> refined_inliers;
    bool grows = true;
    for (int fit = 0; fit < most_fits && grows; ++fit) {
      agreeing.clear();
      for (const std::uint32_t i : inliers) agreeing.push_back(pairs[i]);
      Pose refined;
      if (align(agreeing, refined) != Status::ok) return;
      find(refined, refined_inliers);
      if (refined_inliers.size() < inliers.size()) return;
      grows = refined_inliers.size() > inliers.size();
      pose = refined;
      inliers.swap(refined_inliers);
    }
  }
};

}  // namespace detail

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
  const Status usable = detail::check_pairs(pairs);
  return usable == Status::ok ? detail::align(pairs, pose) : usable;
}

/// The rigid motion that most of the pairs agree on, others being wrong: RANSAC (Fischler and Bolles 1981) over samples
/// of three whose edges have similar lengths, then a least-squares fit to the inliers, repeated while their number
/// grows.
///
/// `pairs`     up to 2^32 - 1 PointPairs: a std::vector, a std::array or the like
/// `inliers`   numbers of the pairs that the pose takes closer to their targets than the inlier distance, ascending.
///             Three pairs often agree by chance: judge a pose by how many they are
///
/// The same samples, inliers and pose for a seed, bit for bit, on every machine.
///
/// Statuses: bad_option, too_few_pairs (fewer than three), invalid_keypoint (a coordinate is not finite), no_pose (no
/// sample has a pose that three pairs agree on). `pose` is all zeros and `inliers` empty then. O(iterations * pairs) at
/// worst. Allocates the inliers, twice, and a copy of their pairs. Calls may run at the same time.
template <class Pairs>
[[nodiscard]] Status estimate_pose(const Pairs& pairs, const RansacOptions& options, Pose& pose,
                                   std::vector<std::uint32_t>& inliers) {
  pose = Pose{};
  inliers.clear();
  Status usable = check(options);
  if (usable == Status::ok) usable = detail::check_pairs(pairs);
  if (usable != Status::ok) return usable;

  const detail::Consensus<Pairs> consensus{pairs, options.inlier_distance};
  detail::Samples samples(options.seed, pairs.size());
  Pose best{};
  std::size_t most = 0;
  for (std::uint32_t iteration = 0; iteration < options.iterations; ++iteration) {
    const auto index = samples.draw();
    const std::array<PointPair, 3> sample{pairs[index[0]], pairs[index[1]], pairs[index[2]]};
    Pose candidate;
    if (!detail::has_similar_edges(sample, options.edge_similarity)) continue;
    if (detail::align(sample, candidate) != Status::ok) continue;
    const std::size_t agreeing = consensus.count(candidate);
    if (agreeing <= most) continue;
    most = agreeing;
    best = candidate;
  }
  if (most < 3) return Status::no_pose;
  pose = best;
  consensus.find(pose, inliers);
  consensus.refine(pose, inliers);
  return Status::ok;
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
