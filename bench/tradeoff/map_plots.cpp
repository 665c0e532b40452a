#include "tradeoff/map_plots.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace shortshot_bench::tradeoff {
namespace {

using campaign::Marks;
using campaign::Series;

double bytes_of(const Entry& entry) { return static_cast<double>(entry.size_bytes); }
double time_of(const Entry& entry) { return entry.cost.microseconds; }

using CostOf = double (*)(const Entry&);

Series points_of(const std::string& name, const Map& map, Kind kind, CostOf cost, int style) {
  Series series{name, {}, {}, Marks::points, style};
  for (const Entry& e : map.entries) {
    if (!(e.score > 0.0) || e.kind != kind) continue;
    series.xs.push_back(cost(e));
    series.ys.push_back(e.score);
  }
  return series;
}

/// The highest score among those that cost as much or less, up to the most that any costs.
Series best_of(const Map& map, CostOf cost) {
  std::vector<std::pair<double, double>> places;
  for (const Entry& e : map.entries) {
    if (e.score > 0.0) places.emplace_back(cost(e), e.score);
  }
  std::sort(places.begin(), places.end());
  Series series{"best so far", {}, {}, Marks::steps, 1};
  double best = 0.0;
  for (const auto& [x, y] : places) {
    if (!(y > best) && &x != &places.back().first) continue;
    best = std::max(best, y);
    series.xs.push_back(x);
    series.ys.push_back(best);
  }
  return series;
}

campaign::Plot plot_of(const Map& map, CostOf cost, const std::string& label) {
  campaign::Plot plot;
  plot.title = "Right matches of each descriptor, over those of CSHOT in 5,376 bytes";
  plot.x.label = label;
  plot.x.logarithmic = true;
  plot.y.label = "right matches / right matches of CSHOT";
  plot.y.min = 0.0;
  plot.series = {points_of("relatives", map, Kind::relative, cost, 8),
                 points_of("published", map, Kind::published, cost, 2),
                 points_of("compact", map, Kind::compact, cost, 3), best_of(map, cost)};
  return plot;
}

}  // namespace

campaign::Plot score_by_bytes(const Map& map) { return plot_of(map, bytes_of, "size, bytes"); }
campaign::Plot score_by_time(const Map& map) { return plot_of(map, time_of, "time, microseconds per key point"); }

void draw_scores(const Map& map, const std::string& directory) {
  campaign::write_svg(score_by_bytes(map), directory + "/score_by_bytes.svg");
  campaign::write_svg(score_by_time(map), directory + "/score_by_time.svg");
}

}  // namespace shortshot_bench::tradeoff
