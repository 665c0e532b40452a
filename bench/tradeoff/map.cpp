#include "tradeoff/map.hpp"

#include <algorithm>
#include <cmath>

#include "speed/scaling/json_rows.hpp"

namespace shortshot_bench::tradeoff {
namespace {

/// By configuration, at -Os with brute-force search.
std::map<std::string, OnBoard> boards_of(const std::string& firmware_json) {
  std::map<std::string, OnBoard> boards;
  const nlohmann::ordered_json recorded = scaling::read_json(firmware_json);
  for (const auto& figure : recorded.at("figures")) {
    if (figure.at("target") != "m7" || figure.at("level") != "Os" || figure.at("workspace") != "full") continue;
    boards[figure.at("configuration")] = {figure.value("flash_brute", 0.0), figure.value("work_per_neighbor", 0.0)};
  }
  return boards;
}

/// Geometric mean and least of the ratios of an entry's shares to the baseline's; false if it lacks one.
bool score(const std::vector<Measure>& measures, const std::string& entry, const char* baseline, double& mean,
           double& least) {
  double log_sum = 0.0;
  int count = 0;
  least = HUGE_VAL;
  for (const Measure& m : measures) {
    if (!m.info.scored || m.info.baseline != baseline || !m.has(baseline)) continue;
    const double of_baseline = m.pooled(baseline);
    if (!(of_baseline > 0.0)) continue;  // too hard to tell anything
    if (!m.has(entry)) return false;
    const double ratio = m.pooled(entry) / of_baseline;
    log_sum += std::log(ratio);
    least = std::min(least, ratio);
    ++count;
  }
  if (count == 0) return false;
  mean = std::exp(log_sum / count);
  return true;
}

/// Times closer than this are the same: they were measured.
constexpr double time_tolerance = 1.05;

/// Is `other` no worse than `entry` in anything, and better in something?
bool beats(const Entry& other, const Entry& entry) {
  const bool slower = other.cost.relative > time_tolerance * entry.cost.relative;
  if (other.size_bytes > entry.size_bytes || slower || other.score < entry.score) return false;
  const bool faster = time_tolerance * other.cost.relative < entry.cost.relative;
  return other.size_bytes < entry.size_bytes || faster || other.score > entry.score;
}

}  // namespace

Map make_map(const nlohmann::ordered_json& parameters, const paper::UnitResults& results, const Costs& costs,
             const std::string& firmware_json) {
  Map map;
  map.measures = measures_of(parameters, results);
  const std::map<std::string, OnBoard> boards = boards_of(firmware_json);
  for (const auto& json : parameters.at("entries")) {
    Entry entry;
    entry.name = json.at("name");
    entry.size_bytes = json.at("size_bytes");
    entry.kind = static_cast<Kind>(json.at("kind").get<int>());
    if (const auto cost = costs.find(entry.name); cost != costs.end()) entry.cost = cost->second;
    if (const auto board = boards.find(json.at("board_name")); board != boards.end()) entry.board = board->second;
    score(map.measures, entry.name, color_baseline, entry.score, entry.least);
    double least = 0.0;
    score(map.measures, entry.name, shape_baseline, entry.shape, least);
    map.entries.push_back(entry);
  }
  std::stable_sort(map.entries.begin(), map.entries.end(),
                   [](const Entry& a, const Entry& b) { return a.size_bytes < b.size_bytes; });
  for (Entry& entry : map.entries) {
    entry.on_front = entry.score > 0.0 && std::none_of(map.entries.begin(), map.entries.end(), [&](const Entry& other) {
                       return other.score > 0.0 && beats(other, entry);
                     });
  }
  return map;
}

const Entry* best_within(const Map& map, double most_bytes, double most_time_us) {
  const auto value = [](const Entry& e) { return std::pair(e.score, e.shape); };
  const Entry* best = nullptr;
  for (const Entry& entry : map.entries) {
    if (most_bytes > 0.0 && static_cast<double>(entry.size_bytes) > most_bytes) continue;
    if (most_time_us > 0.0 && entry.cost.microseconds > most_time_us) continue;
    if (best == nullptr || value(entry) > value(*best)) best = &entry;
  }
  return best;
}

}  // namespace shortshot_bench::tradeoff
