#include "speed/micro/register.hpp"

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>

namespace shortshot_bench {
namespace {

/// CPU time and instructions of this thread.
struct Spent {
  double ns;
  double instructions;
};

Spent spent(const InstructionCounter& counter) {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return {1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec),
          static_cast<double>(counter.instructions())};
}

/// Counters "ns/NAME" and "instructions/NAME", for so many of them in each iteration. (Google Benchmark's own rates are
/// in seconds.)
void add_costs(benchmark::State& state, const std::string& name, std::size_t count, const Spent& begin,
               const Spent& end) {
  if (count == 0) return;
  const double all = static_cast<double>(count) * static_cast<double>(state.iterations());
  state.counters["ns/" + name] = (end.ns - begin.ns) / all;
  if (end.instructions > 0.0) state.counters["instructions/" + name] = (end.instructions - begin.instructions) / all;
}

void run(benchmark::State& state, const Stage& stage, const InstructionCounter& counter) {
  shortshot::Status status = stage.run();  // memory that grows does so before the clock starts
  const Spent begin = spent(counter);
  for (auto _ : state) {
    if (status == shortshot::Status::ok) status = stage.run();
  }
  const Spent end = spent(counter);
  if (status != shortshot::Status::ok) state.SkipWithError(shortshot::message(status));
  add_costs(state, "point", stage.points, begin, end);
  add_costs(state, "keypoint", stage.keypoints, begin, end);
  add_costs(state, "neighbor", stage.neighbors, begin, end);
  if (stage.keypoints > 0 && stage.neighbors > 0) {
    state.counters["neighbors"] = static_cast<double>(stage.neighbors) / static_cast<double>(stage.keypoints);
  }
  if (stage.bytes > 0) state.counters["bytes"] = static_cast<double>(stage.bytes);
}

}  // namespace

void register_stages(const std::string& cloud, const Workload& workload, const InstructionCounter& counter) {
  for (const StageBuild& build : build_stages(workload)) {
    for (const Stage& stage : build.stages) {
      std::string name = cloud + "/" + stage.name + "/" + build.isa;
      std::replace(name.begin(), name.end(), ' ', '_');
      benchmark::RegisterBenchmark(name.c_str(), [stage, &counter](benchmark::State& state) {
        run(state, stage, counter);
      })->Unit(benchmark::kMicrosecond);
    }
  }
}

}  // namespace shortshot_bench
