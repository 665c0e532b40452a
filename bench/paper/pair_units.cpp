#include "paper/pair_units.hpp"

#include <algorithm>

namespace shortshot_bench::paper {
namespace {

constexpr std::size_t quick_pairs = 5;  // of each set

std::vector<std::size_t> chosen_pairs(const datasets::PairSet& set, bool quick, std::size_t frame_step) {
  if (quick) return datasets::every_nth_by_rotation(set, std::max<std::size_t>(1, set.size() / quick_pairs));
  return datasets::every_nth_by_rotation(set, set.name == "frames" ? frame_step : 1);
}

nlohmann::ordered_json to_json(const MatchingSettings& settings) {
  return {{"clouds", to_json(settings.source)},
          {"correct_distance_m", settings.correct_distance},
          {"inlier_distance_m", settings.inlier_distance},
          {"ransac_iterations", settings.iterations},
          {"ransac_runs", settings.seeds},
          {"all_of_target", settings.all_of_target}};
}

void add_set(Experiment& experiment, const std::string& folder, const datasets::PairSet& set,
             const PaperOptions& options, std::size_t frame_step, const PairWork& work) {
  const std::string name = folder + " " + set.name;
  MatchingSettings settings = matching_settings(set.name);
  settings.source = settings.target = with_options(settings.source, options);
  settings.all_of_target = options.all_of_target;
  if (options.tolerance_m > 0.0f) settings.correct_distance = settings.inlier_distance = options.tolerance_m;
  auto pairs = nlohmann::ordered_json::array();
  for (const std::size_t i : chosen_pairs(set, options.quick, frame_step)) {
    const std::string key = name + "/" + set.pair_names[i];
    pairs.push_back({{"key", key}, {"group", set.groups[i]}, {"rotation_deg", set.rotation_deg[i]}});
    add_unit(experiment, {key, [set, i, settings, work] { return work(set.load(i), settings); }});
  }
  experiment.parameters["sets"].push_back({{"name", name},
                                           {"kind", set.name},
                                           {"has_color", set.has_color},
                                           {"settings", to_json(settings)},
                                           {"pairs", pairs}});
}

}  // namespace

Experiment pair_experiment(const std::string& name, const nlohmann::ordered_json& descriptors,
                           const PaperOptions& options, std::size_t frame_step, const PairWork& work) {
  Experiment experiment;
  experiment.parameters = {{"experiment", name},
                           {"seed", options.seed},
                           {"quick", options.quick},
                           {"meters_in_a_unit", options.scale},
                           {"descriptors", descriptors}};
  const auto open = [](const std::string& folder) { return datasets::open_pair_sets(folder); };
  for (const auto& found : open_folders(options.data, open, datasets::looked_for_pairs)) {
    for (const datasets::PairSet& set : found.sets) {
      add_set(experiment, found.name, datasets::scaled(set, options.scale), options, frame_step, work);
    }
  }
  return experiment;
}

}  // namespace shortshot_bench::paper
