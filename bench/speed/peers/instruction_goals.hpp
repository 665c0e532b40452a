// What `./run instructions` counts and commits.
#pragma once

#include <optional>
#include <string>

namespace shortshot_bench::peers {

/// Instructions of a stage per "neighbor", "point" or "frame" in the build "O2" or "avx2"; nothing if there is no such
/// file or no such stage in it. Throws std::runtime_error if the file is there but cannot be used.
std::optional<double> committed_instructions(const std::string& stage, const std::string& per,
                                             const std::string& build);

}  // namespace shortshot_bench::peers
