// shortshot/base/simd_sse2.hpp: the lane shim on SSE2, 4 lanes: every x86-64. Included by simd.hpp, which says what it
// must do.
#ifndef SHORTSHOT_BASE_SIMD_SSE2_HPP
#define SHORTSHOT_BASE_SIMD_SSE2_HPP

#include <emmintrin.h>

#include <cstddef>
#include <cstdint>

#include "../config.hpp"
#include "quad.hpp"
#include "unfused.hpp"

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

inline constexpr std::size_t lanes = 4;

/// Does one instruction bring an integer to 0..2^k - 1?
inline constexpr bool saturates = false;

/// Does one instruction add to memory, at any constant distance from where a register points?
inline constexpr bool adds_to_memory = true;

struct F32 {
  __m128 v;
};
struct I32 {
  __m128i v;
};
struct Mask {
  __m128 v;
};
using SignMask = Mask;
struct I16 {
  std::int16_t v __attribute__((vector_size(16)));
};

/// Square root of one number, exactly rounded. Not std::sqrt, which also calls libm for its errno.
[[nodiscard]] inline float sqrt(float value) noexcept { return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(value))); }

[[nodiscard]] inline F32 load(const float* p) noexcept { return {_mm_loadu_ps(p)}; }
[[nodiscard]] inline I32 load(const std::uint32_t* p) noexcept {
  return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))};
}
inline void store(float* p, F32 a) noexcept { _mm_storeu_ps(p, a.v); }
inline void store(std::int32_t* p, I32 a) noexcept { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), a.v); }
inline void store(std::uint32_t* p, I32 a) noexcept { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), a.v); }
[[nodiscard]] inline F32 all(float value) noexcept { return {_mm_set1_ps(value)}; }
/// value_at(k) in lane k.
template <class Function>
[[nodiscard, gnu::always_inline]] inline F32 from_lanes(Function value_at) noexcept {
  return {_mm_setr_ps(value_at(0), value_at(1), value_at(2), value_at(3))};
}

