// What learn and recognize are asked to do.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/input/read_input.hpp"

namespace shortshot_bench {

struct RecognizeCommand {
  bool learns = false;
  std::string model;                // file
  std::string name;                 // learn: of the object
  std::vector<std::string> clouds;  // one each of the object; recognize: one
  InputOptions input;
  float radius = 0.0f;     // learn, of a new model; 0: suggested for the first cloud
  bool is_whole = false;   // learn: the clouds show the object from all sides
  double expected = 0.01;  // recognize: as match has it
  unsigned threads = 1;
  std::string out = "recognize.png";
  std::size_t width = 1600;
  bool quiet = false;
};

/// True if there is something to do; otherwise `exit_code` is 0 (help was asked for) or 2 (a message about what is
/// wrong has been printed).
bool parse_recognize_options(int argc, const char* const* argv, RecognizeCommand& command, int& exit_code);

}  // namespace shortshot_bench
