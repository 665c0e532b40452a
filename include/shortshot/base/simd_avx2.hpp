// shortshot/base/simd_avx2.hpp: the lane shim on AVX2, 8 lanes. Included by simd.hpp, which says what it must do.
#ifndef SHORTSHOT_BASE_SIMD_AVX2_HPP
#define SHORTSHOT_BASE_SIMD_AVX2_HPP

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "../config.hpp"
#include "quad.hpp"
#include "unfused.hpp"

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

inline constexpr std::size_t lanes = 8;

/// Does one instruction bring an integer to 0..2^k - 1?
inline constexpr bool saturates = false;

/// Does one instruction add to memory, at any constant distance from where a register points?
inline constexpr bool adds_to_memory = true;

struct F32 {
  __m256 v;
};
struct I32 {
  __m256i v;
};
struct Mask {
  __m256 v;
};
using SignMask = Mask;
struct I16 {
  std::int16_t v __attribute__((vector_size(32)));
};

/// Square root of one number, exactly rounded. Not std::sqrt, which also calls libm for its errno.
[[nodiscard]] inline float sqrt(float value) noexcept { return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(value))); }

[[nodiscard]] inline F32 load(const float* p) noexcept { return {_mm256_loadu_ps(p)}; }
[[nodiscard]] inline I32 load(const std::uint32_t* p) noexcept {
  return {_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))};
}
inline void store(float* p, F32 a) noexcept { _mm256_storeu_ps(p, a.v); }
inline void store(std::int32_t* p, I32 a) noexcept { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v); }
inline void store(std::uint32_t* p, I32 a) noexcept { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v); }
[[nodiscard]] inline F32 all(float value) noexcept { return {_mm256_set1_ps(value)}; }
/// value_at(k) in lane k.
template <class Function>
[[nodiscard, gnu::always_inline]] inline F32 from_lanes(Function value_at) noexcept {
  return {_mm256_setr_ps(value_at(0), value_at(1), value_at(2), value_at(3), value_at(4), value_at(5), value_at(6),
                         value_at(7))};
}

