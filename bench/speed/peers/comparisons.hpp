// Each of our contenders against each peer that it is compared with.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "speed/peers/measure.hpp"

namespace shortshot_bench::peers {

/// How many times as long the peer takes.
struct Comparison {
  const MeasuredContender* ours;
  const MeasuredContender* peer;
  double ratio_per_keypoint;
  double ratio_frame;
};

/// In the order of ours; they point into the result.
std::vector<Comparison> compare(const CloudResult& result);

/// A list of one object per comparison.
nlohmann::ordered_json to_json(const CloudResult& result);

void print_result(const CloudResult& result);

}  // namespace shortshot_bench::peers
