// The goals' verdicts, printed and as JSON.
#include <cstdio>

#include "speed/peers/goals.hpp"

namespace shortshot_bench::peers {
namespace {

std::string bound_of(const Goal& goal, std::size_t build) {
  if (goal.limit == Limit::none) return "report";
  char text[32];
  std::snprintf(text, sizeof text, "%s %.3g", goal.limit == Limit::at_least ? ">=" : "<=", *goal.bound[build]);
  return text;
}

void print_goals_of(std::size_t build, const std::vector<CloudResult>& results) {
  std::printf("Goals, build %s\n%-74s %9s", builds[build], "", "goal");
  for (const CloudResult& result : results) std::printf(" %12.12s", result.cloud.c_str());
  std::printf("   measured\n");
  for (const Goal& goal : goals()) {
    if (!applies(goal, build)) continue;
    std::printf("%-74s %9s", goal.name.c_str(), bound_of(goal, build).c_str());
    const std::optional<Worst> worst = worst_of(goal, build, results);
    for (const CloudResult& result : results) {
      const std::optional<double> value = goal.measured(result)[build];
      value ? std::printf(" %12.4g", *value) : std::printf(" %12s", "-");
    }
    if (worst) {
      const char* verdict = goal.limit == Limit::none ? "" : worst->met ? ", met" : ", MISSED";
      std::printf("   %.4g (%s)%s\n", worst->value, worst->cloud.c_str(), verdict);
    } else {
      std::printf("   not measured: %s\n", goal.if_missing.c_str());
    }
  }
  std::printf("\n");
}

}  // namespace

bool applies(const Goal& goal, std::size_t build) { return goal.limit == Limit::none || goal.bound[build]; }

std::optional<Worst> worst_of(const Goal& goal, std::size_t build, const std::vector<CloudResult>& results) {
  std::optional<Worst> worst;
  for (const CloudResult& result : results) {
    const std::optional<double> value = goal.measured(result)[build];
    if (!value) continue;
    const bool higher_is_worse = goal.limit != Limit::at_least;
    if (worst && (higher_is_worse ? *value <= worst->value : *value >= worst->value)) continue;
    const bool met =
        goal.limit == Limit::none || (higher_is_worse ? *value <= *goal.bound[build] : *value >= *goal.bound[build]);
    worst = Worst{goal.cloud.empty() ? result.cloud : goal.cloud, *value, met};
  }
  return worst;
}

nlohmann::ordered_json goals_to_json(const std::vector<CloudResult>& results) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Goal& goal : goals()) {
    for (std::size_t build = 0; build < builds.size(); ++build) {
      if (!applies(goal, build)) continue;
      nlohmann::ordered_json entry{{"goal", goal.name}, {"build", builds[build]}, {"bound", bound_of(goal, build)}};
      for (const CloudResult& result : results) {
        if (const std::optional<double> value = goal.measured(result)[build]) entry["measured"][result.cloud] = *value;
      }
      if (const auto worst = worst_of(goal, build, results)) {
        entry["worst"] = worst->value;
        entry["worst_cloud"] = worst->cloud;
        if (goal.limit != Limit::none) entry["met"] = worst->met;
      }
      list.push_back(entry);
    }
  }
  return list;
}

void print_goals(const std::vector<CloudResult>& results) {
  for (std::size_t build = 0; build < builds.size(); ++build) print_goals_of(build, results);
}

}  // namespace shortshot_bench::peers
