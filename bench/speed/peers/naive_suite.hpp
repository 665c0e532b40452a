// The naive transcription as contenders.
#pragma once

#include "speed/peers/suite.hpp"
#include "speed/peers/task.hpp"

namespace shortshot_bench::peers {

/// The task must outlive it, as in every suite.
Suite make_naive_suite(const Task& task);

}  // namespace shortshot_bench::peers
