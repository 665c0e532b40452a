// shortshot/base/simd_scalar.hpp: the lane shim one lane at a time: microcontrollers, and whatever has no other.
// Included by simd.hpp, which says what it must do.
#ifndef SHORTSHOT_BASE_SIMD_SCALAR_HPP
#define SHORTSHOT_BASE_SIMD_SCALAR_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../config.hpp"
#include "quad.hpp"
#include "unfused.hpp"

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// Elements of a register of 32 bits each.
inline constexpr std::size_t lanes = 1;

/// Does one instruction bring an integer to 0..2^k - 1?
#if defined(__ARM_FEATURE_SAT)
inline constexpr bool saturates = true;
#else
inline constexpr bool saturates = false;
#endif

/// Does one instruction add to memory, at any constant distance from where a register points?
inline constexpr bool adds_to_memory = true;

/// A register of floats, of integers (signed or not), of conditions, and of integers of 16 bits, twice as many.
struct F32 {
  float v;  ///< the lanes, in a form that is the shim's own business
};
struct I32 {
  std::int32_t v;
};
struct Mask {
  bool v;
};
/// A mask of signs, -1 where set: what it masks is arithmetic, without branches. (Where there are lanes, all masks
/// are.)
struct SignMask {
  std::int32_t v;
  /// The same as a mask of another kind.
  operator Mask() const noexcept { return {v != 0}; }  // NOLINT: it is one
};
struct I16 {
  std::int16_t v __attribute__((vector_size(4)));  ///< the lanes
};

/// Square root of one number, exactly rounded. Not std::sqrt, which also calls libm for its errno; where there is no
/// instruction for it, this does too (libm's sqrtf is exactly rounded everywhere).
[[nodiscard]] inline float sqrt(float value) noexcept {
#if defined(__ARM_FP)
  float result;
  __asm__("vsqrt.f32 %0, %1" : "=t"(result) : "t"(value));
  return result;
#elif defined(__riscv_flen)
  float result;
  __asm__("fsqrt.s %0, %1" : "=f"(result) : "f"(value));
  return result;
#else
  return __builtin_sqrtf(value);
#endif
}

/// A register of what lies from `p` on, and the other way; no alignment is assumed.
[[nodiscard]] inline F32 load(const float* p) noexcept { return {*p}; }
[[nodiscard]] inline I32 load(const std::uint32_t* p) noexcept { return {static_cast<std::int32_t>(*p)}; }
inline void store(float* p, F32 a) noexcept { *p = a.v; }
inline void store(std::int32_t* p, I32 a) noexcept { *p = a.v; }
inline void store(std::uint32_t* p, I32 a) noexcept { *p = static_cast<std::uint32_t>(a.v); }
/// `value` in all lanes.
[[nodiscard]] inline F32 all(float value) noexcept { return {value}; }
/// value_at(k) in lane k.
template <class Function>
[[nodiscard, gnu::always_inline]] inline F32 from_lanes(Function value_at) noexcept {
  return {value_at(0)};
}

/// Lane by lane, each operation rounded as IEEE 754 says; a comparison with NaN is false, but for != (true).
[[nodiscard]] inline F32 operator+(F32 a, F32 b) noexcept { return {a.v + b.v}; }
[[nodiscard]] inline F32 operator-(F32 a, F32 b) noexcept { return {a.v - b.v}; }
[[nodiscard]] inline F32 operator*(F32 a, F32 b) noexcept { return {unfused(a.v * b.v)}; }
[[nodiscard]] inline F32 operator/(F32 a, F32 b) noexcept { return {unfused(a.v / b.v)}; }
[[nodiscard]] inline I32 operator+(I32 a, I32 b) noexcept { return {a.v + b.v}; }
[[nodiscard]] inline Mask operator<(F32 a, F32 b) noexcept { return {a.v < b.v}; }
[[nodiscard]] inline Mask operator>(F32 a, F32 b) noexcept { return {a.v > b.v}; }
[[nodiscard]] inline Mask operator>=(F32 a, F32 b) noexcept { return {a.v >= b.v}; }
[[nodiscard]] inline Mask operator!=(F32 a, F32 b) noexcept { return {a.v != b.v}; }
[[nodiscard]] inline Mask operator&(Mask a, Mask b) noexcept { return {a.v && b.v}; }
[[nodiscard]] inline Mask operator|(Mask a, Mask b) noexcept { return {a.v || b.v}; }

