// Plots of scaling curves, drawn by gnuplot: cost above, extra memory below.
#pragma once

#include <string>
#include <vector>

#include "speed/scaling/curve_point.hpp"

namespace shortshot_bench::scaling {

/// The name of a curve's plot: "scaling_NAME.svg".
std::string plot_name(const std::string& curve);

/// What gnuplot is to read for one curve: its data and the values that plot.gp asks for, without any path or date.
/// `points` are all of one curve.
std::string plot_data(const std::vector<CurvePoint>& points);

/// Writes DIRECTORY/scaling_NAME.svg for each curve. Throws std::runtime_error if gnuplot is not there or fails.
void draw_plots(const std::vector<CurvePoint>& points, const std::string& directory);

}  // namespace shortshot_bench::scaling
