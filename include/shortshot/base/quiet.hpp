// shortshot/base/quiet.hpp: comparisons with NaN that are no invalid operation, for programs that trap those.
//
// What is promised: FE_INVALID and FE_DIVBYZERO are raised by no function of the library, FE_OVERFLOW only where points
// lie farther apart than 1e19. Arithmetic with NaN is quiet by itself; <, min() and max() are not.
#ifndef SHORTSHOT_BASE_QUIET_HPP
#define SHORTSHOT_BASE_QUIET_HPP

#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// a < b, false with NaN. Where comparisons are calls, there is nothing to trap, and the quiet one would be two.
[[nodiscard, gnu::always_inline]] inline bool is_below(float a, float b) noexcept {
#if defined(__SSE__) || defined(__aarch64__)
  return __builtin_isless(a, b);
#else
  return a < b;
#endif
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_BASE_QUIET_HPP
