#include "speed/peers/timing.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>

#include "speed/timing/clock.hpp"

namespace shortshot_bench::peers {

long preemptions() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_nivcsw;
}

double add_rate() {
  constexpr std::uint64_t turns = 100'000;
  std::uint64_t a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, g = 0, h = 0;
  const double start = now_seconds(Clock::thread_cpu);
  for (std::uint64_t i = 0; i < turns; ++i) {
    a += i, b += i, c += i, d += i, e += i, f += i, g += i, h += i;
    asm volatile("" : "+r"(a), "+r"(b), "+r"(c), "+r"(d), "+r"(e), "+r"(f), "+r"(g), "+r"(h));  // keeps every sum
  }
  return 8.0 * static_cast<double>(turns) / (1e9 * (now_seconds(Clock::thread_cpu) - start));
}

std::size_t Samples::kept(double least_rate) const {
  return static_cast<std::size_t>(
      std::count_if(samples_.begin(), samples_.end(), [&](const Sample& s) { return s.rate >= least_rate; }));
}

double Samples::best_rate() const {
  double best = 0.0;
  for (const Sample& sample : samples_) best = std::max(best, sample.rate);
  return best;
}

double Samples::median_ms(double least_rate) const {
  const bool all = kept(least_rate) == 0;
  std::vector<double> times;
  for (const Sample& sample : samples_) {
    if (all || sample.rate >= least_rate) times.push_back(sample.ms);
  }
  return median(times);
}

}  // namespace shortshot_bench::peers
