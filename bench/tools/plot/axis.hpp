// Axes that fit what is drawn, with round ticks.
#pragma once

#include <string>
#include <vector>

namespace shortshot_bench {

/// gnuplot's commands, each with a ';' after it, for the axis "x", "y", ... of positive values from `least` to `most`,
/// which fill it but for a narrow rim. Where they are less than tenfold apart the axis is linear, for a logarithmic
/// one would have hardly a tick; below a hundredfold it has ticks at 1, 2 and 5 of each decade, else at each decade.
std::string positive_axis(const std::string& name, double least, double most);

/// gnuplot's command for ticks at these places alone.
std::string ticks_at(const std::string& name, const std::vector<double>& places);

/// The least of 1, 2, 5, 10, ... and of their tenths, hundredths, ... that is in `span` at most `most` times.
double round_step(double span, int most);

}  // namespace shortshot_bench
