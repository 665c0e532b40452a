// How much memory is allocated, now and at most. Counts nothing by itself: counting_new.hpp tells it, in programs that
// include it.
#pragma once

#include <atomic>
#include <cstddef>

namespace shortshot_bench::scaling {

namespace detail {
inline std::atomic<std::size_t> allocated_bytes{0};
inline std::atomic<std::size_t> peak_bytes{0};

inline void raise_peak(std::size_t bytes) noexcept {
  std::size_t peak = peak_bytes.load();
  while (bytes > peak && !peak_bytes.compare_exchange_weak(peak, bytes)) continue;
}
}  // namespace detail

inline void note_allocated(std::size_t bytes) noexcept {
  detail::raise_peak(detail::allocated_bytes.fetch_add(bytes) + bytes);
}
inline void note_freed(std::size_t bytes) noexcept { detail::allocated_bytes.fetch_sub(bytes); }

/// The most memory allocated while it lives, beyond what was allocated before. One may live within another.
class PeakMemory {
 public:
  PeakMemory() : before_(detail::allocated_bytes.load()), outer_peak_(detail::peak_bytes.exchange(before_)) {}
  PeakMemory(const PeakMemory&) = delete;
  PeakMemory& operator=(const PeakMemory&) = delete;
  ~PeakMemory() { detail::raise_peak(outer_peak_); }

  std::size_t extra_bytes() const { return detail::peak_bytes.load() - before_; }

 private:
  std::size_t before_;
  std::size_t outer_peak_;
};

}  // namespace shortshot_bench::scaling