[[nodiscard]] inline F32 operator+(F32 a, F32 b) noexcept { return {_mm256_add_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator-(F32 a, F32 b) noexcept { return {_mm256_sub_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator*(F32 a, F32 b) noexcept { return {unfused(_mm256_mul_ps(a.v, b.v))}; }
[[nodiscard]] inline F32 operator/(F32 a, F32 b) noexcept { return {unfused(_mm256_div_ps(a.v, b.v))}; }
[[nodiscard]] inline I32 operator+(I32 a, I32 b) noexcept { return {_mm256_add_epi32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator<(F32 a, F32 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
[[nodiscard]] inline Mask operator>(F32 a, F32 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)}; }
[[nodiscard]] inline Mask operator>=(F32 a, F32 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ)}; }
[[nodiscard]] inline Mask operator!=(F32 a, F32 b) noexcept { return {_mm256_cmp_ps(a.v, b.v, _CMP_NEQ_UQ)}; }
[[nodiscard]] inline Mask operator&(Mask a, Mask b) noexcept { return {_mm256_and_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator|(Mask a, Mask b) noexcept { return {_mm256_or_ps(a.v, b.v)}; }

[[nodiscard]] inline F32 sqrt(F32 a) noexcept { return {_mm256_sqrt_ps(a.v)}; }
[[nodiscard]] inline F32 abs(F32 a) noexcept {
  return {_mm256_and_ps(a.v, _mm256_castsi256_ps(_mm256_set1_epi32(0x7FFFFFFF)))};
}
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
/// a + 1 where m, else a.
[[nodiscard]] inline I32 increment(Mask m, I32 a) noexcept { return {_mm256_sub_epi32(a.v, _mm256_castps_si256(m.v))}; }

/// The integers whose bits are those of a.
[[nodiscard]] inline I32 bits_of(F32 a) noexcept { return {_mm256_castps_si256(a.v)}; }
/// The floats whose bits are those of a.
[[nodiscard]] inline F32 from_bits(I32 a) noexcept { return {_mm256_castsi256_ps(a.v)}; }
[[nodiscard]] inline F32 to_float(I32 a) noexcept { return {_mm256_cvtepi32_ps(a.v)}; }

/// Towards zero; |a| must stay below 2^31.
[[nodiscard]] inline I32 truncate_to_int(F32 a) noexcept { return {_mm256_cvttps_epi32(a.v)}; }

/// To the nearest integer, ties to even (the default rounding mode).
[[nodiscard]] inline I32 round_to_int(F32 a) noexcept { return {_mm256_cvtps_epi32(a.v)}; }

/// Lanes of integers.
[[nodiscard]] inline I32 all_int(std::int32_t value) noexcept { return {_mm256_set1_epi32(value)}; }
[[nodiscard]] inline I32 operator-(I32 a, I32 b) noexcept { return {_mm256_sub_epi32(a.v, b.v)}; }
[[nodiscard]] inline I32 operator&(I32 a, I32 b) noexcept { return {_mm256_and_si256(a.v, b.v)}; }
[[nodiscard]] inline Mask operator==(I32 a, I32 b) noexcept {
  return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.v, b.v))};
}
[[nodiscard]] inline Mask operator>(I32 a, I32 b) noexcept {
  return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(a.v, b.v))};
}
[[nodiscard]] inline I32 shift_left(I32 a, int count) noexcept {
  return {_mm256_sll_epi32(a.v, _mm_cvtsi32_si128(count))};
}
/// Towards minus infinity.
[[nodiscard]] inline I32 shift_right(I32 a, int count) noexcept {
  return {_mm256_sra_epi32(a.v, _mm_cvtsi32_si128(count))};
}
/// For numbers from -1 to 2^15 - 1.
[[nodiscard]] inline I32 small_min(I32 a, I32 b) noexcept { return {_mm256_min_epi16(a.v, b.v)}; }
[[nodiscard]] inline I32 small_max(I32 a, I32 b) noexcept { return {_mm256_max_epi16(a.v, b.v)}; }
/// For a from -2^15, b from 0, to 2^15 - 1.
[[nodiscard]] inline I32 small_product(I32 a, I32 b) noexcept { return {_mm256_madd_epi16(a.v, b.v)}; }
/// For numbers from 0 to 2^31 - 1, as is the product.
[[nodiscard]] inline I32 product(I32 a, I32 b) noexcept { return {_mm256_mullo_epi32(a.v, b.v)}; }
[[nodiscard]] inline Mask is_negative(I32 a) noexcept { return {_mm256_castsi256_ps(_mm256_srai_epi32(a.v, 31))}; }
/// -1 where m, else 1.
[[nodiscard]] inline I32 minus_one_or_one(Mask m) noexcept {
  return {_mm256_or_si256(_mm256_castps_si256(m.v), _mm256_set1_epi32(1))};
}
/// ~a where m, else a.
[[nodiscard]] inline I32 invert(Mask m, I32 a) noexcept { return {_mm256_xor_si256(_mm256_castps_si256(m.v), a.v)}; }
/// a where m, else zero.
[[nodiscard]] inline I32 keep(Mask m, I32 a) noexcept { return {_mm256_and_si256(_mm256_castps_si256(m.v), a.v)}; }
/// Zero where m, else a.
[[nodiscard]] inline I32 drop(Mask m, I32 a) noexcept { return {_mm256_andnot_si256(_mm256_castps_si256(m.v), a.v)}; }
/// -a where `sign` has its sign bit set, else a.
[[nodiscard]] inline F32 flip_sign(F32 a, F32 sign) noexcept {
  return {_mm256_xor_ps(a.v, _mm256_and_ps(sign.v, _mm256_set1_ps(-0.0f)))};
}

/// Two registers of integers from -2^15 to 2^15 - 1, or of masks (-1 where set), as one of 16 bits each. store() has
/// them in order, those of a first.
[[nodiscard]] inline I16 narrow(I32 a, I32 b) noexcept {
  I16 both{};  // the first halves of a and b, then the second ones
  both.v = reinterpret_cast<decltype(both.v)>(_mm256_packs_epi32(a.v, b.v));
  return both;
}
[[nodiscard]] inline I16 narrow(Mask a, Mask b) noexcept { return narrow(bits_of({a.v}), bits_of({b.v})); }
/// (Where b comes from is hidden: a product by a constant becomes shifts and sums, which take longer.)
[[nodiscard]] inline I16 operator*(I16 a, I16 b) noexcept {
  __asm__("" : "+x"(b.v));
  return {a.v * b.v};
}
inline void store(std::int16_t* p, I16 a) noexcept {
  const __m256i in_order = _mm256_permute4x64_epi64(reinterpret_cast<__m256i>(a.v), _MM_SHUFFLE(3, 1, 2, 0));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), in_order);
}

