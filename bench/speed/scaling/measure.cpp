#include "speed/scaling/measure.hpp"

#include <cstdio>

namespace shortshot_bench::scaling {

std::vector<CurvePoint> measure(const CurveOptions& curve, const std::vector<Task>& tasks) {
  std::vector<CurvePoint> points;
  for (const Task& task : tasks) {  // the first run: memory is allocated
    std::fprintf(stderr, "%s: %.0f\n", curve.x_name.c_str(), task.x);
    const std::vector<Cost> costs = task.run();
    for (std::size_t s = 0; s < task.series.size(); ++s) {
      points.push_back(
          {curve.name, task.x, curve.x_name, task.series[s], 0.0, curve.unit, costs[s].extra_bytes, curve.repetitions});
    }
  }
  std::vector<std::vector<double>> samples(points.size());
  for (int repetition = 0; repetition < curve.repetitions; ++repetition) {
    std::fprintf(stderr, "%s: repetition %d of %d\n", curve.x_name.c_str(), repetition + 1, curve.repetitions);
    std::size_t point = 0;
    for (const Task& task : tasks) {
      for (const Cost& cost : task.run()) samples[point++].push_back(cost.seconds * task.per_second);
    }
  }
  for (std::size_t point = 0; point < points.size(); ++point) points[point].value = median(samples[point]);
  return points;
}

}  // namespace shortshot_bench::scaling
