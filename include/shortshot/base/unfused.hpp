// shortshot/base/unfused.hpp: no a * b + c in one rounding, whatever the compiler was told.
#pragma once

#include "../config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

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

}  // namespace detail

/// A product (a float, or a register of them), rounded as IEEE 754 says. Where the CPU has a fused multiply-add, GCC
/// and clang may use it for a product and the sum that it goes into, which gives other bits: every product that goes
/// into a sum must pass through here.
template <class Float>
[[nodiscard]] constexpr Float rounded(Float product) noexcept {
  return __builtin_is_constant_evaluated() ? product : detail::hidden(product);
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
