// What every timing needs: a clock and a median.
#pragma once

#include <vector>

namespace shortshot_bench {

/// Thread CPU time does not count the time in which other programs have the core; wall time is what several threads
/// are for.
enum class Clock { thread_cpu, wall };

double now_seconds(Clock clock);

/// The value in the middle; the mean of two if they share it. Of one or more values.
double median(std::vector<double> values);

}  // namespace shortshot_bench
