#include "paper/experiment.hpp"

#include <cstdio>

namespace shortshot_bench::paper {

void add_unit(Experiment& experiment, campaign::Unit unit) {
  experiment.parameters["units"].push_back(unit.key);
  experiment.units.push_back(std::move(unit));
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
