// Timing: repetitions of everything that belongs to a curve, interleaved, and their medians.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "speed/scaling/allocated.hpp"
#include "speed/scaling/curve_point.hpp"
#include "speed/timing/clock.hpp"

namespace shortshot_bench::scaling {

/// What some work took.
struct Cost {
  double seconds = 0.0;
  double extra_bytes = 0.0;
};

template <class Work>
Cost cost_of(Clock clock, const Work& work) {
  const PeakMemory memory;
  const double start = now_seconds(clock);
  work();
  return {now_seconds(clock) - start, static_cast<double>(memory.extra_bytes())};
}

/// What is done at one x of a curve; it may consist of several series.
struct Task {
  double x = 0.0;
  double per_second = 1e3;          // turns seconds into the curve's unit
  std::vector<std::string> series;  // one for each cost that run() gives
  std::function<std::vector<Cost>()> run;
};

struct CurveOptions {
  std::string name;
  std::string x_name;
  std::string unit;
  int repetitions = 1;
};

/// Runs each task once for its memory and to warm up, then all of them in turn, `repetitions` times; medians come out.
/// Progress goes to stderr.
std::vector<CurvePoint> measure(const CurveOptions& curve, const std::vector<Task>& tasks);

}  // namespace shortshot_bench::scaling
