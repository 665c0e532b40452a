#include "paper/campaign/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "tools/plot/axis.hpp"
#include "tools/plot/gnuplot.hpp"

namespace shortshot_bench::campaign {
namespace {

const char* const no_value = "NaN";  // to gnuplot: no point here, and no line over it

std::string number(double value, const char* otherwise) {
  if (!std::isfinite(value)) return otherwise;
  std::ostringstream text;
  text.precision(10);
  text << value;
  return text.str();
}

bool has_second_x(const Plot& plot) { return !plot.second_x.ticks.empty(); }

bool joins(const Series& series) { return series.marks != Marks::points && series.marks != Marks::intervals; }

bool is_drawn(const Plot& plot, const Series& series, std::size_t i) {
  const auto has_place = [](const Axis& axis, double value) {
    return std::isfinite(value) && (!axis.logarithmic || value > 0.0);
  };
  return has_place(plot.x, series.xs[i]) && has_place(plot.y, series.ys[i]);
}

bool has_points(const Plot& plot, const Series& series) {
  for (std::size_t i = 0; i < series.xs.size(); ++i) {
    if (is_drawn(plot, series, i)) return true;
  }
  return false;
}

void refuse_unless_drawable(const Plot& plot) {
  const auto refuse = [&](const std::string& what) {
    throw std::invalid_argument("plot '" + plot.title + "': " + what);
  };
  for (const Series& series : plot.series) {
    const std::size_t bars = series.marks == Marks::intervals ? series.xs.size() : 0;
    if (series.xs.size() != series.ys.size()) refuse("'" + series.name + "' has not as many ys as xs");
    if (series.lows.size() != bars || series.highs.size() != bars) {
      refuse("'" + series.name + "' has not a bar for each point");
    }
    if (joins(series) && (plot.x.unordered || plot.y.unordered)) {
      refuse("'" + series.name + "' would join what has no order");
    }
  }
  if (std::none_of(plot.series.begin(), plot.series.end(), [&](const Series& s) { return has_points(plot, s); })) {
    refuse("there is nothing to draw");
  }
}

/// The least and the greatest of the values that are drawn.
std::pair<double, double> extent(const Plot& plot, std::vector<double> Series::*values) {
  std::pair<double, double> extent{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Series& series : plot.series) {
    for (std::size_t i = 0; i < series.xs.size(); ++i) {
      if (!is_drawn(plot, series, i)) continue;
      extent.first = std::min(extent.first, (series.*values)[i]);
      extent.second = std::max(extent.second, (series.*values)[i]);
    }
  }
  return extent;
}

std::string logarithmic_axis(const Plot& plot, const std::string& name, std::vector<double> Series::*values) {
  const auto [least, most] = extent(plot, values);
  return positive_axis(name, least, most) + '\n';
}

/// gnuplot's commands for the axis that it calls "x", "y" or "x2".
std::string linear_axis(const std::string& name, const Axis& axis) {
  std::string text = "set " + name + "range [" + number(axis.min, "*") + ':' + number(axis.max, "*") + "]\n";
  text += "set " + name + "tics";
  for (const Tick& tick : axis.ticks) {
    text += (&tick == &axis.ticks.front() ? " (" : ", ") + quoted_for_gnuplot(tick.text) + ' ' + number(tick.at, "0");
  }
  return text + (axis.ticks.empty() ? "\n" : ")\n");
}

std::string axes(const Plot& plot) {
  std::string text = plot.x.logarithmic ? logarithmic_axis(plot, "x", &Series::xs) : linear_axis("x", plot.x);
  text += plot.y.logarithmic ? logarithmic_axis(plot, "y", &Series::ys) : linear_axis("y", plot.y);
  if (!has_second_x(plot)) return text;
  return text + "set border 7\n" + linear_axis("x2", plot.second_x) + "set link x2\n";
}

/// One block of lines "x y" or "x y low high" for each series; where nothing is drawn the line is interrupted.
std::string data_blocks(const Plot& plot) {
  std::string text = "$data << END\n";
  for (const Series& series : plot.series) {
    for (std::size_t i = 0; i < series.xs.size(); ++i) {
      const bool drawn = is_drawn(plot, series, i);
      text += number(series.xs[i], no_value) + ' ' + (drawn ? number(series.ys[i], no_value) : no_value);
      if (!series.lows.empty())
        text += ' ' + number(series.lows[i], no_value) + ' ' + number(series.highs[i], no_value);
      text += '\n';
    }
    text += (series.xs.empty() ? std::string(no_value) + '\n' : "") + "\n\n";
  }
  return text + "END\n";
}

const char* gnuplots_word(Marks marks) {
  switch (marks) {
    case Marks::line_with_points: return "linespoints";
    case Marks::line: return "lines";
    case Marks::steps: return "steps";
    case Marks::points: return "points";
    case Marks::intervals: return "xerrorbars";
  }
  return "";
}

/// A series without points is named all the same: it was measured.
std::string series_command(const Plot& plot, std::size_t index, int style) {
  const Series& series = plot.series[index];
  const std::string data =
      "$data index " + std::to_string(index) + " using " + (series.lows.empty() ? "1:2" : "1:2:3:4");
  return (has_points(plot, series) ? data : "keyentry") + " with " + gnuplots_word(series.marks) + " linetype " +
         std::to_string(style) + (series.marks == Marks::intervals ? " linewidth 1 dashtype 1" : "");
}

std::string plot_together(const Plot& plot) {
  std::string text = "set multiplot layout 1,1 title " + quoted_for_gnuplot(plot.title) + '\n';  // above the key
  text += "set xlabel " + quoted_for_gnuplot(plot.x.label) + "\nset ylabel " + quoted_for_gnuplot(plot.y.label) + '\n';
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    text += (i == 0 ? "plot " : ", \\\n  ") +
            series_command(plot, i, series.style > 0 ? series.style : static_cast<int>(i) + 1) + " title " +
            quoted_for_gnuplot(series.name);
  }
  return text + "\nunset multiplot\n";
}

/// How panels are arranged; lengths in pixels.
struct Panels {
  static constexpr int left = 80, right = 20, top = 80, bottom = 70, beside = 50, between = 65;
  int columns;
  int rows;
  int high;

