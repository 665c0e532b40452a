// The naive transcription as contenders.
#pragma once

#include "peers/suite.hpp"
#include "peers/task.hpp"

namespace shortshot_bench::peers {

/// The task must outlive it, as in every suite.
Suite make_naive_suite(const Task& task);

}  // namespace shortshot_bench::peers
