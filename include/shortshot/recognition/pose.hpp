// shortshot/recognition/pose.hpp: the rigid motion that takes points to their correspondences, by least squares, and by
// RANSAC where some correspondences are wrong. Hosted only: allocates. Needs Eigen.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "../base/math.hpp"
#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

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

/// ok or bad_option.
[[nodiscard]] inline Status validate(const RansacOptions& options) noexcept {
  const bool similarity = extend::math::is_finite(options.edge_similarity) && options.edge_similarity >= 0.0f &&
                          options.edge_similarity <= 1.0f;
  const bool distance = validate(Radius(options.inlier_distance)) == Status::ok;
  return options.iterations > 0 && similarity && distance ? Status::ok : Status::bad_option;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

// What needs Eigen's solver is a template, also where one type would do: its instantiation takes a compiler seconds,
// for which only those shall wait who ask for a pose.

/// ok, too_few_pairs or invalid_keypoint.
template <class Pairs>
[[nodiscard]] Status check_pairs(const Pairs& pairs) noexcept {
  if (pairs.size() < 3) return Status::too_few_pairs;
  const bool finite = std::all_of(pairs.begin(), pairs.end(), [](const PointPair& pair) {
    return is_finite(pair.source) && is_finite(pair.target);
  });
  return finite ? Status::ok : Status::invalid_keypoint;
}

[[nodiscard]] inline Eigen::Vector3f vector(const Point& p) noexcept { return {p.x, p.y, p.z}; }

/// The mean of some points. Offsets from the first are summed up: clouds may lie far from the origin.
template <class PointAt>
[[nodiscard]] Eigen::Vector3f centroid(std::size_t count, const PointAt& point_at) noexcept {
  const Eigen::Vector3f first = point_at(0);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (std::size_t i = 1; i < count; ++i) sum += point_at(i) - first;
  return first + sum / static_cast<float>(count);
}

/// The matrix whose quadratic form of a unit quaternion (w, x, y, z) says how well this rotation aligns points with a
/// given covariance, source by target (Horn 1987). Only its lower triangle.
template <class Covariance>
[[nodiscard]] Eigen::Matrix4f alignment(const Covariance& c) noexcept {
  Eigen::Matrix4f m = Eigen::Matrix4f::Zero();
  m(0, 0) = c(0, 0) + c(1, 1) + c(2, 2);
  m(1, 1) = c(0, 0) - c(1, 1) - c(2, 2);
  m(2, 2) = c(1, 1) - c(0, 0) - c(2, 2);
  m(3, 3) = c(2, 2) - c(0, 0) - c(1, 1);
  m(1, 0) = c(1, 2) - c(2, 1);
  m(2, 0) = c(2, 0) - c(0, 2);
  m(3, 0) = c(0, 1) - c(1, 0);
  m(2, 1) = c(0, 1) + c(1, 0);
  m(3, 1) = c(2, 0) + c(0, 2);
  m(3, 2) = c(1, 2) + c(2, 1);
  return m;
}

/// Least squares for three pairs or more, all finite.
template <class Pairs>
[[nodiscard]] Status align(const Pairs& pairs, Pose& pose) noexcept {
  pose = Pose{};
  const std::size_t count = pairs.size();
  const auto source_at = [&](std::size_t i) { return vector(pairs[i].source); };
  const auto target_at = [&](std::size_t i) { return vector(pairs[i].target); };
  const Eigen::Vector3f source = centroid(count, source_at);
  const Eigen::Vector3f target = centroid(count, target_at);
  Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();
  for (std::size_t i = 0; i < count; ++i) covariance += (source_at(i) - source) * (target_at(i) - target).transpose();
  const float scale = covariance.cwiseAbs().sum();
  if (!math::is_finite(scale) || !(scale >= std::numeric_limits<float>::min())) return Status::no_pose;

  // Two rotations that align equally well: points on a line, or the mirror image of something symmetric.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4f> solver(alignment(covariance / scale));
  const Eigen::Vector4f& quality = solver.eigenvalues();
  constexpr float tolerance = 1e-5f;  // a hundred times float's rounding
  if (!(quality[3] - quality[2] > tolerance * quality[3])) return Status::no_pose;

  const Eigen::Vector4f q = solver.eigenvectors().col(3);
  const Eigen::Matrix3f rotation = Eigen::Quaternionf(q[0], q[1], q[2], q[3]).toRotationMatrix();
  const Eigen::Vector3f translation = target - rotation * source;
  if (!math::is_finite(translation.cwiseAbs().sum())) return Status::no_pose;
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(pose.rotation) = rotation;
  Eigen::Map<Eigen::Vector3f>(pose.translation) = translation;
  return Status::ok;
}

/// Samples of three different numbers below `count`, from 3 on: the same on every machine, which the standard library's
/// distributions are not.
class Samples {
 public:
  Samples(std::uint32_t seed, std::size_t count) : engine_(seed), count_(count) {}

  [[nodiscard]] std::array<std::size_t, 3> draw() {
    const std::size_t a = below(count_);
    std::size_t b = below(count_ - 1);
    b += b >= a ? 1 : 0;
    std::size_t c = below(count_ - 2);
    c += c >= std::min(a, b) ? 1 : 0;
    c += c >= std::max(a, b) ? 1 : 0;
    return {a, b, c};
  }

 private:
  [[nodiscard]] std::size_t below(std::size_t n) {
    return static_cast<std::size_t>((std::uint64_t{engine_()} * n) >> 32);
  }

  std::mt19937 engine_;
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
    return squared_distance(pair.target, transform_point(pose, pair.source)) < reach.squared;
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
/// line, or squares outside of float's range). `pose` is all zeros then. O(pairs); allocates nothing.
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
/// The samples are the same for a seed on every machine, and the pose but for the rounding of Eigen's arithmetic.
///
/// Statuses: bad_option, too_few_pairs (fewer than three), invalid_keypoint (a coordinate is not finite), no_pose (no
/// sample has a pose that three pairs agree on). `pose` is all zeros and `inliers` empty then. O(iterations * pairs) at
/// worst. Allocates the inliers, twice, and a copy of their pairs. Calls may run at the same time.
template <class Pairs>
[[nodiscard]] Status estimate_pose(const Pairs& pairs, const RansacOptions& options, Pose& pose,
                                   std::vector<std::uint32_t>& inliers) {
  pose = Pose{};
  inliers.clear();
  Status usable = validate(options);
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

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
