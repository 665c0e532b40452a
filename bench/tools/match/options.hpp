// What match is asked to do.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/input/read_input.hpp"
#include "tools/match/match.hpp"

namespace shortshot_bench {

struct MatchCommand {
  std::vector<std::string> clouds;  // A and B; none: two generated views
  InputOptions input;
  std::string whole;  // "a", "b", "both": an object from all sides
  MatchOptions match;
  std::string out = "match";  // OUT.png, OUT-moved.png, OUT-pose.txt
  std::size_t width = 1600;   // of the pictures, in pixels
  bool quiet = false;         // one line, and no files
};

/// True if there is something to do; otherwise `exit_code` is 0 (help was asked for) or 2 (a message about what is
/// wrong has been printed).
bool parse_match_options(int argc, const char* const* argv, MatchCommand& command, int& exit_code);

}  // namespace shortshot_bench
