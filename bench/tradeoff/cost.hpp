// What a key point costs: time and instructions of search, frame, descriptor and packing, on a generated tabletop.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tradeoff/candidate.hpp"

namespace shortshot_bench::tradeoff {

/// Of a key point on one core of this machine, with this program's instruction set. Normals, which SHOT and CSHOT need,
/// are not counted, nor is the index.
struct Cost {
  double microseconds = 0.0;
  double relative = 0.0;      // time, over that of scsh336 in floats in the same round
  double instructions = 0.0;  // 0: not counted
};
using Costs = std::map<std::string, Cost>;  // by entry

/// A sentence about the workload.
std::string cost_workload();

/// Medians of some rounds, in each of which all candidates take their turn. Throws std::runtime_error.
Costs measure_times(const std::vector<Candidate>& candidates);

/// Runs every candidate and format once, with a dump for each; under valgrind --tool=callgrind --instr-atstart=no.
void count_instructions(const std::vector<Candidate>& candidates);

/// Puts the instructions that callgrind counted into `costs`, for the entries that are there. Throws
/// std::runtime_error.
void read_instructions(const std::string& callgrind_file, const std::vector<Candidate>& candidates, Costs& costs);

}  // namespace shortshot_bench::tradeoff
