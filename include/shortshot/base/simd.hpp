// shortshot/base/simd.hpp: the thin lane shim. Every pass of the kernel is written once, in terms of F32, I32 and Mask;
// the compiler's own macros choose what they are: AVX2, SSE2, NEON (aarch64) or one lane at a time.
//
// All operations are exactly rounded IEEE single precision or pure bit moves, and every accumulation in the kernel is
// an integer sum (fixed_point.hpp), so that the number of lanes never changes a result.
#ifndef SHORTSHOT_BASE_SIMD_HPP
#define SHORTSHOT_BASE_SIMD_HPP

#include "../config.hpp"
#include "quad.hpp"
#include "unfused.hpp"

#if defined(__AVX2__) || defined(SHORTSHOT_FOR_AVX2)
#include "simd_avx2.hpp"
#elif defined(__SSE2__)
#include "simd_sse2.hpp"
#elif defined(__aarch64__)
#include "simd_neon.hpp"
#else
#include "simd_scalar.hpp"
#endif

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// f applied lane by lane, for the rare function that is not worth a vector version.
template <class Function>
[[nodiscard]] inline F32 map(Function f, F32 a) noexcept {
  float values[lanes];
  store(values, a);
  for (float& value : values) value = f(value);
  return load(values);
}

/// The nearest whole numbers, as floats; |a| must stay below 2^22.
[[nodiscard, gnu::always_inline]] inline F32 to_whole(F32 a) noexcept {
  return (a + all(whole_numbers)) - all(whole_numbers);
}

/// a * b towards zero; |a * b| must stay below 2^31. (Not unfused: no sum follows. A power of two becomes a part of the
/// conversion where it can.)
[[nodiscard, gnu::always_inline]] inline I32 truncated_product(F32 a, F32 b) noexcept {
  return truncate_to_int({a.v * b.v});
}

/// The largest lane.
[[nodiscard, gnu::always_inline]] inline float largest(F32 a) noexcept {
  float values[lanes];
  store(values, a);
  float result = values[0];
  for (const float value : values) result = value > result ? value : result;
  return result;
}

/// Sum of all lanes.
[[nodiscard, gnu::always_inline]] inline std::int32_t sum(I32 a) noexcept {
  std::int32_t values[lanes];
  store(values, a);
  std::int32_t total = 0;
  for (const std::int32_t value : values) total += value;
  return total;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_HPP
