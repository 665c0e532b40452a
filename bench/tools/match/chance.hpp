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

/// Points that see the same surface are right or wrong together. Each place has one point whose descriptor is nearest
/// to its match, and those within a distance of it that are in no place yet: chosen without a look at what is to be
/// judged.
struct Places {
  std::vector<std::uint32_t> nearest;  // of each place, its point
  std::vector<std::uint32_t> of;       // of each point, its place
};
Places places_of(const std::vector<shortshot::Point>& points, const std::vector<float>& distances, float apart);

/// At how many places points agree with something, and how probable as many or more are, were all of them wrong.
struct Agreement {
  std::size_t places = 0;
  std::size_t nearest = 0;         // those whose nearest one agrees: each with the probability of a point
  std::size_t any = 0;             // those where any one agrees: with no more than the sum of its points' probabilities
  double log10_probability = 0.0;  // twice the smaller one of both: either may be as good by chance
};

/// `agreeing` are points, ascending; each agrees by chance with this `probability`. `free` of the places count for
/// nothing: what points are compared with was made of them.
Agreement agreement_at(const Places& places, const std::vector<std::uint32_t>& agreeing, double probability,
                       std::size_t free);

struct Chance {
  double agreement =
      0.0;  // that a wrong pair agrees with the pose: mean over all pairs, with any target in place of theirs
  Agreement at;
  double log10_expected = 0.0;  // poses as good, of all that were tried
};

/// `pairs`      as for estimate_pose(); `inliers` what it gave, for a pose, ascending
/// `targets`    all places that a pair might have led to
/// `reach`      the inlier distance
/// `tried`      poses
///
/// If all pairs were wrong, each would lead to any of the targets. A pose of three pairs then has the others' agreement
/// by chance.
Chance chance_of(const std::vector<shortshot::PointPair>& pairs, const std::vector<std::uint32_t>& inliers,
                 const Places& places, const shortshot::Pose& pose, const std::vector<shortshot::Point>& targets,
                 float reach, std::size_t tried);

/// log10 of the probability of `least` successes or more in `trials`.
double log10_binomial_tail(std::size_t trials, std::size_t least, double probability);

}  // namespace shortshot_bench
