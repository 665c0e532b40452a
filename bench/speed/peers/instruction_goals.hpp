// Instructions per neighbor, which `./run instructions` counts and commits.
#pragma once

#include <optional>
#include <string>

namespace shortshot_bench::peers {

enum class Stage { kernel, search_and_frame };

/// Of SCSH-336 in the build "O2" or "avx2"; nothing if there is no such file. Throws std::runtime_error
/// if the file is there but cannot be used.
std::optional<double> committed_instructions(Stage stage, const std::string& build);

}  // namespace shortshot_bench::peers
