// shortshot/unroll.hpp: loops of a length known while compiling, written out. Compilers do not unroll them at -O2, and
// what an unrolled body keeps in registers a loop keeps in memory.
#pragma once

#include <type_traits>
#include <utility>

#include "config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

template <class Function, int... I>
[[gnu::always_inline]] inline void unroll(Function f, std::integer_sequence<int, I...>) noexcept {
  (f(std::integral_constant<int, I>{}), ...);
}

/// f(0), f(1), ... f(Count - 1), each with its index as a compile-time constant.
template <int Count, class Function>
[[gnu::always_inline]] inline void unroll(Function f) noexcept {
  unroll(f, std::make_integer_sequence<int, Count>{});
}

}  // namespace detail
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
