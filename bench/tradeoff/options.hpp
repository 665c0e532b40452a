// What the map is asked to show.
#pragma once

#include <string>
#include <vector>

#include "paper/campaign/shard.hpp"

namespace shortshot_bench::tradeoff {

struct TradeoffOptions {
  std::string command;            // draw, merge or count
  std::vector<std::string> data;  // folders: data sets; of merge: results
  std::string out = "tradeoff";   // folder of the results
  std::string instructions;       // callgrind's output of `count`; empty: none
  std::string record;             // folder for what bench/TRADEOFF.md shows; empty: none
  campaign::Shard shard;
  unsigned threads = 0;       // 0: as many as there are cores
  double most_bytes = 0.0;    // 0: any number
  double most_time_us = 0.0;  // the same
  bool quick = false;
  bool check = false;
};

/// False if there is nothing to run: help was asked for, or the options are wrong (exit code 2), both said already.
bool parse_options(int argc, const char* const* argv, TradeoffOptions& options, int& exit_code);

}  // namespace shortshot_bench::tradeoff
