// How sure a pose is: how many poses as good as it chance alone would find.
//
// A contrario, after L. Moisan, B. Stival: A probabilistic criterion to detect rigid point matches between two images
// and estimate the fundamental matrix (IJCV 57, 2004).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shortshot/shortshot.hpp"

namespace shortshot_bench {

struct Chance {
  double agreement = 0.0;    // that a wrong pair agrees with the pose: of all pairs, with any target in place of theirs
  std::size_t places = 0;    // with a pair, farther apart than the support's radius: independent of each other
  std::size_t agreeing = 0;  // of these, with a pair that agrees
  double at_place = 0.0;     // that one of the wrong pairs of a place agrees
  double log10_expected = 0.0;  // poses that agree at as many places, of all that were tried
};

/// `pairs`    as for estimate_pose(); `inliers` what it gave, for a pose
/// `targets`  all places that a pair might have led to
/// `reach`    the inlier distance
/// `apart`    pairs that are nearer to each other see the same surface, and are wrong together
/// `tried`    poses
///
/// If all pairs were wrong, each would lead to any of the targets. A pose of three pairs then has the others' agreement
/// by chance: by the binomial distribution, where those of a place count once, and the three not at all.
Chance chance_of(const std::vector<shortshot::PointPair>& pairs, const std::vector<std::uint32_t>& inliers,
                 const shortshot::Pose& pose, const std::vector<shortshot::Point>& targets, float reach, float apart,
                 std::size_t tried);

/// log10 of the probability of `least` successes or more in `trials`.
double log10_binomial_tail(std::size_t trials, std::size_t least, double probability);

}  // namespace shortshot_bench
