// Poses found among the correspondences of two views, some of which are wrong, and how far they are from the true one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "paper/datasets/rigid_motion.hpp"
#include "paper/truth.hpp"

namespace shortshot_bench::paper {

/// One run of RANSAC.
struct Trial {
  bool found = false;          // a motion; if not, the rest means nothing
  double t_diff = 0.0;         // equation 9
  double rotation_deg = 0.0;   // between the motion and the true one
  double translation_m = 0.0;  // between where both bring the centroid of the source's key points
  std::size_t inliers = 0;     // c_r
};

nlohmann::ordered_json to_json(const std::vector<Trial>& trials);
std::vector<Trial> trials_of(const nlohmann::ordered_json& json);

/// What matches and poses are judged by.
class MotionTruth : public Truth {
 public:
  MotionTruth(const datasets::RigidMotion& motion, const View& source, const View& target, float correct_distance);

  Trial trial(const shortshot::Pose& pose, std::size_t inliers) const;

 private:
  datasets::RigidMotion motion_;
  Place centroid_;
};

struct RansacSettings {
  std::uint32_t iterations;
  float inlier_distance;  // meters
  std::uint32_t seeds;    // runs
};

/// A trial for each seed, from 1 on.
std::vector<Trial> estimate_poses(const std::vector<shortshot::PointPair>& pairs, const RansacSettings& settings,
                                  const MotionTruth& truth);

/// Equation 9: the Frobenius norm of the difference of two 4 x 4 motions, row-major.
double t_diff(const datasets::RigidMotion& a, const datasets::RigidMotion& b);

}  // namespace shortshot_bench::paper
