// shortshot/self_check.hpp: does the build at hand keep the promise of the same bits everywhere?
#pragma once

#include "base/math.hpp"
#include "base/simd.hpp"
#include "base/unfused.hpp"
#include "config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// True if this translation unit's arithmetic rounds every operation by itself, as the same bits on every machine need.
/// GCC and clang are kept from fusing a * b + c into one rounding by unfused() wherever their CPUs can; other compilers
/// and CPUs may need -ffp-contract=off. False where something is fused nevertheless, or where sums are regrouped and
/// NaN ignored (-ffast-math, which the library does not support). Descriptors are then still descriptors, but may
/// differ in their last bits from those of other builds; under -ffast-math, NaN points may be taken for neighbors. It
/// speaks for the flags of the translation unit that calls it. No allocation, reentrant.
[[nodiscard]] inline bool self_check() noexcept {
  // Volatile: what is computed while compiling says nothing about the program.
  volatile float read_one_ulp_above = 1.00024414f;    // 1 + 2^-12: its square needs 25 bits
  volatile float read_square_in_float = 1.00048828f;  // 1 + 2^-11
  volatile float read_large = extend::whole_numbers;
  volatile float read_small = 0.25f;
  const extend::simd::F32 a = extend::simd::all(read_one_ulp_above);
  const extend::simd::F32 square = extend::simd::all(read_square_in_float);
  const extend::simd::F32 large = extend::simd::all(read_large);
  const extend::simd::F32 small = extend::simd::all(read_small);
  const float scalar_a = read_one_ulp_above;
  const float scalar_large = read_large;

  const bool unfused_lanes = !(extend::simd::largest(extend::simd::abs(a * a - square)) > 0.0f);
  const bool unfused_scalar = extend::unfused(scalar_a * scalar_a) - read_square_in_float == 0.0f;
  const bool ungrouped_lanes = !(extend::simd::largest((small + large) - large) > 0.0f);
  const bool ungrouped_scalar = (read_small + scalar_large) - scalar_large == 0.0f;
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
  const bool knows_nan = false;
#else
  const bool knows_nan = true;
#endif
  return unfused_lanes && unfused_scalar && ungrouped_lanes && ungrouped_scalar && knows_nan;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
