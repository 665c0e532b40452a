// scaling: what shortshot costs with more points, neighbors, key points and threads, on the generated scene.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "speed/scaling/counting_new.hpp"
#include "speed/scaling/curve_point.hpp"
#include "speed/scaling/curves.hpp"
#include "speed/scaling/plots.hpp"

namespace {

using namespace shortshot_bench::scaling;

void print(const std::vector<CurvePoint>& points) {
  for (const CurvePoint& p : points) {
    std::printf("%-10s %11.0f  %-12s %12.4g %s, %.2f MB\n", p.curve.c_str(), p.x, p.series.c_str(), p.value,
                p.unit.c_str(), 1e-6 * p.extra_bytes);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Scaling curves on the generated scene: cost and extra memory against points, neighbors per key point, key "
      "points and threads. Medians of interleaved repetitions, of thread CPU time for one thread and of wall time for "
      "several. Extra memory is what operator new gave at the peak, beyond the cloud, the key points and the rows that "
      "come out; stacks of threads are not counted. Needs 4 GB.");
  app.name("scaling");
  std::string from;
  std::string json;
  std::string plots;
  bool quick = false;
  app.add_option("--json", json, "write the figures to this file");
  app.add_option("--plots", plots, "draw one SVG per curve into this folder (needs gnuplot)");
  auto* const quick_flag = app.add_flag("--quick", quick, "fewer and smaller sizes, fewer repetitions");
  app.add_option("--from", from, "measure nothing: take the figures from this file")->excludes(quick_flag);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    const std::vector<CurvePoint> points = from.empty() ? measure_curves(quick) : read_curves(from);
    print(points);
    if (!json.empty()) write_curves(json, points);
    if (!plots.empty()) draw_plots(points, plots);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
