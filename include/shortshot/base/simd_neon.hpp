// shortshot/base/simd_neon.hpp: the lane shim on NEON, 4 lanes: every aarch64 (32-bit NEON flushes denormals and cannot
// divide). Included by simd.hpp, which says what it must do.
#ifndef SHORTSHOT_BASE_SIMD_NEON_HPP
#define SHORTSHOT_BASE_SIMD_NEON_HPP

#include <arm_neon.h>

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
inline constexpr bool adds_to_memory = false;

struct F32 {
  float32x4_t v;
};
struct I32 {
  int32x4_t v;
};
struct Mask {
  uint32x4_t v;
};
using SignMask = Mask;
struct I16 {
  std::int16_t v __attribute__((vector_size(16)));
};

/// Square root of one number, exactly rounded. Not std::sqrt, which also calls libm for its errno.
[[nodiscard]] inline float sqrt(float value) noexcept { return vget_lane_f32(vsqrt_f32(vdup_n_f32(value)), 0); }

[[nodiscard]] inline F32 load(const float* p) noexcept { return {vld1q_f32(p)}; }
[[nodiscard]] inline I32 load(const std::uint32_t* p) noexcept { return {vreinterpretq_s32_u32(vld1q_u32(p))}; }
inline void store(float* p, F32 a) noexcept { vst1q_f32(p, a.v); }
inline void store(std::int32_t* p, I32 a) noexcept { vst1q_s32(p, a.v); }
inline void store(std::uint32_t* p, I32 a) noexcept { vst1q_u32(p, vreinterpretq_u32_s32(a.v)); }
[[nodiscard]] inline F32 all(float value) noexcept { return {vdupq_n_f32(value)}; }
/// value_at(k) in lane k.
template <class Function>
[[nodiscard, gnu::always_inline]] inline F32 from_lanes(Function value_at) noexcept {
  return {float32x4_t{value_at(0), value_at(1), value_at(2), value_at(3)}};
}

