// What micro is asked to do.
#pragma once

#include <string>
#include <vector>

#include "speed/stages/workload.hpp"

namespace shortshot_bench {

struct MicroOptions {
  std::vector<std::string> clouds;  // files; empty: the generated tabletop
  WorkloadOptions workload;
};

/// Parses the command line; Google Benchmark takes its own flags from it. Returns true if there is something to do;
/// otherwise `exit_code` is 0 (help was asked for) or 2 (a message about what is wrong has been printed).
bool parse_options(int argc, char** argv, MicroOptions& options, int& exit_code);

/// How benchmarks name a cloud: its file without folders and ending; the generated scene is `tabletop`.
std::string cloud_name(const std::string& file);

}  // namespace shortshot_bench
