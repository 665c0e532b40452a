#include "paper/experiment.hpp"

#include <cstdio>

namespace shortshot_bench::paper {

void add_unit(Experiment& experiment, campaign::Unit unit) {
  experiment.parameters["units"].push_back(unit.key);
  experiment.units.push_back(std::move(unit));
}

void say_unused(const std::vector<std::string>& folders, const std::string& looked_for) {
  if (folders.empty()) return;
  std::string names;
  for (const std::string& folder : folders) names += (names.empty() ? "" : ", ") + folder_name(folder);
  std::fprintf(stderr, "not used: %s (without %s)\n", names.c_str(), looked_for.c_str());
}

ViewSettings with_options(ViewSettings settings, const PaperOptions& options) {
  settings.radius = options.radius_m.value_or(settings.radius);
  settings.leaf = options.leaf_m.value_or(settings.leaf);
  settings.normal_radius = options.normal_radius_m.value_or(settings.normal_radius);
  settings.seed = options.seed;
  return settings;
}

nlohmann::ordered_json to_json(const ViewSettings& settings) {
  return {{"voxel_m", settings.voxel},
          {"radius_m", settings.radius},
          {"keypoint_leaf_m", settings.leaf},
          {"normal_radius_m", settings.normal_radius},
          {"most_keypoints", settings.most_keypoints},
          {"seed", settings.seed}};
}

nlohmann::ordered_json to_json(const std::vector<Configuration>& configurations) {
  auto list = nlohmann::ordered_json::array();
  for (const Configuration& c : configurations) {
    list.push_back({{"name", c.name}, {"size_bytes", c.size_bytes()}, {"layout", c.layout}});
  }
  return list;
}

std::string text_of(const campaign::Interval& interval, int digits) {
  char text[96];
  std::snprintf(text, sizeof text, "%.*f [%.*f, %.*f]", digits, interval.value, digits, interval.low, digits,
                interval.high);
  return text;
}

std::string percent_of(const campaign::Interval& interval) {
  return text_of({100.0 * interval.value, 100.0 * interval.low, 100.0 * interval.high}, 1);
}

}  // namespace shortshot_bench::paper