[[nodiscard]] inline F32 operator+(F32 a, F32 b) noexcept { return {vaddq_f32(a.v, b.v)}; }
[[nodiscard]] inline F32 operator-(F32 a, F32 b) noexcept { return {vsubq_f32(a.v, b.v)}; }
[[nodiscard]] inline F32 operator*(F32 a, F32 b) noexcept { return {unfused(vmulq_f32(a.v, b.v))}; }
[[nodiscard]] inline F32 operator/(F32 a, F32 b) noexcept { return {unfused(vdivq_f32(a.v, b.v))}; }
[[nodiscard]] inline I32 operator+(I32 a, I32 b) noexcept { return {vaddq_s32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator<(F32 a, F32 b) noexcept { return {vcltq_f32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>(F32 a, F32 b) noexcept { return {vcgtq_f32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>=(F32 a, F32 b) noexcept { return {vcgeq_f32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator!=(F32 a, F32 b) noexcept { return {vmvnq_u32(vceqq_f32(a.v, b.v))}; }
[[nodiscard]] inline Mask operator&(Mask a, Mask b) noexcept { return {vandq_u32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator|(Mask a, Mask b) noexcept { return {vorrq_u32(a.v, b.v)}; }

[[nodiscard]] inline F32 sqrt(F32 a) noexcept { return {vsqrtq_f32(a.v)}; }
[[nodiscard]] inline F32 abs(F32 a) noexcept { return {vabsq_f32(a.v)}; }
[[nodiscard]] inline F32 min(F32 a, F32 b) noexcept { return {vbslq_f32(vcltq_f32(a.v, b.v), a.v, b.v)}; }
[[nodiscard]] inline F32 max(F32 a, F32 b) noexcept { return {vbslq_f32(vcgtq_f32(a.v, b.v), a.v, b.v)}; }

/// yes where m, else no.
[[nodiscard]] inline F32 select(Mask m, F32 yes, F32 no) noexcept { return {vbslq_f32(m.v, yes.v, no.v)}; }
/// -a where m, else a.
[[nodiscard]] inline F32 negate(Mask m, F32 a) noexcept {
  return {vreinterpretq_f32_u32(veorq_u32(vreinterpretq_u32_f32(a.v), vshlq_n_u32(m.v, 31)))};
}
/// a where m, else zero.
[[nodiscard]] inline F32 keep(Mask m, F32 a) noexcept {
  return {vreinterpretq_f32_u32(vandq_u32(m.v, vreinterpretq_u32_f32(a.v)))};
}
[[nodiscard]] inline bool any(Mask m) noexcept { return vmaxvq_u32(m.v) != 0; }
[[nodiscard]] inline bool every(Mask m) noexcept { return vminvq_u32(m.v) != 0; }
/// a + 1 where m, else a.
[[nodiscard]] inline I32 increment(Mask m, I32 a) noexcept { return {vsubq_s32(a.v, vreinterpretq_s32_u32(m.v))}; }

/// The integers whose bits are those of a.
[[nodiscard]] inline I32 bits_of(F32 a) noexcept { return {vreinterpretq_s32_f32(a.v)}; }
/// The floats whose bits are those of a.
[[nodiscard]] inline F32 from_bits(I32 a) noexcept { return {vreinterpretq_f32_s32(a.v)}; }
[[nodiscard]] inline F32 to_float(I32 a) noexcept { return {vcvtq_f32_s32(a.v)}; }

/// Towards zero; |a| must stay below 2^31.
[[nodiscard]] inline I32 truncate_to_int(F32 a) noexcept { return {vcvtq_s32_f32(a.v)}; }

/// To the nearest integer, ties to even (the default rounding mode).
[[nodiscard]] inline I32 round_to_int(F32 a) noexcept { return {vcvtnq_s32_f32(a.v)}; }

/// Lanes of integers.
[[nodiscard]] inline I32 all_int(std::int32_t value) noexcept { return {vdupq_n_s32(value)}; }
[[nodiscard]] inline I32 operator-(I32 a, I32 b) noexcept { return {vsubq_s32(a.v, b.v)}; }
[[nodiscard]] inline I32 operator&(I32 a, I32 b) noexcept { return {vandq_s32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator==(I32 a, I32 b) noexcept { return {vceqq_s32(a.v, b.v)}; }
[[nodiscard]] inline Mask operator>(I32 a, I32 b) noexcept { return {vcgtq_s32(a.v, b.v)}; }
[[nodiscard]] inline I32 shift_left(I32 a, int count) noexcept { return {vshlq_s32(a.v, vdupq_n_s32(count))}; }
/// Towards minus infinity.
[[nodiscard]] inline I32 shift_right(I32 a, int count) noexcept { return {vshlq_s32(a.v, vdupq_n_s32(-count))}; }
/// For numbers from -1 to 2^15 - 1.
[[nodiscard]] inline I32 small_min(I32 a, I32 b) noexcept { return {vminq_s32(a.v, b.v)}; }
[[nodiscard]] inline I32 small_max(I32 a, I32 b) noexcept { return {vmaxq_s32(a.v, b.v)}; }
/// For a from -2^15, b from 0, to 2^15 - 1.
[[nodiscard]] inline I32 small_product(I32 a, I32 b) noexcept { return {vmulq_s32(a.v, b.v)}; }
/// For numbers from 0 to 2^31 - 1, as is the product.
[[nodiscard]] inline I32 product(I32 a, I32 b) noexcept { return {vmulq_s32(a.v, b.v)}; }
[[nodiscard]] inline Mask is_negative(I32 a) noexcept { return {vcltzq_s32(a.v)}; }
/// -1 where m, else 1.
[[nodiscard]] inline I32 minus_one_or_one(Mask m) noexcept {
  return {vorrq_s32(vreinterpretq_s32_u32(m.v), vdupq_n_s32(1))};
}
/// ~a where m, else a.
[[nodiscard]] inline I32 invert(Mask m, I32 a) noexcept { return {veorq_s32(vreinterpretq_s32_u32(m.v), a.v)}; }
/// a where m, else zero.
[[nodiscard]] inline I32 keep(Mask m, I32 a) noexcept { return {vandq_s32(vreinterpretq_s32_u32(m.v), a.v)}; }
/// Zero where m, else a.
[[nodiscard]] inline I32 drop(Mask m, I32 a) noexcept { return {vbicq_s32(a.v, vreinterpretq_s32_u32(m.v))}; }
/// -a where `sign` has its sign bit set, else a.
[[nodiscard]] inline F32 flip_sign(F32 a, F32 sign) noexcept {
  const uint32x4_t bit = vandq_u32(vreinterpretq_u32_f32(sign.v), vdupq_n_u32(0x80000000u));
  return {vreinterpretq_f32_u32(veorq_u32(vreinterpretq_u32_f32(a.v), bit))};
}

/// Two registers of integers from -2^15 to 2^15 - 1, or of masks (-1 where set), as one of 16 bits each. store() has
/// them in order, those of a first.
[[nodiscard]] inline I16 narrow(I32 a, I32 b) noexcept {
  return {vuzp1q_s16(vreinterpretq_s16_s32(a.v), vreinterpretq_s16_s32(b.v))};
}
[[nodiscard]] inline I16 narrow(Mask a, Mask b) noexcept {
  return narrow(I32{vreinterpretq_s32_u32(a.v)}, I32{vreinterpretq_s32_u32(b.v)});
}
[[nodiscard]] inline I16 operator*(I16 a, I16 b) noexcept { return {a.v * b.v}; }
inline void store(std::int16_t* p, I16 a) noexcept { vst1q_s16(p, a.v); }

/// What each lane has in a, b, c and d.
[[gnu::always_inline]] inline void transpose(I32 a, I32 b, I32 c, I32 d, Quad (&quads)[lanes]) noexcept {
  const int32x4x2_t ac = vzipq_s32(a.v, c.v);
  const int32x4x2_t bd = vzipq_s32(b.v, d.v);
  for (std::size_t k = 0; k < 2; ++k) {
    const int32x4x2_t both = vzipq_s32(ac.val[k], bd.val[k]);
    quads[2 * k] = reinterpret_cast<Quad>(both.val[0]);
    quads[2 * k + 1] = reinterpret_cast<Quad>(both.val[1]);
  }
}

/// The three floats at base + 3 * index[k], for all lanes.
[[gnu::always_inline]] inline void load_triples(const float* base, const std::uint32_t* index, F32& a, F32& b,
                                                F32& c) noexcept {
  float32x4x3_t abc{};
  abc = vld3q_lane_f32(base + 3 * static_cast<std::size_t>(index[0]), abc, 0);
  abc = vld3q_lane_f32(base + 3 * static_cast<std::size_t>(index[1]), abc, 1);
  abc = vld3q_lane_f32(base + 3 * static_cast<std::size_t>(index[2]), abc, 2);
  abc = vld3q_lane_f32(base + 3 * static_cast<std::size_t>(index[3]), abc, 3);
  a = {abc.val[0]};
  b = {abc.val[1]};
  c = {abc.val[2]};
}

inline constexpr std::uint32_t lane_numbers[4] = {0, 1, 2, 3};

/// Lanes 0 to count - 1; count is 1 or more.
[[nodiscard]] inline Mask first(std::size_t count) noexcept {
  return {vcltq_u32(vld1q_u32(lane_numbers), vdupq_n_u32(static_cast<std::uint32_t>(count)))};
}

/// For each set of lanes the bytes of its lanes, in ascending order.
struct LaneBytes {
  std::uint8_t of[16][16];
  constexpr LaneBytes() noexcept : of{} {
    for (std::uint32_t set = 0; set < 16; ++set) {
      std::uint32_t place = 0;
      for (std::uint32_t byte = 0; byte < 16; ++byte) {
        if ((set >> byte / 4 & 1u) != 0) of[set][place++] = static_cast<std::uint8_t>(byte);
      }
    }
  }
};
inline constexpr LaneBytes lane_bytes{};
inline constexpr std::uint32_t lane_bits[4] = {1, 2, 4, 8};

/// How store() packs the lanes where a mask is set.
struct Packing {
  uint8x16_t bytes;
  std::uint32_t count;
};

[[nodiscard]] inline Packing packing(Mask m) noexcept {
  const std::uint32_t set = vaddvq_u32(vandq_u32(m.v, vld1q_u32(lane_bits)));
  return {vld1q_u8(lane_bytes.of[set]), vaddvq_u32(vshrq_n_u32(m.v, 31))};
}

/// The lanes where the mask is set, one behind the other; what is written behind them, up to a register's length, means
/// nothing.
inline void store(float* p, F32 a, const Packing& packing) noexcept {
  vst1q_f32(p, vreinterpretq_f32_u8(vqtbl1q_u8(vreinterpretq_u8_f32(a.v), packing.bytes)));
}
inline void store(std::uint32_t* p, I32 a, const Packing& packing) noexcept {
  vst1q_u32(p, vreinterpretq_u32_u8(vqtbl1q_u8(vreinterpretq_u8_s32(a.v), packing.bytes)));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_NEON_HPP
