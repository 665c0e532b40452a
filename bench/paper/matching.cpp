#include "paper/matching.hpp"

namespace shortshot_bench::paper {
namespace {

Matching match(const Described& source, const Described& target, const MatchingSettings& settings,
               const MotionTruth& truth) {
  Matching matching;
  matching.keypoints = source.keypoints.size();
  const RightMatches nearest = count_right_nearest(source, target, truth);
  matching.matchable = nearest.of;
  matching.correct_nearest = nearest.right;
  const ReciprocalMatches matches = match_reciprocally(source, target, truth);
  matching.reciprocal = matches.pairs.size();
  matching.correct = matches.right;
  matching.trials =
      estimate_poses(matches.pairs, {settings.iterations, settings.inlier_distance, settings.seeds}, truth);
  return matching;
}

}  // namespace

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
    list.push_back({{"descriptor", m.descriptor},
                    {"keypoints", m.keypoints},
                    {"matchable", m.matchable},
                    {"correct_nearest", m.correct_nearest},
                    {"reciprocal", m.reciprocal},
                    {"correct", m.correct},
                    {"trials", to_json(m.trials)}});
  }
  return list;
}

std::vector<Matching> matchings_of(const nlohmann::ordered_json& json) {
  std::vector<Matching> matchings;
  for (const auto& m : json) {
    Matching matching{m.at("descriptor"), m.at("keypoints"), m.at("matchable"),        m.at("correct_nearest"),
                      m.at("reciprocal"), m.at("correct"),   trials_of(m.at("trials"))};
    matchings.push_back(matching);
  }
  return matchings;
}

}  // namespace shortshot_bench::paper
