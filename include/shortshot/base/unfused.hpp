// shortshot/base/unfused.hpp: no a * b + c in one rounding, whatever the compiler was told.
#ifndef SHORTSHOT_BASE_UNFUSED_HPP
#define SHORTSHOT_BASE_UNFUSED_HPP

#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Hides where a number comes from: an empty assembly statement, no instruction.
template <class Float>
[[nodiscard]] inline Float hidden(Float number) noexcept {
#if defined(__FMA__) || defined(__FMA4__) || defined(__AVX512F__)
  __asm__("" : "+x"(number));
#elif defined(__aarch64__)
  __asm__("" : "+w"(number));
#elif defined(__ARM_FEATURE_FMA)
  __asm__("" : "+t"(number));
#elif defined(__riscv_flen)
  __asm__("" : "+f"(number));
#elif defined(__riscv_zfinx)
  __asm__("" : "+r"(number));
#endif
  return number;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// A product (a float, or a register of them), rounded as IEEE 754 says. Where the CPU has a fused multiply-add, GCC
/// and clang may use it for a product and the sum that it goes into, which gives other bits: every product that goes
/// into a sum must pass through here, and every quotient: by a constant, it may become a product.
template <class Float>
[[nodiscard]] constexpr Float unfused(Float product) noexcept {
  return __builtin_is_constant_evaluated() ? product : detail::hidden(product);
}

/// The inner product, summed as x + z first, then y.
[[nodiscard]] inline float dot(const float (&a)[3], const float (&b)[3]) noexcept {
  return (unfused(a[0] * b[0]) + unfused(a[2] * b[2])) + unfused(a[1] * b[1]);
}

/// 1.5 * 2^23: a float below 2^22 to which this is added, and from which it is taken again, has been rounded to a whole
/// number.
inline constexpr float whole_numbers = 12582912.0f;

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_BASE_UNFUSED_HPP
