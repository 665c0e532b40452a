#include "speed/scaling/plots.hpp"

#include <filesystem>
#include <set>
#include <sstream>

#include "tools/plot/axis.hpp"
#include "tools/plot/gnuplot.hpp"

namespace shortshot_bench::scaling {
namespace {

/// One gnuplot data block: for each series its name, then lines "x y". Zeros have no place on logarithmic axes; a
/// series of nothing else keeps its place, so that it has the same color in both plots.
std::string data_block(const std::string& name, const std::vector<CurvePoint>& points, double CurvePoint::*y,
                       double per_unit) {
  std::ostringstream text;
  text << '$' << name << " << END\n";
  for (const std::string& series : distinct(points, &CurvePoint::series)) {
    std::ostringstream lines;
    for (const CurvePoint& p : with(points, &CurvePoint::series, series)) {
      if (p.*y > 0.0) lines << p.x << ' ' << p.*y / per_unit << '\n';
    }
    text << '"' << series << "\"\n" << (lines.str().empty() ? "NaN NaN\n" : lines.str()) << "\n\n";
  }
  text << "END\n";
  return text.str();
}

/// The positive ones among these values of the points, in order, each once.
std::vector<double> values_of(const std::vector<CurvePoint>& points, double CurvePoint::*member, double per_unit) {
  std::set<double> values;
  for (const CurvePoint& p : points) {
    if (p.*member > 0.0) values.insert(p.*member / per_unit);
  }
  return {values.begin(), values.end()};
}

std::string axis(const char* name, const std::vector<double>& values) {
  return values.empty() ? "" : positive_axis(name, values.front(), values.back());
}

/// Where few sizes were measured, such as numbers of threads, they are the ticks.
std::string x_axis(const std::vector<double>& xs) {
  constexpr std::size_t few = 5;
  return axis("x", xs) + (xs.size() <= few ? ticks_at("x", xs) : "");
}

}  // namespace

std::string plot_name(const std::string& curve) { return "scaling_" + curve + ".svg"; }

std::string plot_data(const std::vector<CurvePoint>& points) {
  const CurvePoint& any = points.front();
  std::ostringstream text;
  text << "curve = '" << any.curve << "'\nx_name = '" << any.x_name << "'\nunit = '" << any.unit << "'\n"
       << "x_axis = '" << x_axis(values_of(points, &CurvePoint::x, 1.0)) << "'\n"
       << "cost_axis = '" << axis("y", values_of(points, &CurvePoint::value, 1.0)) << "'\n"
       << "memory_axis = '" << axis("y", values_of(points, &CurvePoint::extra_bytes, 1e6)) << "'\n"
       << data_block("cost", points, &CurvePoint::value, 1.0)
       << data_block("memory", points, &CurvePoint::extra_bytes, 1e6);
  return text.str();
}

void draw_plots(const std::vector<CurvePoint>& points, const std::string& directory) {
  std::filesystem::create_directories(directory);
  for (const std::string& curve : distinct(points, &CurvePoint::curve)) {
    const std::string file = (std::filesystem::path(directory) / plot_name(curve)).string();
    draw_svg(file, plot_data(with(points, &CurvePoint::curve, curve)) + "load " +
                       quoted_for_gnuplot(SHORTSHOT_PLOT_SCRIPT) + '\n');
  }
}

}  // namespace shortshot_bench::scaling
