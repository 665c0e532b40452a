// Stages as Google Benchmark's benchmarks.
#pragma once

#include <string>

#include "speed/micro/instruction_counter.hpp"
#include "speed/stages/stages.hpp"

namespace shortshot_bench {

/// Registers "CLOUD/STAGE/ISA" for all stages of all builds. The workload and the counter must outlive the run.
void register_stages(const std::string& cloud, const Workload& workload, const InstructionCounter& counter);

}  // namespace shortshot_bench