  explicit Panels(std::size_t count)
      : columns(count < 3    ? static_cast<int>(count)
                : count == 4 ? 2
                             : 3),
        rows((static_cast<int>(count) + columns - 1) / columns),
        high(rows == 1 ? 240 : 150) {}
  int height() const { return top + bottom + rows * high + (rows - 1) * between; }
};

/// The labels, which are those of all panels, stand beside them once.
std::string plot_in_panels(const Plot& plot) {
  constexpr int behind = 9;  // the style of those that a panel is not about
  const Panels panels(plot.series.size());
  const auto share = [](int pixels, int all) { return number(static_cast<double>(pixels) / all, "0"); };
  const auto across = [&](int pixels) { return share(pixels, plot.width); };
  const auto up = [&](int pixels) { return share(pixels, panels.height()); };
  std::string text = "unset key\nset multiplot layout " + std::to_string(panels.rows) + ',' +
                     std::to_string(panels.columns) + " title " + quoted_for_gnuplot(plot.title) + " margins screen " +
                     across(Panels::left) + ", " + across(plot.width - Panels::right) + ", " + up(Panels::bottom) +
                     ", " + up(panels.height() - Panels::top) + " spacing screen " + across(Panels::beside) + ", " +
                     up(Panels::between) + '\n';
  text += "set label 1 " + quoted_for_gnuplot(plot.x.label) + " at screen 0.5, screen " + up(20) + " center\n";
  if (plot.x.ticks.empty() && !plot.x.logarithmic) {
    const auto [least, most] = extent(plot, &Series::xs);
    if (most > least) text += "set xtics " + number(round_step(most - least, 4), "") + '\n';
  }
  text +=
      "set label 2 " + quoted_for_gnuplot(plot.y.label) + " at screen " + across(20) + ", screen 0.5 center rotate\n";
  for (std::size_t panel = 0; panel < plot.series.size(); ++panel) {
    text += "set title " + quoted_for_gnuplot(plot.series[panel].name) + " offset 0,-0.5\nplot ";
    for (std::size_t other = 0; other < plot.series.size(); ++other) {
      if (other != panel) text += series_command(plot, other, behind) + " notitle, \\\n  ";
    }
    text += series_command(plot, panel, 1) + " notitle\nunset label\n";
  }
  return text + "unset multiplot\n";
}

}  // namespace

Axis axis_of_names(const std::vector<std::string>& names) {
  Axis axis{"", false, static_cast<double>(names.size()) - 0.5, -0.5, {}, true};
  for (const std::string& name : names) axis.ticks.push_back({static_cast<double>(axis.ticks.size()), name});
  return axis;
}

Axis axis_of_numbers(const std::string& label, std::size_t count) {
  constexpr int most_ticks = 6;
  Axis axis{label, false, 0.5, static_cast<double>(count) + 0.5, {}, true};
  const auto step = static_cast<std::size_t>(std::max(1.0, round_step(static_cast<double>(count), most_ticks)));
  for (std::size_t at = step; at <= count; at += step)
    axis.ticks.push_back({static_cast<double>(at), std::to_string(at)});
  return axis;
}

std::string plot_script(const Plot& plot) {
  refuse_unless_drawable(plot);
  const int height = plot.in_panels ? Panels(plot.series.size()).height() : plot.height;
  std::string text = "name = 'plot'\nwidth = " + std::to_string(plot.width) + "\nheight = " + std::to_string(height) +
                     "\nload style\nset termoption noenhanced\n";  // "T_diff" as it is written
  text += axes(plot) + data_blocks(plot);
  return text + (plot.in_panels ? plot_in_panels(plot) : plot_together(plot));
}

void write_svg(const Plot& plot, const std::string& path) { draw_svg(path, plot_script(plot)); }

}  // namespace shortshot_bench::campaign
