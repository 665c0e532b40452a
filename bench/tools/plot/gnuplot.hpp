// Plots as SVG files, drawn by gnuplot. All look alike: see style.gp.
#pragma once

#include <string>

namespace shortshot_bench {

/// A string constant of gnuplot. A line's end, which one cannot hold, becomes a space.
std::string quoted_for_gnuplot(const std::string& text);

/// Draws the SVG file `path`, which is there as a whole or not at all. The script sets `name`, `width` and `height` (in
/// pixels; a name of letters, digits and '_'), says "load style" and plots. The bytes depend on nothing but the script
/// and gnuplot's version: no date, no path. Throws std::runtime_error if gnuplot is not there or fails; what it says
/// goes to stderr. Not for several threads at once.
void draw_svg(const std::string& path, const std::string& script);

}  // namespace shortshot_bench
