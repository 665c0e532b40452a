// A check for options on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace shortshot_bench {

/// For CLI::Option::check(): CLI11's own number checks let "nan" and "inf" through.
inline std::string finite_and_positive(const std::string& text) {
  float value = 0.0f;
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value) || !(value > 0.0f)) {
    return "must be a finite number above zero, not '" + text + "'";
  }
  return {};
}

}  // namespace shortshot_bench
