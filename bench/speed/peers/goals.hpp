// The goals of the speed work, and what was measured of them.
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "speed/peers/measure.hpp"

namespace shortshot_bench::peers {

inline constexpr std::array<const char*, 2> builds{{"O2", "avx2"}};
using PerBuild = std::array<std::optional<double>, builds.size()>;  // nothing: not measured

enum class Limit { at_least, at_most, none };

struct Goal {
  std::string name;
  Limit limit;
  PerBuild bound;
  PerBuild (*measured)(const CloudResult& result);
  std::string if_missing;  // how to measure it
};

/// All of them, in their table's order.
const std::vector<Goal>& goals();

/// The worst cloud of a goal in one build.
struct Worst {
  std::string cloud;
  double value;
  bool met;
};

std::optional<Worst> worst_of(const Goal& goal, std::size_t build, const std::vector<CloudResult>& results);

/// One object per goal and build, with the values of all clouds and the worst one.
nlohmann::ordered_json goals_to_json(const std::vector<CloudResult>& results);

void print_goals(const std::vector<CloudResult>& results);

}  // namespace shortshot_bench::peers
