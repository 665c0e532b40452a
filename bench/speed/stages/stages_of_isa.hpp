// The same stages compiled for several instruction sets: stages_of_isa.cpp, once for each of these functions.
#pragma once

#include "speed/stages/stages.hpp"

namespace shortshot_bench {

StageBuild stages_plain(const Workload& workload);     // with the flags of everything else, and no other instructions
StageBuild stages_avx2(const Workload& workload);      // with -mavx2; x86-64 only
StageBuild stages_baseline(const Workload& workload);  // those that choose their instructions themselves; x86-64 only

}  // namespace shortshot_bench
