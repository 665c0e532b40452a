// What match does: reads, matches, prints and draws.
#pragma once

#include "tools/match/options.hpp"

namespace shortshot_bench {

/// True if B was found in A. Throws InputError for a file that cannot be read or written, with its name and the line or
/// byte, and std::runtime_error for clouds that cannot be described.
bool run_match(const MatchCommand& command);

}  // namespace shortshot_bench
