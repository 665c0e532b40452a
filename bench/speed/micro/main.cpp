// micro: what each stage of the library costs, by Google Benchmark.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <deque>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "speed/micro/options.hpp"
#include "speed/micro/register.hpp"
#include "speed/stages/stages.hpp"
#include "tools/io/input_error.hpp"
#include "tools/io/read_cloud.hpp"
#include "tools/scene/tabletop.hpp"

namespace {

using namespace shortshot_bench;

/// A file, or the generated scene if there is no name. Throws std::exception with what is wrong and where.
Workload load(const std::string& file, const WorkloadOptions& options) {
  RgbdCloud cloud = file.empty() ? make_tabletop() : read_cloud(file);
  if (!cloud.has_colors()) std::fprintf(stderr, "%s: no colors, stages with color are left out\n", file.c_str());
  try {
    return make_workload(std::move(cloud), options);
  } catch (const std::exception& error) {
    throw std::runtime_error((file.empty() ? "generated tabletop scene" : file) + ": " + error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  MicroOptions options;
  int exit_code = 0;
  if (!parse_options(argc, argv, options, exit_code)) return exit_code;
  if (options.clouds.empty()) options.clouds.emplace_back();
  std::deque<Workload> workloads;  // a benchmark refers to its workload
  const InstructionCounter counter;
  if (!counter.counts()) {
    std::fprintf(stderr, "no counter of instructions: %s; ./run instructions counts them with callgrind\n",
                 counter.why_not().c_str());
  }
  try {
    for (const std::string& file : options.clouds) {
      workloads.push_back(load(file, options.workload));
      register_stages(cloud_name(file), workloads.back(), counter);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return benchmark::RunSpecifiedBenchmarks() > 0 ? 0 : 1;
}
