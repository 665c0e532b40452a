// Times that can be trusted on a shared machine: CPU time of this thread, next to a probe of how much of its core the
// thread had.
#pragma once

#include <cstddef>
#include <vector>

namespace shortshot_bench::peers {

/// How often any thread of this process had to give up its core.
long preemptions();

/// Additions per nanosecond of CPU time. A core that another hardware thread shares, or that is clocked down, does
/// fewer.
double add_rate();

/// What was measured of one step.
class Samples {
 public:
  /// `rate` is the lower one of the probes before and after.
  void add(double ms, double rate) { samples_.push_back({ms, rate}); }

  std::size_t taken() const { return samples_.size(); }
  std::size_t kept(double least_rate) const;
  double last_ms() const { return samples_.back().ms; }
  double best_rate() const;

  /// The median of the samples whose rate is at least `least_rate`; of all if there are none.
  double median_ms(double least_rate) const;

 private:
  struct Sample {
    double ms;
    double rate;
  };
  std::vector<Sample> samples_;
};

/// A probe this far below the best one of the run tells of a disturbed core.
inline constexpr double undisturbed = 0.9;

}  // namespace shortshot_bench::peers
