// The map: what each entry costs and how good it is, which are worth their bytes and their time, and which is the best
// within limits.
#pragma once

#include <string>
#include <vector>

#include "paper/figures.hpp"
#include "tradeoff/cost.hpp"
#include "tradeoff/items.hpp"

namespace shortshot_bench::tradeoff {

/// On a Cortex-M7, from the recorded figures of microcontrollers; 0: not built.
struct OnBoard {
  double flash_bytes = 0.0;
  double instructions_per_neighbor = 0.0;
};

struct Entry {
  std::string name;
  std::size_t size_bytes = 0;
  Kind kind = Kind::relative;
  Cost cost;
  OnBoard board;
  double score = 0.0;     // geometric mean of its ratios to the baseline, over the scored measures with color
  double least = 0.0;     // of these ratios
  double shape = 0.0;     // the score without color, against SHOT; 0: it needs colors, or there are no such data
  bool on_front = false;  // no other is as small and as fast and scores as much
};

struct Map {
  std::vector<Entry> entries;     // by bytes
  std::vector<Measure> measures;  // as in the parameters
};

Map make_map(const nlohmann::ordered_json& parameters, const paper::UnitResults& results, const Costs& costs,
             const std::string& firmware_json);

/// The entry with the highest score (of those without one, shape) within the limits (0: none); null if there is none.
const Entry* best_within(const Map& map, double most_bytes, double most_time_us);

/// Tables, and plots drawn into `directory`.
paper::Findings report_of(const Map& map, const nlohmann::ordered_json& parameters, const std::string& directory);

}  // namespace shortshot_bench::tradeoff
