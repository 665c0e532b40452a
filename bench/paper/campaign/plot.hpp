// Plots of results as SVG: all series in one plot, or a panel for each where they could not be told apart.
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
  bool logarithmic = false;  // values that are not positive are left out; min and max are those of the values drawn
  double min = automatic;
  double max = automatic;
  std::vector<Tick> ticks{};  // empty: chosen by the range
  bool unordered = false;     // neighbors have nothing to do with each other: no line may join them
};

/// The y axis of unordered names, which are at 0, 1, 2, ... from above down.
Axis axis_of_names(const std::vector<std::string>& names);

/// An axis of unordered things with the numbers from 1 to `count`, of which some round ones are ticks.
Axis axis_of_numbers(const std::string& label, std::size_t count);

enum class Marks {
  line_with_points,  // x is a quantity, and there are values between those that were measured
  line,              // a curve, or a level
  steps,             // a value holds up to the next
  points,            // no line: neighbors on the axis have no order
  intervals          // points with a bar along x from lows to highs
};

struct Series {
  std::string name{};
  std::vector<double> xs{};
  std::vector<double> ys{};  // as many; one that is not finite is a gap in the line
  Marks marks = Marks::line_with_points;
  int style = 0;  // 1 to 8, of style.gp: color, dashes and mark; 0: by its place in the list
  std::vector<double> lows{};
  std::vector<double> highs{};  // of intervals: as many as xs
};

struct Plot {
  std::string title{};
  Axis x{};
  Axis y{};
  std::vector<Series> series{};
  Axis second_x{};         // above, on the same scale as x; there if it has ticks, which x.label explains
  bool in_panels = false;  // one for each series, before all others in light gray: for more than a few
  int width = 800;         // pixels
  int height = 500;        // without panels, which are as high as they need
};

/// What gnuplot is to read, without any path or date. Throws std::invalid_argument if a series has not as many ys as
/// xs, or lows or highs, if none has anything to draw, or if it would draw a line along an unordered axis.
std::string plot_script(const Plot& plot);

/// Draws the plot by draw_svg(), which see for what is thrown.
void write_svg(const Plot& plot, const std::string& path);

}  // namespace shortshot_bench::campaign
