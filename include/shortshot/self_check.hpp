// shortshot/self_check.hpp: does the build at hand keep the promise of the same bits everywhere?
#pragma once

#include "base/math.hpp"
#include "base/simd.hpp"
#include "base/unfused.hpp"
#include "config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

[[nodiscard, gnu::always_inline]] inline float product(float a, float b) noexcept { return extend::unfused(a * b); }
[[nodiscard, gnu::always_inline]] inline simd::F32 product(simd::F32 a, simd::F32 b) noexcept { return a * b; }

[[nodiscard, gnu::always_inline]] inline bool has_bits(float value, float expected) noexcept {
  return math::bits_of(value) == math::bits_of(expected);
}
[[nodiscard, gnu::always_inline]] inline bool has_bits(simd::F32 value, float expected) noexcept {
  return every(bits_of(value) == bits_of(simd::all(expected)));
}

/// Arithmetic with a float, or with a register of them, of which `of` makes one. Each line is true if operations are
/// what they say, and false under what its comment names.
template <class Of>
[[nodiscard, gnu::always_inline]] inline bool rounds_each_operation(Of of) noexcept {
  // Volatile: what is computed while compiling says nothing about the program.
  const auto number = [&](float value) {
    volatile float unknown = value;
    return of(unknown);
  };
  constexpr float half_ulp = 5.96046448e-8f;  // 2^-24, of numbers from 1 on
  constexpr float least = 1.17549435e-38f;    // of normal numbers: 2^-126
  const auto one = number(1.0f);
  const auto above_one = number(1.0f + 4096.0f * half_ulp);  // its square needs 25 bits
  const auto large = number(extend::whole_numbers);
  const auto divisor = number(3.0f);
  const auto quotients = [&](float a) { return has_bits(number(a) / divisor, a / 3.0f); };
  using simd::sqrt;

  // All of them, whatever the first say: the compiler replaces several divisions at once.
  bool right = has_bits(product(above_one, above_one) - number(1.0f + 8192.0f * half_ulp), 0.0f);  // fused
  right &= has_bits((number(0.25f) + large) - large, 0.0f);                                        // regrouped
  right &= quotients(5.0f);  // multiplied by the reciprocal, these and the next ones
  right &= quotients(7.0f);
  right &= quotients(11.0f);
  right &= quotients(13.0f);
  right &= has_bits(number(5.0f) / of(3.0f), 5.0f / 3.0f);
  right &= has_bits(number(7.0f) / of(3.0f), 7.0f / 3.0f);
  right &= has_bits(sqrt(number(3.0f)), 1.73205081f);  // approximated
  right &= has_bits(sqrt(number(5.0f)), 2.23606798f);
  right &= has_bits(one + number(half_ulp / 2.0f), 1.0f);                 // rounded up
  right &= has_bits(one - number(half_ulp / 4.0f), 1.0f);                 // rounded down, or towards zero
  right &= has_bits(number(-0.0f) + of(0.0f), 0.0f);                      // signs of zeros ignored
  right &= has_bits(product(number(least), of(0.5f)), least / 2.0f);      // small results flushed to zero
  right &= has_bits(number(least / 2.0f) + number(least / 2.0f), least);  // small operands taken for zero
  return right;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// True if arithmetic is what the same bits on every machine need: every operation rounded by itself, to the nearest.
/// GCC and clang are kept from fusing a * b + c into one rounding by unfused() wherever their CPUs can; other CPUs may
/// need -ffp-contract=off. False
///   * where something is fused nevertheless;
///   * under -ffast-math, and under those of its parts that change bits, one by one: sums regrouped
///     (-fassociative-math), divisions replaced (-freciprocal-math), NaN or the signs of zeros ignored
///     (-ffinite-math-only, -fno-signed-zeros);
///   * where floats have more bits than 32 on the way (x87: with -m32, add -msse2 -mfpmath=sse);
///   * in a thread that rounds otherwise (fesetround()), or takes numbers below 2^-126 for zero, as a program does of
///     which any library was linked with -ffast-math.
/// Descriptors are then still descriptors, but may differ in their last bits from those of other builds; without NaN,
/// NaN points may be taken for neighbors. It speaks for the flags of the translation unit that calls it, and for the
/// thread. No allocation, reentrant.
[[nodiscard, gnu::always_inline]] inline bool self_check() noexcept {
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
  return false;
#else
  const bool floats = detail::rounds_each_operation([](float value) { return value; });
  const bool lanes = detail::rounds_each_operation([](float value) { return extend::simd::all(value); });
  return floats && lanes;
#endif
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
