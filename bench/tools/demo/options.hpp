// What the demo is asked to do.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tools/input/read_input.hpp"

namespace shortshot_bench {

struct DemoOptions {
  std::vector<std::string> clouds;  // files; empty: the generated tabletop
  InputOptions input;
  std::string descriptor = "scsh336";
  float radius = 0.04f;  // of the generated scene; of a file's cloud what is suggested, where none is asked for
  std::optional<float> normal_radius;  // of the normals, where it needs them; the file's, or a quarter of the radius
  float leaf = 0.02f;
  std::string search = "grid";
  unsigned threads = 1;
  std::string out;              // empty: nothing is written
  bool suggest_radius = false;  // neither was asked for: suggest()
  bool suggest_leaf = false;
  std::string picture;  // of two views that are matched, or of the cloud with its key points; empty: none
  bool towards_camera = false;
  bool check = false;
  std::size_t brute_share = 1;  // brute force looks at one neighborhood in so many, a grid at the others
  bool diagnose = false;        // in place of describing
};

/// Parses the command line. Returns true if there is something to do; otherwise `exit_code` is 0 (help was asked for)
/// or 2 (a message about what is wrong has been printed).
bool parse_options(int argc, const char* const* argv, DemoOptions& options, int& exit_code);

}  // namespace shortshot_bench
