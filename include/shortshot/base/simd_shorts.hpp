// shortshot/base/simd_shorts.hpp: arithmetic on I16, two registers of small integers in one: half the instructions. The
// names are those of I32's, so that what is written for integers goes with both. A mask is an I16, too.
#ifndef SHORTSHOT_BASE_SIMD_SHORTS_HPP
#define SHORTSHOT_BASE_SIMD_SHORTS_HPP

#include <cstdint>

#include "../config.hpp"
#include "simd.hpp"

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// `value` in all lanes, and as many of them as the first argument has.
[[nodiscard]] inline I32 like(I32, std::int32_t value) noexcept { return all_int(value); }
[[nodiscard]] inline I16 like(I16, std::int32_t value) noexcept {
  I16 all{};
  all.v += static_cast<std::int16_t>(value);
  return all;
}

/// As those of I32, on 16 bits: sums are modulo 2^16, and a mask is -1 where it is set, else 0.
[[nodiscard]] inline I16 operator+(I16 a, I16 b) noexcept { return {a.v + b.v}; }
[[nodiscard]] inline I16 operator-(I16 a, I16 b) noexcept { return {a.v - b.v}; }
[[nodiscard]] inline I16 operator&(I16 a, I16 b) noexcept { return {a.v & b.v}; }
[[nodiscard]] inline I16 operator|(I16 a, I16 b) noexcept { return {a.v | b.v}; }
[[nodiscard]] inline I16 operator==(I16 a, I16 b) noexcept { return {a.v == b.v}; }
[[nodiscard]] inline I16 operator>(I16 a, I16 b) noexcept { return {a.v > b.v}; }
[[nodiscard]] inline I16 is_negative(I16 a) noexcept { return {a.v < 0}; }
[[nodiscard]] inline I16 small_min(I16 a, I16 b) noexcept { return {a.v < b.v ? a.v : b.v}; }
[[nodiscard]] inline I16 small_max(I16 a, I16 b) noexcept { return {a.v > b.v ? a.v : b.v}; }
[[nodiscard]] inline I16 keep(I16 m, I16 a) noexcept { return {m.v & a.v}; }
[[nodiscard]] inline I16 drop(I16 m, I16 a) noexcept { return {~m.v & a.v}; }
[[nodiscard]] inline I16 minus_one_or_one(I16 m) noexcept { return m | like(m, 1); }

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd

#endif  // SHORTSHOT_BASE_SIMD_SHORTS_HPP
