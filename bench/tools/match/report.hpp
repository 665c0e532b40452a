// What was matched, in words and numbers.
#pragma once

#include <string>

#include "tools/match/match.hpp"

namespace shortshot_bench {

/// The pose as four rows of four numbers: what takes a point of b, (x, y, z, 1), to a.
std::string pose_text(const shortshot::Pose& pose);

void print_report(const MatchResult& result, double milliseconds);

/// Found (1 or 0), pairs that agree, pairs, places that agree, places, log10 of what chance would find, the share of b
/// on a, and the pose row by row: a line, the pose all zeros if nothing was found.
std::string quiet_line(const MatchResult& result);

}  // namespace shortshot_bench
