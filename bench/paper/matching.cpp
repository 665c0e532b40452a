#include "paper/matching.hpp"

#include <algorithm>
#include <cmath>

namespace shortshot_bench::paper {
namespace {

using Motion = std::array<double, 16>;
using Place = std::array<double, 3>;

Place moved(const Motion& t, const Place& p) {
  Place q;
  for (std::size_t i = 0; i < 3; ++i) q[i] = t[4 * i] * p[0] + t[4 * i + 1] * p[1] + t[4 * i + 2] * p[2] + t[4 * i + 3];
  return q;
}

double distance(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

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

Place centroid_of(const std::vector<Place>& places) {
  Place mean{};
  for (const Place& p : places) {
    for (std::size_t i = 0; i < 3; ++i) mean[i] += p[i] / static_cast<double>(places.size());
  }
  return mean;
}

std::vector<Place> places_of(const View& view) {
  std::vector<Place> places;
  for (const shortshot::KeyPoint& k : view.keypoints()) {
    places.push_back(
        {static_cast<double>(k.position.x), static_cast<double>(k.position.y), static_cast<double>(k.position.z)});
  }
  return places;
}

/// Where the source's key points truly lie in the target, and which of the target's are close enough to that.
class Truth {
 public:
  Truth(const Motion& motion, const View& source, const View& target, float correct_distance)
      : motion_(motion),
        correct_distance_(static_cast<double>(correct_distance)),
        source_(places_of(source)),
        target_(places_of(target)),
        centroid_(centroid_of(source_)) {
    for (std::size_t i = 0; i < source_.size(); ++i) {
      const Place place = moved(motion_, source_[i]);
      matchable_.push_back(std::any_of(target_.begin(), target_.end(),
                                       [&](const Place& t) { return distance(place, t) <= correct_distance_; }));
    }
  }

  bool is_matchable(std::size_t source) const { return matchable_[source]; }
  bool is_correct(std::size_t source, std::size_t target) const {
    return distance(moved(motion_, source_[source]), target_[target]) <= correct_distance_;
  }
  Trial trial(const shortshot::Pose& pose, std::size_t inliers) const {
    const Motion found = motion_of(pose);
    return {true, t_diff(found, motion_), rotation_between_deg(found, motion_),
            distance(moved(found, centroid_), moved(motion_, centroid_)), inliers};
  }

 private:
  Motion motion_;
  double correct_distance_;
  std::vector<Place> source_;
  std::vector<Place> target_;
  Place centroid_;
  std::vector<bool> matchable_;
};

void count_nearest(const Described& source, const Described& target, const Truth& truth, Matching& matching) {
  std::vector<shortshot::Match> nearest;
  require(shortshot::nearest(source.rows().descriptors, target.rows().descriptors, 1, nearest));
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (!truth.is_matchable(i)) continue;
    ++matching.matchable;
    if (nearest[i].row != shortshot::no_row && truth.is_correct(i, nearest[i].row)) ++matching.correct_nearest;
  }
}

void estimate_poses(const std::vector<shortshot::PointPair>& pairs, const MatchingSettings& settings,
                    const Truth& truth, Matching& matching) {
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

Matching match(const Described& source, const Described& target, const MatchingSettings& settings, const Truth& truth) {
  Matching matching;
  matching.keypoints = source.keypoints.size();
  count_nearest(source, target, truth, matching);
  std::vector<shortshot::MatchedPair> correspondences;
  require(shortshot::reciprocal_correspondences(source.rows().descriptors, target.rows().descriptors, correspondences));
  std::vector<shortshot::PointPair> pairs;
  for (const shortshot::MatchedPair& c : correspondences) {
    pairs.push_back({source.keypoints[c.source].position, target.keypoints[c.target].position});
    if (truth.is_correct(c.source, c.target)) ++matching.correct;
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
  const Truth truth(pair.truth, source, target, settings.correct_distance);
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
