// shortshot/base/fixed_point.hpp: sums that do not depend on their order.
//
// Float additions round, so a sum depends on the order of its terms: on the search that found the neighbors, on the
// number of lanes, on the number of threads. Every sum over neighbors in this library adds numbers that were first
// scaled by a power of two and rounded to integers: exact additions, the same bits whatever the order.
#ifndef SHORTSHOT_BASE_FIXED_POINT_HPP
#define SHORTSHOT_BASE_FIXED_POINT_HPP

#include <cstdint>

#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The largest e such that `n` numbers of magnitude up to 2^bits, times 2^e, can be added up in any order without
/// leaving int32, and each has at most 22 bits (what simd::round_to_int() can take).
[[nodiscard]] inline int fixed_point_exponent(std::uint32_t n, int bits) noexcept {
  const int exponent = n > 256 ? __builtin_clz(n - 1) - 2 : 22;  // 2^(30 - exponent) >= n
  return exponent - bits;
}

/// The same as a factor, for numbers of magnitude up to 1.
[[nodiscard]] inline float fixed_point_scale(std::uint32_t n) noexcept {
  return static_cast<float>(1 << fixed_point_exponent(n, 0));
}

/// The upper half of a * b, towards minus infinity, added to a sum: a step of Horner's scheme. (Cortex-M4 and later
/// have an instruction for it, which GCC does not know of.)
[[nodiscard, gnu::always_inline]] inline std::int32_t add_high_product(std::int32_t sum, std::int32_t a,
                                                                       std::int32_t b) noexcept {
#if defined(__ARM_FEATURE_DSP) && !defined(__aarch64__)
  std::int32_t result;
  __asm__("smmla %0, %1, %2, %3" : "=r"(result) : "r"(a), "r"(b), "r"(sum));
  return result;
#else
  return sum + static_cast<std::int32_t>((std::int64_t{a} * b) >> 32);
#endif
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_BASE_FIXED_POINT_HPP
