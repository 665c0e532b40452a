// shortshot/simd_avx2.hpp: the lane shim on AVX2, 8 lanes; no fused multiply-add, which rounds differently. Included by
// simd.hpp, which says what it must do.
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace simd {

inline constexpr std::size_t lanes = 8;

struct F32 {
  __m256 v;
};
struct I32 {
  __m256i v;
};
struct Mask {
  __m256 v;
};

/// Square root of one number, exactly rounded. Not std::sqrt, which also calls libm for its errno.
[[nodiscard]] inline float root(float value) noexcept { return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(value))); }

[[nodiscard]] inline F32 load(const float* p) noexcept { return {_mm256_loadu_ps(p)}; }
inline void store(float* p, F32 a) noexcept { _mm256_storeu_ps(p, a.v); }
inline void store(std::int32_t* p, I32 a) noexcept { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v); }
[[nodiscard]] inline F32 all(float value) noexcept { return {_mm256_set1_ps(value)}; }

[[nodiscard]] inline F32 operator+(F32 a, F32 b) noexcept { return {_mm256_add_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator-(F32 a, F32 b) noexcept { return {_mm256_sub_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator*(F32 a, F32 b) noexcept { return {_mm256_mul_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator/(F32 a, F32 b) noexcept { return {_mm256_div_ps(a.v, b.v)}; }
[[nodiscard]] inline I32 operator+(I32 a, I32 b) noexcept { return {_mm256_add_epi32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator<(F32 a, F32 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
[[nodiscard]] inline Mask operator>(F32 a, F32 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)}; }
[[nodiscard]] inline Mask operator>=(F32 a, F32 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ)}; }
[[nodiscard]] inline Mask operator&(Mask a, Mask b) noexcept { return {_mm256_and_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator^(Mask a, Mask b) noexcept { return {_mm256_xor_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator|(Mask a, Mask b) noexcept { return {_mm256_or_ps(a.v, b.v)}; }

[[nodiscard]] inline F32 sqrt(F32 a) noexcept { return {_mm256_sqrt_ps(a.v)}; }
[[nodiscard]] inline F32 abs(F32 a) noexcept { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)}; }
[[nodiscard]] inline F32 min(F32 a, F32 b) noexcept { return {_mm256_min_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 max(F32 a, F32 b) noexcept { return {_mm256_max_ps(a.v, b.v)}; }

/// yes where m, else no.
[[nodiscard]] inline F32 select(Mask m, F32 yes, F32 no) noexcept { return {_mm256_blendv_ps(no.v, yes.v, m.v)}; }
/// -a where m, else a.
[[nodiscard]] inline F32 negate(Mask m, F32 a) noexcept {
  return {_mm256_xor_ps(a.v, _mm256_and_ps(m.v, _mm256_set1_ps(-0.0f)))};
}
/// a where m, else zero.
[[nodiscard]] inline F32 keep(Mask m, F32 a) noexcept { return {_mm256_and_ps(m.v, a.v)}; }
[[nodiscard]] inline bool any(Mask m) noexcept { return _mm256_movemask_ps(m.v) != 0; }
[[nodiscard]] inline bool every(Mask m) noexcept { return _mm256_movemask_ps(m.v) == 0xFF; }
/// 1 where m, else zero.
[[nodiscard]] inline I32 ones(Mask m) noexcept { return {_mm256_srli_epi32(_mm256_castps_si256(m.v), 31)}; }

/// The integers whose bits are those of a.
[[nodiscard]] inline I32 bits_of(F32 a) noexcept { return {_mm256_castps_si256(a.v)}; }
[[nodiscard]] inline F32 to_float(I32 a) noexcept { return {_mm256_cvtepi32_ps(a.v)}; }

/// Towards zero; |a| must stay below 2^31.
[[nodiscard]] inline I32 truncate_to_int(F32 a) noexcept { return {_mm256_cvttps_epi32(a.v)}; }
[[nodiscard]] inline F32 truncate(F32 a) noexcept {
  return {_mm256_round_ps(a.v, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC)};
}

/// To the nearest integer, ties to even (the default rounding mode).
[[nodiscard]] inline I32 round_to_int(F32 a) noexcept { return {_mm256_cvtps_epi32(a.v)}; }

}  // namespace simd
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