/// Lane by lane. min() and max() give b where one of the two is NaN.
[[nodiscard]] inline F32 sqrt(F32 a) noexcept { return {sqrt(a.v)}; }
[[nodiscard]] inline F32 abs(F32 a) noexcept { return {__builtin_fabsf(a.v)}; }
[[nodiscard]] inline F32 min(F32 a, F32 b) noexcept { return {a.v < b.v ? a.v : b.v}; }
[[nodiscard]] inline F32 max(F32 a, F32 b) noexcept { return {a.v > b.v ? a.v : b.v}; }

/// yes where m, else no.
[[nodiscard]] inline F32 select(Mask m, F32 yes, F32 no) noexcept { return {m.v ? yes.v : no.v}; }
/// -a where m, else a.
[[nodiscard]] inline F32 negate(Mask m, F32 a) noexcept { return {m.v ? -a.v : a.v}; }
/// a where m, else zero.
[[nodiscard]] inline F32 keep(Mask m, F32 a) noexcept { return {m.v ? a.v : 0.0f}; }
/// Is it set in any lane, in every lane?
[[nodiscard]] inline bool any(Mask m) noexcept { return m.v; }
[[nodiscard]] inline bool every(Mask m) noexcept { return m.v; }
/// a + 1 where m, else a.
[[nodiscard]] inline I32 increment(Mask m, I32 a) noexcept { return {a.v + (m.v ? 1 : 0)}; }

/// The integers whose bits are those of a.
[[nodiscard]] inline I32 bits_of(F32 a) noexcept {
  I32 bits{};
  std::memcpy(&bits.v, &a.v, sizeof bits.v);
  return bits;
}
/// The floats whose bits are those of a.
[[nodiscard]] inline F32 from_bits(I32 a) noexcept {
  F32 value{};
  std::memcpy(&value.v, &a.v, sizeof value.v);
  return value;
}
/// Rounded to nearest, ties to even.
[[nodiscard]] inline F32 to_float(I32 a) noexcept { return {static_cast<float>(a.v)}; }

/// Towards zero; |a| must stay below 2^31.
[[nodiscard]] inline I32 truncate_to_int(F32 a) noexcept { return {static_cast<std::int32_t>(a.v)}; }

/// To the nearest integer, ties to even; |a| <= 2^22. Where no instruction does that, adding 1.5 * 2^23 leaves the
/// integer in the low mantissa bits: the same bits on every machine, with no call into libm.
[[nodiscard]] inline I32 round_to_int(F32 a) noexcept {
#if defined(__ARM_FP)
  float integer;  // its bits
  __asm__("vcvtr.s32.f32 %0, %1" : "=t"(integer) : "t"(a.v));
  return bits_of({integer});
#elif defined(__riscv_flen)
  I32 integer;
  __asm__("fcvt.w.s %0, %1, rne" : "=r"(integer.v) : "f"(a.v));
  return integer;
#else
  return {bits_of({a.v + whole_numbers}).v - 0x4B400000};
#endif
}

