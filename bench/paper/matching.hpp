// Section VI-A of the paper: how well key points of two clouds with a known motion between them are matched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paper/configuration.hpp"
#include "paper/datasets/pair_sets.hpp"
#include "paper/pose_trials.hpp"
#include "paper/view.hpp"

namespace shortshot_bench::paper {

struct MatchingSettings {
  ViewSettings source;
  ViewSettings target;
  float correct_distance = 0.01f;  // of a match from the true place, at most; meters
  float inlier_distance = 0.01f;   // of RANSAC; meters
  std::uint32_t iterations = 5000;
  std::uint32_t seeds = 3;     // RANSAC runs of each pair
  bool all_of_target = false;  // key points are left out of the source alone
};

/// The protocol's for a PairSet of that name: "object-scene", "views" or "frames".
MatchingSettings matching_settings(const std::string& kind);

/// What one descriptor makes of one pair.
struct Matching {
  std::string descriptor;
  std::size_t keypoints = 0;        // k_m, of the source
  std::size_t matchable = 0;        // those with a target key point within correct_distance of the true place
  std::size_t correct_nearest = 0;  // matchable ones whose nearest neighbor is that close to the true place
  std::size_t reciprocal = 0;       // correspondences
  std::size_t correct = 0;          // correspondences that close to the true place
  std::vector<Trial> trials;
};

/// Each descriptor on one pair; those that need colors are left out where a cloud has none. The clouds must have a
/// point each; throws std::runtime_error.
std::vector<Matching> match_pair(const datasets::ViewPair& pair, const MatchingSettings& settings,
                                 const std::vector<Configuration>& configurations);

nlohmann::ordered_json to_json(const std::vector<Matching>& matchings);
std::vector<Matching> matchings_of(const nlohmann::ordered_json& json);

}  // namespace shortshot_bench::paper
