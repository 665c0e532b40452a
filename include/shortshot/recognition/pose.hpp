// shortshot/recognition/pose.hpp: the rigid motion that takes points to their correspondences, some of which are wrong,
// by RANSAC. Hosted only: allocates.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../base/math.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../status.hpp"
#include "fit_pose.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Options of estimate_pose().
struct RansacOptions {
  std::uint32_t iterations = 5000;  ///< samples of three pairs, from 1 on
  float inlier_distance = 0.01f;    ///< meters between target and moved source; above 0, and its square a normal float
  float edge_similarity = 0.9f;     ///< 0 to 1: samples with an edge whose lengths differ by more are skipped
  std::uint32_t seed = 1;           ///< of the samples' sequence
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

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
    c += c >= std::min(a, b) ? 1u : 0u;
    c += c >= std::max(a, b) ? 1u : 0u;
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
struct Consensus {
  PairsView pairs;
  Radius reach;

  [[nodiscard]] bool agrees(const Pose& pose, const PointPair& pair) const noexcept {
    return squared_distance(pair.target, transform_point(pose, pair.source)) < reach.squared;
  }
  [[nodiscard]] std::size_t count(const Pose& pose) const noexcept {
    std::size_t count = 0;
    for (const PointPair& pair : pairs) count += agrees(pose, pair) ? 1u : 0u;
    return count;
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
      if (align(PairsView(agreeing), refined) != Status::ok) return;
      find(refined, refined_inliers);
      if (refined_inliers.size() < inliers.size()) return;
      grows = refined_inliers.size() > inliers.size();
      pose = refined;
      inliers.swap(refined_inliers);
    }
  }
};

/// estimate_pose() for options and pairs that were checked.
[[nodiscard]] inline Status find_pose(const PairsView& pairs, const RansacOptions& options, Pose& pose,
                                      std::vector<std::uint32_t>& inliers) {
  const Consensus consensus{pairs, options.inlier_distance};
  Samples samples(options.seed, pairs.size());
  std::size_t most = 0;
  for (std::uint32_t iteration = 0; iteration < options.iterations; ++iteration) {
    const auto index = samples.draw();
    const std::array<PointPair, 3> sample{pairs[index[0]], pairs[index[1]], pairs[index[2]]};
    Pose candidate;
    if (!has_similar_edges(sample, options.edge_similarity)) continue;
    if (align(PairsView(sample), candidate) != Status::ok) continue;
    const std::size_t agreeing = consensus.count(candidate);
    if (agreeing <= most) continue;
    most = agreeing;
    pose = candidate;
  }
  if (most < 3) {
    pose = Pose{};
    return Status::no_pose;
  }
  consensus.find(pose, inliers);
  consensus.refine(pose, inliers);
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

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
  const detail::PairsView view(pairs);
  Status usable = validate(options);
  if (usable == Status::ok) usable = detail::check_pairs(view);
  return usable == Status::ok ? detail::find_pose(view, options, pose, inliers) : usable;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
