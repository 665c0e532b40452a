#include "speed/scaling/plots.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "tools/plot/gnuplot.hpp"

namespace shortshot_bench::scaling {
namespace {

/// One gnuplot data block: for each series its name, then lines "x y". Zeros have no place on logarithmic axes.
std::string data_block(const std::string& name, const std::vector<CurvePoint>& points, double CurvePoint::*y,
                       double per_unit) {
  std::ostringstream text;
  text << '$' << name << " << END\n";
  for (const std::string& series : distinct(points, &CurvePoint::series)) {
    std::ostringstream lines;
    for (const CurvePoint& p : with(points, &CurvePoint::series, series)) {
      if (p.*y > 0.0) lines << p.x << ' ' << p.*y / per_unit << '\n';
    }
    if (!lines.str().empty()) text << '"' << series << "\"\n" << lines.str() << "\n\n";
  }
  text << "END\n";
  return text.str();
}

/// Decades where there are two or more of them, else powers of two.
int log_base(const std::vector<CurvePoint>& points, double CurvePoint::*member) {
  double least = 0.0;
  double most = 0.0;
  for (const CurvePoint& p : points) {
    if (p.*member > 0.0 && (least == 0.0 || p.*member < least)) least = p.*member;
    most = std::max(most, p.*member);
  }
  return most >= 100.0 * least ? 10 : 2;
}

}  // namespace

std::string plot_name(const std::string& curve) { return "scaling_" + curve + ".svg"; }

std::string plot_data(const std::vector<CurvePoint>& points) {
  const CurvePoint& any = points.front();
  std::ostringstream text;
  text << "curve = '" << any.curve << "'\nx_name = '" << any.x_name << "'\nunit = '" << any.unit << "'\n"
       << "x_base = " << log_base(points, &CurvePoint::x) << "\ncost_base = " << log_base(points, &CurvePoint::value)
       << "\nmemory_base = " << log_base(points, &CurvePoint::extra_bytes) << '\n'
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
