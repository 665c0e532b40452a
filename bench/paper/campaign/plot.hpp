// Plots of results as SVG: for each series a line with points, or points with intervals.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace shortshot_bench::campaign {

constexpr double automatic = std::numeric_limits<double>::quiet_NaN();

/// A place on an axis, and what stands there.
struct Tick {
  double at = 0.0;
  std::string text{};
};

struct Axis {
  std::string label{};
  bool logarithmic = false;  // values that are not positive are left out
  double min = automatic;
  double max = automatic;
  std::vector<Tick> ticks{};  // empty: chosen by gnuplot
};

/// Places 0, 1, 2, ... with these names: for an axis of categories.
std::vector<Tick> category_ticks(const std::vector<std::string>& names);

struct Series {
  std::string name{};
  std::vector<double> xs{};
  std::vector<double> ys{};  // as many; one that is not finite is a gap in the line
  int color = 0;             // 1 to 8: the same color for series that belong together; 0: by its place in the list
  bool dashed = false;
  bool on_second_y = false;     // dotted, unless dashed
  std::vector<double> lows{};   // if there are any, as many as xs: points with bars from here
  std::vector<double> highs{};  // to here, and no line: where neighbors on the axis have no order
};

struct Plot {
  std::string title{};
  Axis x{};
  Axis y{};
  std::vector<Series> series{};
  Axis second_x{};  // above, on the same scale as x; there if it has ticks: bytes for each number of bins, say
  Axis second_y{};  // on the right; there if a series is on it
  int width = 900;  // pixels
  int height = 480;
};

/// What gnuplot is to read, without any path or date. Throws std::invalid_argument if a series has not as many ys as
/// xs, or lows or highs, if none has anything to draw.
std::string plot_script(const Plot& plot);

/// Draws the plot by draw_svg(), which see for what is thrown.
void write_svg(const Plot& plot, const std::string& path);

}  // namespace shortshot_bench::campaign
