#include "paper/campaign/plot.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

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

bool has_bars(const Series& series) { return !series.lows.empty() || !series.highs.empty(); }

bool has_second_y(const Plot& plot) {
  return std::any_of(plot.series.begin(), plot.series.end(), [](const Series& s) { return s.on_second_y; });
}

bool is_drawn(const Plot& plot, const Series& series, std::size_t i) {
  const auto has_place = [](const Axis& axis, double value) {
    return std::isfinite(value) && (!axis.logarithmic || value > 0.0);
  };
  return has_place(plot.x, series.xs[i]) && has_place(series.on_second_y ? plot.second_y : plot.y, series.ys[i]);
}

bool has_points(const Plot& plot, const Series& series) {
  for (std::size_t i = 0; i < series.xs.size(); ++i) {
    if (is_drawn(plot, series, i)) return true;
  }
  return false;
}

void refuse_unless_drawable(const Plot& plot) {
  for (const Series& series : plot.series) {
    if (series.xs.size() != series.ys.size()) {
      throw std::invalid_argument("plot '" + plot.title + "': '" + series.name + "' has not as many ys as xs");
    }
    if (has_bars(series) && (series.lows.size() != series.xs.size() || series.highs.size() != series.xs.size())) {
      throw std::invalid_argument("plot '" + plot.title + "': '" + series.name + "' has not a bar for each point");
    }
  }
  if (std::none_of(plot.series.begin(), plot.series.end(), [&](const Series& s) { return has_points(plot, s); })) {
    throw std::invalid_argument("plot '" + plot.title + "': there is nothing to draw");
  }
}

/// Long names side by side would run into each other.
bool need_turning(const std::vector<Tick>& ticks) {
  std::size_t letters = 0;
  for (const Tick& tick : ticks) letters += tick.text.size() + 2;
  return letters > 80;
}

/// gnuplot's commands for the axis that it calls "x", "y", "x2" or "y2".
std::string axis_commands(const std::string& name, const Axis& axis) {
  std::string text = "set " + name + "label " + quoted_for_gnuplot(axis.label) + '\n';
  if (axis.logarithmic) text += "set logscale " + name + '\n';
  text += "set " + name + "range [" + number(axis.min, "*") + ':' + number(axis.max, "*") + "]\n";
  text += "set " + name + "tics";
  if (name[0] == 'x' && need_turning(axis.ticks)) text += " rotate by 45 right";
  for (const Tick& tick : axis.ticks) {
    text += (&tick == &axis.ticks.front() ? " (" : ", ") + quoted_for_gnuplot(tick.text) + ' ' + number(tick.at, "0");
  }
  return text + (axis.ticks.empty() ? "\n" : ")\n");
}

/// One block of lines "x y" or "x y low high" for each series; where nothing is drawn the line is interrupted.
std::string data_blocks(const Plot& plot) {
  std::string text = "$data << END\n";
  for (const Series& series : plot.series) {
    for (std::size_t i = 0; i < series.xs.size(); ++i) {
      const bool drawn = is_drawn(plot, series, i);
      text += number(series.xs[i], no_value) + ' ' + (drawn ? number(series.ys[i], no_value) : no_value);
      if (has_bars(series)) text += ' ' + number(series.lows[i], no_value) + ' ' + number(series.highs[i], no_value);
      text += '\n';
    }
    text += (series.xs.empty() ? std::string(no_value) + '\n' : "") + "\n\n";
  }
  return text + "END\n";
}

/// A series without points is named all the same: it was measured.
std::string series_command(const Plot& plot, std::size_t index) {
  const Series& series = plot.series[index];
  const std::string data = "$data index " + std::to_string(index) + " using " + (has_bars(series) ? "1:2:3:4" : "1:2") +
                           " axes x1" + (series.on_second_y ? "y2" : "y1");
  const std::string color = std::to_string(series.color > 0 ? series.color : static_cast<int>(index) + 1);
  return (has_points(plot, series) ? data : "keyentry") +
         (has_bars(series) ? " with yerrorbars" : " with linespoints") + " linetype " + color +
         (series.dashed        ? " dashtype 2"
          : series.on_second_y ? " dashtype 3"
                               : "") +
         " title " + quoted_for_gnuplot(series.name);
}

}  // namespace

std::vector<Tick> category_ticks(const std::vector<std::string>& names) {
  std::vector<Tick> ticks;
  for (const std::string& name : names) ticks.push_back({static_cast<double>(ticks.size()), name});
  return ticks;
}

std::string plot_script(const Plot& plot) {
  refuse_unless_drawable(plot);
  const bool second_x = !plot.second_x.ticks.empty();
  const bool second_y = has_second_y(plot);
  std::string text = "name = 'plot'\nwidth = " + std::to_string(plot.width) +
                     "\nheight = " + std::to_string(plot.height) + "\nload style\n";
  text += "set termoption noenhanced\n";  // "T_diff" as it is written
  text += "set title " + quoted_for_gnuplot(plot.title) + '\n';
  text += "set border " + std::to_string(3 + (second_x ? 4 : 0) + (second_y ? 8 : 0)) + '\n';
  text += axis_commands("x", plot.x) + axis_commands("y", plot.y);
  if (second_x) text += axis_commands("x2", plot.second_x) + "set link x2\n";
  if (second_y) text += axis_commands("y2", plot.second_y);
  text += data_blocks(plot) + "plot ";
  for (std::size_t i = 0; i < plot.series.size(); ++i) text += (i == 0 ? "" : ", \\\n  ") + series_command(plot, i);
  return text + '\n';
}

void write_svg(const Plot& plot, const std::string& path) { draw_svg(path, plot_script(plot)); }

}  // namespace shortshot_bench::campaign
