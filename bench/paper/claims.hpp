// What the paper says, against what was measured.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "paper/campaign/report.hpp"
#include "paper/campaign/statistics.hpp"

namespace shortshot_bench::paper {

/// Of all bootstraps: the same results give the same report.
inline constexpr std::uint64_t bootstrap_seed = 1;

/// That a figure is not below `at_least`, or, of a gain, that it is above.
struct Claim {
  std::string text;
  std::string figure;  // what was measured
  campaign::Interval interval;
  double at_least;
  std::string likely_reason;  // if it does not hold
  bool above = false;         // nothing gained is no gain
};

/// "holds": all of the interval keeps the limit; "does not hold": none of it does; else "undecided".
std::string verdict(const Claim& claim);

/// All of them with their verdicts, and the reasons of those that do not hold.
campaign::Section section_of(const std::vector<Claim>& claims);

}  // namespace shortshot_bench::paper
