// How well descriptors bring two clouds together: reciprocal nearest neighbors, and the pose that most of them agree
// on.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paper/contenders.hpp"
#include "paper/matching.hpp"
#include "paper/pose_trials.hpp"
#include "paper/ratio_curve.hpp"

namespace shortshot_bench::paper {

/// What one form of a descriptor makes of one pair.
struct Registration {
  std::string descriptor;
  std::size_t size_bytes = 0;
  double microseconds = 0.0;   // of describing a key point
  std::size_t reciprocal = 0;  // correspondences
  std::size_t correct = 0;     // those within correct_distance of the true place
  std::vector<Trial> trials;   // poses
  RatioCurve curve;

  double inlier_ratio() const;                         // correct of all correspondences; 0 if there are none
  double within(double degrees, double meters) const;  // the share of poses that are that near to the true one
};

/// Each form of each contender; those that need colors are left out where a cloud has none. Throws std::runtime_error.
std::vector<Registration> register_pair(const datasets::ViewPair& pair, const MatchingSettings& settings,
                                        const std::vector<Contender>& contenders);

nlohmann::ordered_json to_json(const std::vector<Registration>& registrations);
std::vector<Registration> registrations_of(const nlohmann::ordered_json& json);

}  // namespace shortshot_bench::paper
