// Mean shift as recognize() does it, for stages_of_isa.cpp alone.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "shortshot/shortshot.hpp"

namespace shortshot_bench {
namespace {

/// Of one class, all over a cubic meter. The same ones on every machine: the engine's output is specified.
inline std::vector<shortshot::detail::Vote> votes_in_cubic_meter(std::size_t count) {
  std::mt19937 random(1);
  const auto coordinate = [&random] { return static_cast<float>(random() >> 8) / 16777216.0f; };
  std::vector<shortshot::detail::Vote> votes(count);
  for (shortshot::detail::Vote& vote : votes) {
    for (float* const axis : {&vote.center.x, &vote.center.y, &vote.center.z}) *axis = coordinate();
  }
  return votes;
}

/// From every vote, on one thread. Returns the sum of the maxima's densities.
[[gnu::noinline]] inline float climb_from_all(const std::vector<shortshot::detail::Vote>& votes, float bandwidth) {
  const shortshot::detail::MeanShift shift(votes.data(), votes.data() + votes.size(), bandwidth);
  shortshot::detail::MeanShift::Memory memory(votes.size());
  float sum = 0.0f;
  shift.for_each_vote([&](std::size_t vote) { sum += shift.climb(votes[vote], memory).density; });
  return sum;
}

}  // namespace
}  // namespace shortshot_bench
