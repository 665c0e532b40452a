// shortshot/simd_sse2.hpp: the lane shim on SSE2, 4 lanes: every x86-64. Included by simd.hpp, which says what it must
// do.
#pragma once

#include <emmintrin.h>

#include <cstddef>
#include <cstdint>

#include "config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace simd {

inline constexpr std::size_t lanes = 4;

struct F32 {
  __m128 v;
};
struct I32 {
  __m128i v;
};
struct Mask {
  __m128 v;
};

/// Square root of one number, exactly rounded. Not std::sqrt, which also calls libm for its errno.
[[nodiscard]] inline float root(float value) noexcept { return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(value))); }

[[nodiscard]] inline F32 load(const float* p) noexcept { return {_mm_loadu_ps(p)}; }
inline void store(float* p, F32 a) noexcept { _mm_storeu_ps(p, a.v); }
inline void store(std::int32_t* p, I32 a) noexcept { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), a.v); }
[[nodiscard]] inline F32 all(float value) noexcept { return {_mm_set1_ps(value)}; }

[[nodiscard]] inline F32 operator+(F32 a, F32 b) noexcept { return {_mm_add_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator-(F32 a, F32 b) noexcept { return {_mm_sub_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator*(F32 a, F32 b) noexcept { return {_mm_mul_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator/(F32 a, F32 b) noexcept { return {_mm_div_ps(a.v, b.v)}; }
[[nodiscard]] inline I32 operator+(I32 a, I32 b) noexcept { return {_mm_add_epi32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator<(F32 a, F32 b) noexcept { return {_mm_cmplt_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>(F32 a, F32 b) noexcept { return {_mm_cmpgt_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>=(F32 a, F32 b) noexcept { return {_mm_cmpge_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator&(Mask a, Mask b) noexcept { return {_mm_and_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator^(Mask a, Mask b) noexcept { return {_mm_xor_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator|(Mask a, Mask b) noexcept { return {_mm_or_ps(a.v, b.v)}; }

[[nodiscard]] inline F32 sqrt(F32 a) noexcept { return {_mm_sqrt_ps(a.v)}; }
[[nodiscard]] inline F32 abs(F32 a) noexcept { return {_mm_andnot_ps(_mm_set1_ps(-0.0f), a.v)}; }
[[nodiscard]] inline F32 min(F32 a, F32 b) noexcept { return {_mm_min_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 max(F32 a, F32 b) noexcept { return {_mm_max_ps(a.v, b.v)}; }

/// yes where m, else no.
[[nodiscard]] inline F32 select(Mask m, F32 yes, F32 no) noexcept {
  return {_mm_or_ps(_mm_and_ps(m.v, yes.v), _mm_andnot_ps(m.v, no.v))};
}
/// -a where m, else a.
[[nodiscard]] inline F32 negate(Mask m, F32 a) noexcept {
  return {_mm_xor_ps(a.v, _mm_and_ps(m.v, _mm_set1_ps(-0.0f)))};
}
/// a where m, else zero.
[[nodiscard]] inline F32 keep(Mask m, F32 a) noexcept { return {_mm_and_ps(m.v, a.v)}; }
[[nodiscard]] inline bool any(Mask m) noexcept { return _mm_movemask_ps(m.v) != 0; }
[[nodiscard]] inline bool every(Mask m) noexcept { return _mm_movemask_ps(m.v) == 0xF; }
/// 1 where m, else zero.
[[nodiscard]] inline I32 ones(Mask m) noexcept { return {_mm_srli_epi32(_mm_castps_si128(m.v), 31)}; }

/// The integers whose bits are those of a.
[[nodiscard]] inline I32 bits_of(F32 a) noexcept { return {_mm_castps_si128(a.v)}; }
[[nodiscard]] inline F32 to_float(I32 a) noexcept { return {_mm_cvtepi32_ps(a.v)}; }

/// Towards zero; |a| must stay below 2^31.
[[nodiscard]] inline I32 truncate_to_int(F32 a) noexcept { return {_mm_cvttps_epi32(a.v)}; }
[[nodiscard]] inline F32 truncate(F32 a) noexcept { return {_mm_cvtepi32_ps(_mm_cvttps_epi32(a.v))}; }

/// To the nearest integer, ties to even (the default rounding mode).
[[nodiscard]] inline I32 round_to_int(F32 a) noexcept { return {_mm_cvtps_epi32(a.v)}; }

}  // namespace simd
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