[[nodiscard]] inline F32 operator+(F32 a, F32 b) noexcept { return {_mm_add_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator-(F32 a, F32 b) noexcept { return {_mm_sub_ps(a.v, b.v)}; }
[[nodiscard]] inline F32 operator*(F32 a, F32 b) noexcept { return {unfused(_mm_mul_ps(a.v, b.v))}; }
[[nodiscard]] inline F32 operator/(F32 a, F32 b) noexcept { return {unfused(_mm_div_ps(a.v, b.v))}; }
[[nodiscard]] inline I32 operator+(I32 a, I32 b) noexcept { return {_mm_add_epi32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator<(F32 a, F32 b) noexcept { return {_mm_cmplt_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>(F32 a, F32 b) noexcept { return {_mm_cmpgt_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>=(F32 a, F32 b) noexcept { return {_mm_cmpge_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator!=(F32 a, F32 b) noexcept { return {_mm_cmpneq_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator&(Mask a, Mask b) noexcept { return {_mm_and_ps(a.v, b.v)}; }
[[nodiscard]] inline Mask operator|(Mask a, Mask b) noexcept { return {_mm_or_ps(a.v, b.v)}; }

[[nodiscard]] inline F32 sqrt(F32 a) noexcept { return {_mm_sqrt_ps(a.v)}; }
[[nodiscard]] inline F32 abs(F32 a) noexcept { return {_mm_and_ps(a.v, _mm_castsi128_ps(_mm_set1_epi32(0x7FFFFFFF)))}; }
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
/// a + 1 where m, else a.
[[nodiscard]] inline I32 increment(Mask m, I32 a) noexcept { return {_mm_sub_epi32(a.v, _mm_castps_si128(m.v))}; }

/// The integers whose bits are those of a.
[[nodiscard]] inline I32 bits_of(F32 a) noexcept { return {_mm_castps_si128(a.v)}; }
/// The floats whose bits are those of a.
[[nodiscard]] inline F32 from_bits(I32 a) noexcept { return {_mm_castsi128_ps(a.v)}; }
[[nodiscard]] inline F32 to_float(I32 a) noexcept { return {_mm_cvtepi32_ps(a.v)}; }

/// Towards zero; |a| must stay below 2^31.
[[nodiscard]] inline I32 truncate_to_int(F32 a) noexcept { return {_mm_cvttps_epi32(a.v)}; }

/// To the nearest integer, ties to even (the default rounding mode).
[[nodiscard]] inline I32 round_to_int(F32 a) noexcept { return {_mm_cvtps_epi32(a.v)}; }

/// Lanes of integers.
[[nodiscard]] inline I32 all_int(std::int32_t value) noexcept { return {_mm_set1_epi32(value)}; }
[[nodiscard]] inline I32 operator-(I32 a, I32 b) noexcept { return {_mm_sub_epi32(a.v, b.v)}; }
[[nodiscard]] inline I32 operator&(I32 a, I32 b) noexcept { return {_mm_and_si128(a.v, b.v)}; }
[[nodiscard]] inline Mask operator==(I32 a, I32 b) noexcept { return {_mm_castsi128_ps(_mm_cmpeq_epi32(a.v, b.v))}; }
[[nodiscard]] inline Mask operator>(I32 a, I32 b) noexcept { return {_mm_castsi128_ps(_mm_cmpgt_epi32(a.v, b.v))}; }
[[nodiscard]] inline I32 shift_left(I32 a, int count) noexcept {
  return {_mm_sll_epi32(a.v, _mm_cvtsi32_si128(count))};
}
/// Towards minus infinity.
[[nodiscard]] inline I32 shift_right(I32 a, int count) noexcept {
  return {_mm_sra_epi32(a.v, _mm_cvtsi32_si128(count))};
}
/// For numbers from -1 to 2^15 - 1.
[[nodiscard]] inline I32 small_min(I32 a, I32 b) noexcept { return {_mm_min_epi16(a.v, b.v)}; }
[[nodiscard]] inline I32 small_max(I32 a, I32 b) noexcept { return {_mm_max_epi16(a.v, b.v)}; }
/// For a from -2^15, b from 0, to 2^15 - 1.
[[nodiscard]] inline I32 small_product(I32 a, I32 b) noexcept { return {_mm_madd_epi16(a.v, b.v)}; }
/// For numbers from 0 to 2^31 - 1, as is the product.
[[nodiscard]] inline I32 product(I32 a, I32 b) noexcept {
  const __m128i even = _mm_mul_epu32(a.v, b.v);
  const __m128i odd = _mm_mul_epu32(_mm_srli_epi64(a.v, 32), _mm_srli_epi64(b.v, 32));
  return {_mm_or_si128(even, _mm_slli_epi64(odd, 32))};
}
[[nodiscard]] inline Mask is_negative(I32 a) noexcept { return {_mm_castsi128_ps(_mm_srai_epi32(a.v, 31))}; }
/// -1 where m, else 1.
[[nodiscard]] inline I32 minus_one_or_one(Mask m) noexcept {
  return {_mm_or_si128(_mm_castps_si128(m.v), _mm_set1_epi32(1))};
}
/// ~a where m, else a.
[[nodiscard]] inline I32 invert(Mask m, I32 a) noexcept { return {_mm_xor_si128(_mm_castps_si128(m.v), a.v)}; }
/// a where m, else zero.
[[nodiscard]] inline I32 keep(Mask m, I32 a) noexcept { return {_mm_and_si128(_mm_castps_si128(m.v), a.v)}; }
/// Zero where m, else a.
[[nodiscard]] inline I32 drop(Mask m, I32 a) noexcept { return {_mm_andnot_si128(_mm_castps_si128(m.v), a.v)}; }
/// -a where `sign` has its sign bit set, else a.
[[nodiscard]] inline F32 flip_sign(F32 a, F32 sign) noexcept {
  return {_mm_xor_ps(a.v, _mm_and_ps(sign.v, _mm_set1_ps(-0.0f)))};
}

/// Two registers of integers from -2^15 to 2^15 - 1, or of masks (-1 where set), as one of 16 bits each. store() has
/// them in order, those of a first.
[[nodiscard]] inline I16 narrow(I32 a, I32 b) noexcept {
  I16 both{};
  both.v = reinterpret_cast<decltype(both.v)>(_mm_packs_epi32(a.v, b.v));
  return both;
}
[[nodiscard]] inline I16 narrow(Mask a, Mask b) noexcept { return narrow(bits_of({a.v}), bits_of({b.v})); }
/// (Where b comes from is hidden: a product by a constant becomes shifts and sums, which take longer.)
[[nodiscard]] inline I16 operator*(I16 a, I16 b) noexcept {
  __asm__("" : "+x"(b.v));
  return {a.v * b.v};
}
inline void store(std::int16_t* p, I16 a) noexcept {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), reinterpret_cast<__m128i>(a.v));
}

/// What each lane has in a, b, c and d.
[[gnu::always_inline]] inline void transpose(I32 a, I32 b, I32 c, I32 d, Quad (&quads)[lanes]) noexcept {
  const __m128i ab[2] = {_mm_unpacklo_epi32(a.v, b.v), _mm_unpackhi_epi32(a.v, b.v)};
  const __m128i cd[2] = {_mm_unpacklo_epi32(c.v, d.v), _mm_unpackhi_epi32(c.v, d.v)};
  for (std::size_t k = 0; k < 2; ++k) {
    quads[2 * k] = reinterpret_cast<Quad>(_mm_unpacklo_epi64(ab[k], cd[k]));
    quads[2 * k + 1] = reinterpret_cast<Quad>(_mm_unpackhi_epi64(ab[k], cd[k]));
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
  const __m128 ab[2] = {pair(0, 0), pair(2, 0)};
  const __m128 bc[2] = {pair(0, 1), pair(2, 1)};
  a = {_mm_shuffle_ps(ab[0], ab[1], _MM_SHUFFLE(2, 0, 2, 0))};
  b = {_mm_shuffle_ps(bc[0], bc[1], _MM_SHUFFLE(2, 0, 2, 0))};
  c = {_mm_shuffle_ps(bc[0], bc[1], _MM_SHUFFLE(3, 1, 3, 1))};
}

/// Lanes 0 to count - 1; count is 1 or more.
[[nodiscard]] inline Mask first(std::size_t count) noexcept {
  const __m128i limit = _mm_set1_epi32(static_cast<int>(count));
  return {_mm_castsi128_ps(_mm_cmplt_epi32(_mm_setr_epi32(0, 1, 2, 3), limit))};
}

/// How store() packs the lanes where a mask is set: each half of the register is packed by itself, and the second half
/// is stored behind what the first one keeps.
struct Packing {
  __m128 second_only;  // in the lane that receives it: of a pair of lanes, the first is dropped
  std::uint32_t first_half;
  std::uint32_t count;
};

[[nodiscard]] inline Packing packing(Mask m) noexcept {
  const auto bits = static_cast<std::uint32_t>(_mm_movemask_ps(m.v));
  const std::uint32_t pairs = bits - (bits >> 1 & 5u);  // two counts of two bits each
  return {m.v, pairs & 3u, (pairs & 3u) + (pairs >> 2)};
}

/// The lanes where the mask is set, one behind the other; what is written behind them, up to a register's length, means
/// nothing.
inline void store(float* p, F32 a, const Packing& packing) noexcept {
  const __m128 second = _mm_shuffle_ps(a.v, a.v, _MM_SHUFFLE(3, 3, 1, 1));
  const __m128 packed = _mm_xor_ps(second, _mm_and_ps(packing.second_only, _mm_xor_ps(second, a.v)));
  _mm_storel_pi(reinterpret_cast<__m64*>(p), packed);
  _mm_storeh_pi(reinterpret_cast<__m64*>(p + packing.first_half), packed);
}
inline void store(std::uint32_t* p, I32 a, const Packing& packing) noexcept {
  store(reinterpret_cast<float*>(p), {_mm_castsi128_ps(a.v)}, packing);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_SSE2_HPP
