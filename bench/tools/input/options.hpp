// Options of all tools that read what read_input() does.
#pragma once

#include <CLI/CLI.hpp>

#include "tools/input/read_input.hpp"
#include "tools/io/finite_and_positive.hpp"

namespace shortshot_bench {

inline void add_input_options(CLI::App& app, InputOptions& options) {
  app.add_option("--camera", options.intrinsics,
                 "of depth images: FX,FY,CX,CY in pixels, or a file with the rows fx 0 cx, 0 fy cy, 0 0 1");
  app.add_option("--depth-unit", options.unit, "of depth images: meters in a count of their 16 bits")
      ->check(finite_and_positive)
      ->capture_default_str();
}

}  // namespace shortshot_bench
