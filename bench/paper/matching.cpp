#include "paper/matching.hpp"

#include <algorithm>
#include <cmath>

#include "paper/truth.hpp"

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

/// What poses are judged by, too.
class MotionTruth : public Truth {
 public:
  MotionTruth(const Motion& motion, const View& source, const View& target, float correct_distance)
      : Truth(motion, source, target, correct_distance), motion_(motion), centroid_(centroid_of(source)) {}

  Trial trial(const shortshot::Pose& pose, std::size_t inliers) const {
    const Motion found = motion_of(pose);
    return {true, t_diff(found, motion_), rotation_between_deg(found, motion_),
            distance(moved(found, centroid_), moved(motion_, centroid_)), inliers};
  }

 private:
  Motion motion_;
  Place centroid_;
};

void estimate_poses(const std::vector<shortshot::PointPair>& pairs, const MatchingSettings& settings,
                    const MotionTruth& truth, Matching& matching) {
  for (std::uint32_t seed = 1; seed <= settings.seeds; ++seed) {
    shortshot::RansacOptions options;
    options.iterations = settings.iterations;
    options.inlier_distance = settings.inlier_distance;
    options.seed = seed;
    shortshot::Pose pose;
    std::vector<std::uint32_t> inliers;
    const bool found = shortshot::estimate_pose(pairs, options, pose, inliers) == shortshot::Status::ok;
    matching.trials.push_back(found ? truth.trial(pose, inliers.size()) : Trial{});
  }
}

Matching match(const Described& source, const Described& target, const MatchingSettings& settings,
               const MotionTruth& truth) {
  Matching matching;
  matching.keypoints = source.keypoints.size();
  const RightMatches nearest = count_right_nearest(source, target, truth);
  matching.matchable = nearest.of;
  matching.correct_nearest = nearest.right;
  std::vector<shortshot::MatchedPair> correspondences;
  require(shortshot::reciprocal_correspondences(source.rows().descriptors, target.rows().descriptors, correspondences));
  std::vector<shortshot::PointPair> pairs;
  for (const shortshot::MatchedPair& c : correspondences) {
    pairs.push_back({source.keypoints[c.source].position, target.keypoints[c.target].position});
    if (truth.is_right(c.source, c.target)) ++matching.correct;
  }
  matching.reciprocal = pairs.size();
  estimate_poses(pairs, settings, truth, matching);
  return matching;
}

}  // namespace

double t_diff(const std::array<double, 16>& a, const std::array<double, 16>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 16; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

MatchingSettings matching_settings(const std::string& kind) {
  const bool frames = kind == "frames";
  MatchingSettings settings;
  ViewSettings& view = settings.source;
  view.leaf = frames ? 0.02f : 0.01f;
  view.normal_radius = frames ? 0.03f : 0.01f;
  if (kind == "views") settings.correct_distance = settings.inlier_distance = 0.005f;
  if (frames) {
    view.voxel = 0.01f;
    view.radius = 0.2f;
    view.most_keypoints = 1800;
    settings.correct_distance = settings.inlier_distance = 0.03f;
  }
  settings.target = view;
  return settings;
}

std::vector<Matching> match_pair(const datasets::ViewPair& pair, const MatchingSettings& settings,
                                 const std::vector<Configuration>& configurations) {
  const View source(pair.source, settings.source);
  const View target(pair.target, settings.target);
  const MotionTruth truth(pair.truth, source, target, settings.correct_distance);
  std::vector<Matching> matchings;
  for (const Configuration& configuration : configurations) {
    if (configuration.needs_colors && !(source.has_colors() && target.has_colors())) continue;
    Configuration for_target = configuration;
    if (settings.all_of_target) for_target.kept = {};
    matchings.push_back(match(source.describe(configuration), target.describe(for_target), settings, truth));
    matchings.back().descriptor = configuration.name;
  }
  return matchings;
}

nlohmann::ordered_json to_json(const std::vector<Matching>& matchings) {
  auto list = nlohmann::ordered_json::array();
  for (const Matching& m : matchings) {
    auto trials = nlohmann::ordered_json::array();
    for (const Trial& t : m.trials) {
      trials.push_back({{"found", t.found},
                        {"t_diff", t.t_diff},
                        {"rotation_deg", t.rotation_deg},
                        {"translation_m", t.translation_m},
                        {"inliers", t.inliers}});
    }
    list.push_back({{"descriptor", m.descriptor},
                    {"keypoints", m.keypoints},
                    {"matchable", m.matchable},
                    {"correct_nearest", m.correct_nearest},
                    {"reciprocal", m.reciprocal},
                    {"correct", m.correct},
                    {"trials", trials}});
  }
  return list;
}

std::vector<Matching> matchings_of(const nlohmann::ordered_json& json) {
  std::vector<Matching> matchings;
  for (const auto& m : json) {
    Matching matching{m.at("descriptor"),
                      m.at("keypoints"),
                      m.at("matchable"),
                      m.at("correct_nearest"),
                      m.at("reciprocal"),
                      m.at("correct"),
                      {}};
    for (const auto& t : m.at("trials")) {
      matching.trials.push_back(
          {t.at("found"), t.at("t_diff"), t.at("rotation_deg"), t.at("translation_m"), t.at("inliers")});
    }
    matchings.push_back(matching);
  }
  return matchings;
}

}  // namespace shortshot_bench::paper
