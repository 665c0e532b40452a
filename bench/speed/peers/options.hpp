// What the comparison is asked to do.
#pragma once

#include <string>
#include <vector>

namespace shortshot_bench::peers {

struct Options {
  std::vector<std::string> clouds;  // files; empty: the generated tabletop
  float radius = 0.04f;
  float leaf = 0.01f;
  int rounds = 5;
  bool fpfh = true;   // PCL's takes a minute per cloud
  std::string json;   // where the comparisons go; empty: nowhere
  std::string goals;  // where the goals and what was measured go; empty: nowhere
};

/// Parses the command line. Returns true if there is something to do; otherwise `exit_code` is 0 (help was asked for)
/// or 2 (a message about what is wrong has been printed).
bool parse_options(int argc, const char* const* argv, Options& options, int& exit_code);

}  // namespace shortshot_bench::peers