/// Lanes of integers.
[[nodiscard]] inline I32 all_int(std::int32_t value) noexcept { return {value}; }
/// Lane by lane, modulo 2^32; shifts and comparisons are those of signed numbers.
[[nodiscard]] inline I32 operator-(I32 a, I32 b) noexcept { return {a.v - b.v}; }
[[nodiscard]] inline I32 operator&(I32 a, I32 b) noexcept { return {a.v & b.v}; }
[[nodiscard]] inline Mask operator==(I32 a, I32 b) noexcept { return {a.v == b.v}; }
[[nodiscard]] inline Mask operator>(I32 a, I32 b) noexcept { return {a.v > b.v}; }
[[nodiscard]] inline I32 shift_left(I32 a, int count) noexcept { return {a.v * (std::int32_t{1} << count)}; }
/// Towards minus infinity (as every compiler we know shifts, and C++20 demands).
[[nodiscard]] inline I32 shift_right(I32 a, int count) noexcept { return {a.v >> count}; }
/// For numbers from -1 to 2^15 - 1.
[[nodiscard]] inline I32 small_min(I32 a, I32 b) noexcept { return {a.v < b.v ? a.v : b.v}; }
[[nodiscard]] inline I32 small_max(I32 a, I32 b) noexcept { return {a.v > b.v ? a.v : b.v}; }
/// For a from -2^15, b from 0, to 2^15 - 1.
[[nodiscard]] inline I32 small_product(I32 a, I32 b) noexcept { return {a.v * b.v}; }
/// For numbers from 0 to 2^31 - 1, as is the product.
[[nodiscard]] inline I32 product(I32 a, I32 b) noexcept { return {a.v * b.v}; }
/// Is the sign bit set?
[[nodiscard]] inline SignMask is_negative(I32 a) noexcept { return {a.v >> 31}; }
/// -1 where m, else 1.
[[nodiscard]] inline I32 minus_one_or_one(SignMask m) noexcept { return {m.v | 1}; }
/// ~a where m, else a.
[[nodiscard]] inline I32 invert(SignMask m, I32 a) noexcept { return {m.v ^ a.v}; }
/// a where m, else zero.
[[nodiscard]] inline I32 keep(Mask m, I32 a) noexcept { return {m.v ? a.v : 0}; }
[[nodiscard]] inline I32 keep(SignMask m, I32 a) noexcept { return {m.v & a.v}; }
/// Zero where m, else a.
[[nodiscard]] inline I32 drop(Mask m, I32 a) noexcept { return {m.v ? 0 : a.v}; }
[[nodiscard]] inline I32 drop(SignMask m, I32 a) noexcept { return {~m.v & a.v}; }
/// -a where `sign` has its sign bit set, else a.
[[nodiscard]] inline F32 flip_sign(F32 a, F32 sign) noexcept { return {bits_of(sign).v < 0 ? -a.v : a.v}; }

/// Two registers of integers from -2^15 to 2^15 - 1, or of masks (-1 where set), as one of 16 bits each. store() has
/// them in order, those of a first.
[[nodiscard]] inline I16 narrow(I32 a, I32 b) noexcept {
  I16 both{};
  both.v[0] = static_cast<std::int16_t>(a.v);
  both.v[1] = static_cast<std::int16_t>(b.v);
  return both;
}
[[nodiscard]] inline I16 narrow(Mask a, Mask b) noexcept { return narrow(I32{a.v ? -1 : 0}, I32{b.v ? -1 : 0}); }
/// Lane by lane, modulo 2^16.
[[nodiscard]] inline I16 operator*(I16 a, I16 b) noexcept { return {a.v * b.v}; }
/// To memory without any alignment, in order.
inline void store(std::int16_t* p, I16 a) noexcept { std::memcpy(p, &a, sizeof a); }

/// What the lane has in a, b, c and d.
[[gnu::always_inline]] inline void transpose(I32 a, I32 b, I32 c, I32 d, Quad (&quads)[lanes]) noexcept {
  quads[0] = Quad{a.v, b.v, c.v, d.v};
}

/// The three floats at base + 3 * index[k], for all lanes.
[[gnu::always_inline]] inline void load_triples(const float* base, const std::uint32_t* index, F32& a, F32& b,
                                                F32& c) noexcept {
  const float* const p = base + 3 * static_cast<std::size_t>(*index);
  a = {p[0]};
  b = {p[1]};
  c = {p[2]};
}

/// Lanes 0 to count - 1; count is 1 or more.
[[nodiscard]] inline Mask first(std::size_t) noexcept { return {true}; }

/// How store() packs the lanes where a mask is set.
struct Packing {
  std::uint32_t count;  ///< lanes that are set
};

/// How store() packs the lanes where `m` is set.
[[nodiscard]] inline Packing packing(Mask m) noexcept { return {m.v ? 1u : 0u}; }

/// The lanes where the mask is set, one behind the other; what is written behind them, up to a register's length, means
/// nothing.
inline void store(float* p, F32 a, const Packing&) noexcept { *p = a.v; }
inline void store(std::uint32_t* p, I32 a, const Packing&) noexcept { store(p, a); }

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_SCALAR_HPP
