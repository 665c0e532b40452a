#include "paper/pose_trials.hpp"

#include <algorithm>
#include <cmath>

namespace shortshot_bench::paper {
namespace {

using Motion = datasets::RigidMotion;

Motion motion_of(const shortshot::Pose& pose) {
  Motion t{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) t[4 * i + k] = static_cast<double>(pose.rotation[3 * i + k]);
    t[4 * i + 3] = static_cast<double>(pose.translation[i]);
  }
  t[15] = 1.0;
  return t;
}

double rotation_between_deg(const Motion& a, const Motion& b) {
  double trace = 0.0;  // of the one times the other's inverse
  for (const std::size_t i : {0u, 1u, 2u, 4u, 5u, 6u, 8u, 9u, 10u}) trace += a[i] * b[i];
  return std::acos(std::clamp((trace - 1.0) / 2.0, -1.0, 1.0)) * 180.0 / std::acos(-1.0);
}

Place centroid_of(const View& view) {
  Place mean{};
  for (const shortshot::KeyPoint& k : view.keypoints()) {
    const Place p = place_of(k.position);
    for (std::size_t i = 0; i < 3; ++i) mean[i] += p[i] / static_cast<double>(view.keypoints().size());
  }
  return mean;
}

}  // namespace

MotionTruth::MotionTruth(const Motion& motion, const View& source, const View& target, float correct_distance)
    : Truth(motion, source, target, correct_distance), motion_(motion), centroid_(centroid_of(source)) {}

Trial MotionTruth::trial(const shortshot::Pose& pose, std::size_t inliers) const {
  const Motion found = motion_of(pose);
  return {true, t_diff(found, motion_), rotation_between_deg(found, motion_),
          distance(moved(found, centroid_), moved(motion_, centroid_)), inliers};
}

std::vector<Trial> estimate_poses(const std::vector<shortshot::PointPair>& pairs, const RansacSettings& settings,
                                  const MotionTruth& truth) {
  std::vector<Trial> trials;
  for (std::uint32_t seed = 1; seed <= settings.seeds; ++seed) {
    shortshot::RansacOptions options;
    options.iterations = settings.iterations;
    options.inlier_distance = settings.inlier_distance;
    options.seed = seed;
    shortshot::Pose pose;
    std::vector<std::uint32_t> inliers;
    const bool found = shortshot::estimate_pose(pairs, options, pose, inliers) == shortshot::Status::ok;
    trials.push_back(found ? truth.trial(pose, inliers.size()) : Trial{});
  }
  return trials;
}

double t_diff(const Motion& a, const Motion& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 16; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

nlohmann::ordered_json to_json(const std::vector<Trial>& trials) {
  auto list = nlohmann::ordered_json::array();
  for (const Trial& t : trials) {
    list.push_back({{"found", t.found},
                    {"t_diff", t.t_diff},
                    {"rotation_deg", t.rotation_deg},
                    {"translation_m", t.translation_m},
                    {"inliers", t.inliers}});
  }
  return list;
}

std::vector<Trial> trials_of(const nlohmann::ordered_json& json) {
  std::vector<Trial> trials;
  for (const auto& t : json) {
    trials.push_back({t.at("found"), t.at("t_diff"), t.at("rotation_deg"), t.at("translation_m"), t.at("inliers")});
  }
  return trials;
}

}  // namespace shortshot_bench::paper
