#include <cstdio>

#include "speed/stages/stages.hpp"
#include "speed/stages/stages_of_isa.hpp"

namespace shortshot_bench {

bool cpu_has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

std::vector<StageBuild> build_stages(const Workload& workload) {
  std::vector<StageBuild> builds;
  builds.push_back(stages_plain(workload));
#if defined(__x86_64__)
  if (cpu_has_avx2()) {
    builds.push_back(stages_avx2(workload));
    builds.push_back(stages_baseline(workload));
  } else {
    std::fputs("avx2, baseline: skipped, this CPU has no AVX2\n", stderr);
  }
#endif
  return builds;
}

}  // namespace shortshot_bench
