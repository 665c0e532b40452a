// The goals of the speed work, and what was measured of them.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "speed/peers/measure.hpp"

namespace shortshot_bench::peers {

/// Plain -O2 is the baseline binary, what distributions build.
inline constexpr std::array<const char*, 2> builds{{"O2", "avx2"}};
using PerBuild = std::array<std::optional<double>, builds.size()>;  // nothing: not measured

enum class Limit { at_least, at_most, none };

struct Goal {
  std::string name;
  Limit limit;
  PerBuild bound;  // nothing: no goal of that build
  std::function<PerBuild(const CloudResult& result)> measured;
  std::string if_missing;  // how to measure it
  std::string cloud{};     // of what is the same with all results
};

/// All of them, in their table's order.
const std::vector<Goal>& goals();

/// Whether a build has that goal or, of those without limits, figure.
bool applies(const Goal& goal, std::size_t build);

/// The worst cloud of a goal in one build.
struct Worst {
  std::string cloud;
  double value;
  bool met;
};

std::optional<Worst> worst_of(const Goal& goal, std::size_t build, const std::vector<CloudResult>& results);

/// One object per goal and build that it applies to, with the values of all clouds and the worst one.
nlohmann::ordered_json goals_to_json(const std::vector<CloudResult>& results);

void print_goals(const std::vector<CloudResult>& results);

}  // namespace shortshot_bench::peers