/// What each lane has in a, b, c and d.
[[gnu::always_inline]] inline void transpose(I32 a, I32 b, I32 c, I32 d, Quad (&quads)[lanes]) noexcept {
  const __m256i ab[2] = {_mm256_unpacklo_epi32(a.v, b.v), _mm256_unpackhi_epi32(a.v, b.v)};
  const __m256i cd[2] = {_mm256_unpacklo_epi32(c.v, d.v), _mm256_unpackhi_epi32(c.v, d.v)};
  const auto put = [&](std::size_t k, __m256i both) {  // lanes k and k + 4
    quads[k] = reinterpret_cast<Quad>(_mm256_castsi256_si128(both));
    quads[k + 4] = reinterpret_cast<Quad>(_mm256_extracti128_si256(both, 1));
  };
  for (std::size_t k = 0; k < 2; ++k) {
    put(2 * k, _mm256_unpacklo_epi64(ab[k], cd[k]));
    put(2 * k + 1, _mm256_unpackhi_epi64(ab[k], cd[k]));
  }
}

/// The three floats at base + 3 * index[k], for all lanes.
[[gnu::always_inline]] inline void load_triples(const float* base, const std::uint32_t* index, F32& a, F32& b,
                                                F32& c) noexcept {
  const auto pair = [&](std::size_t k, std::size_t from) {  // (p[from], p[from + 1]) of lanes k and k + 1
    const auto* const low = reinterpret_cast<const __m64*>(base + 3 * static_cast<std::size_t>(index[k]) + from);
    const auto* const high = reinterpret_cast<const __m64*>(base + 3 * static_cast<std::size_t>(index[k + 1]) + from);
    return _mm_loadh_pi(_mm_loadl_pi(_mm_setzero_ps(), low), high);
  };
  // Lanes 0, 1, 4, 5 and 2, 3, 6, 7, so that one shuffle in both halves brings them into order.
  const auto pairs = [&](std::size_t k, std::size_t from) { return _mm256_set_m128(pair(k + 4, from), pair(k, from)); };
  const __m256 ab[2] = {pairs(0, 0), pairs(2, 0)};
  const __m256 bc[2] = {pairs(0, 1), pairs(2, 1)};
  a = {_mm256_shuffle_ps(ab[0], ab[1], _MM_SHUFFLE(2, 0, 2, 0))};
  b = {_mm256_shuffle_ps(bc[0], bc[1], _MM_SHUFFLE(2, 0, 2, 0))};
  c = {_mm256_shuffle_ps(bc[0], bc[1], _MM_SHUFFLE(3, 1, 3, 1))};
}

/// Lanes 0 to count - 1; count is 1 or more.
[[nodiscard]] inline Mask first(std::size_t count) noexcept {
  const __m256i limit = _mm256_set1_epi32(static_cast<int>(count));
  return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(limit, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)))};
}

/// For each set of lanes their numbers in ascending order, four bits each, the lowest bits first.
struct LaneLists {
  std::uint32_t of[256];
  constexpr LaneLists() noexcept : of{} {
    for (std::uint32_t set = 0; set < 256; ++set) {
      std::uint32_t count = 0;
      for (std::uint32_t lane = 0; lane < 8; ++lane) {
        if ((set >> lane & 1u) != 0) of[set] |= lane << 4 * count++;
      }
    }
  }
};
inline constexpr LaneLists lane_lists{};

/// How store() packs the lanes where a mask is set.
struct Packing {
  __m256i lanes;
  std::uint32_t count;
};

[[nodiscard]] inline Packing packing(Mask m) noexcept {
  const auto set = static_cast<std::uint32_t>(_mm256_movemask_ps(m.v));
  const __m256i list = _mm256_set1_epi32(static_cast<int>(lane_lists.of[set]));
  // Permutations look at the lowest three bits of each lane only.
  return {_mm256_srlv_epi32(list, _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28)),
          static_cast<std::uint32_t>(__builtin_popcount(set))};
}

/// The lanes where the mask is set, one behind the other; what is written behind them, up to a register's length, means
/// nothing.
inline void store(float* p, F32 a, const Packing& packing) noexcept {
  _mm256_storeu_ps(p, _mm256_permutevar8x32_ps(a.v, packing.lanes));
}
inline void store(std::uint32_t* p, I32 a, const Packing& packing) noexcept {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), _mm256_permutevar8x32_epi32(a.v, packing.lanes));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_AVX2_HPP
