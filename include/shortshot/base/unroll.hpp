// shortshot/base/unroll.hpp: loops of a length known while compiling, written out. Compilers do not unroll them at -O2,
// and what an unrolled body keeps in registers a loop keeps in memory.
#ifndef SHORTSHOT_BASE_UNROLL_HPP
#define SHORTSHOT_BASE_UNROLL_HPP

#include <type_traits>
#include <utility>

#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Was the compiler asked for small code?
#if defined(__OPTIMIZE_SIZE__)
inline constexpr bool small_code = true;
#else
inline constexpr bool small_code = false;
#endif

template <class Function, int... I>
[[gnu::always_inline]] inline void unroll([[maybe_unused]] Function f, std::integer_sequence<int, I...>) noexcept {
  (f(std::integral_constant<int, I>{}), ...);
}

/// f(0), f(1), ... f(Count - 1), each with its index as a compile-time constant.
template <int Count, class Function>
[[gnu::always_inline]] inline void unroll(Function f) noexcept {
  unroll(f, std::make_integer_sequence<int, Count>{});
}

/// The same for functions that need no constants: written out for speed, a loop where code shall be small.
template <int Count, class Function>
[[gnu::always_inline]] inline void each(Function f) noexcept {
  if constexpr (small_code) {
    for (int i = 0; i < Count; ++i) f(i);
  } else {
    unroll<Count>(f);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_BASE_UNROLL_HPP
