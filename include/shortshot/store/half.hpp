// shortshot/store/half.hpp: a descriptor in 16-bit floats, half of its floats.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../base/math.hpp"
#include "../base/unfused.hpp"
#include "../config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A descriptor D of D::size values as IEEE 754's binary16 (11 bits of precision: a value of a descriptor comes back
/// within 1/4096 of itself, or 3e-8). A trivial type of alignment 2. Distances are those of the floats that they stand
/// for.
template <class D>
struct HalfDescriptor {
  static_assert(D::size >= 1 && D::size <= 66051, "HalfDescriptor<D> supports 1 to 66051 values");
  static constexpr int size = D::size;                                              ///< number of values
  static constexpr std::size_t size_bytes = 2 * static_cast<std::size_t>(D::size);  ///< of all values
  std::uint16_t values[D::size];                                                    ///< as binary16, one per value
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The nearest half, ties to even, as IEEE 754 rounds; from 65520 on infinity. NaN stays NaN (a quiet one). In
/// integers: neither compilers nor CPUs have a say.
[[nodiscard]] inline std::uint16_t half_of(float value) noexcept {
  const std::uint32_t bits = math::bits_of(value);
  const std::uint32_t sign = bits >> 16 & 0x8000u;
  const std::uint32_t high = bits & 0x7FFFFFFFu;
  if (high >= 0x7F800000u) return static_cast<std::uint16_t>(sign | (high > 0x7F800000u ? 0x7E00u : 0x7C00u));
  if (high >= 0x477FF000u) return static_cast<std::uint16_t>(sign | 0x7C00u);
  std::uint32_t whole = high - 0x38000000u;  // the exponent's bias is 112 less
  std::uint32_t shift = 13;
  if (high < 0x38800000u) {  // below 2^-14: multiples of 2^-24
    shift = 126 - (high >> 23);
    if (shift > 25) return static_cast<std::uint16_t>(sign);
    whole = (high & 0x7FFFFFu) | 0x800000u;
  }
  const std::uint32_t half_unit = (1u << (shift - 1)) - 1u + (whole >> shift & 1u);
  return static_cast<std::uint16_t>(sign | (whole + half_unit) >> shift);
}

/// The float that a half stands for, exactly.
[[nodiscard]] inline float float_of_half(std::uint16_t half) noexcept {
  const std::uint32_t sign = std::uint32_t{half & 0x8000u} << 16;
  std::uint32_t high = half & 0x7FFFu;
  if (high >= 0x7C00u) return math::float_of(sign | 0x7F800000u | (high & 0x3FFu) << 13);
  if (high >= 0x400u) return math::float_of(sign | ((high << 13) + 0x38000000u));
  if (high == 0) return math::float_of(sign);
  std::uint32_t exponent = 113;  // of 2^-14
  for (; (high & 0x400u) == 0; high <<= 1) --exponent;
  return math::float_of(sign | exponent << 23 | (high & 0x3FFu) << 13);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The D::size values of a descriptor as halves, each the nearest one (ties to even). No allocation, no error,
/// reentrant; the same bits on every machine, whatever it does with subnormal floats.
template <class D>
void quantize(const float* values, HalfDescriptor<D>& out) noexcept {
  for (int i = 0; i < D::size; ++i) out.values[i] = detail::half_of(values[i]);
}

/// The floats that halves stand for.
template <class D>
void dequantize(const HalfDescriptor<D>& halves, float* values) noexcept {
  for (int i = 0; i < D::size; ++i) values[i] = detail::float_of_half(halves.values[i]);
}

/// The squared L2 distance of the floats that halves stand for, summed up as squared_l2_distance() does: what matching
/// compares.
template <class D>
[[nodiscard]] float squared_distance(const HalfDescriptor<D>& a, const HalfDescriptor<D>& b) noexcept {
  float sums[8] = {};
  for (int i = 0; i < D::size; ++i) {
    const float difference = detail::float_of_half(a.values[i]) - detail::float_of_half(b.values[i]);
    sums[i % 8] += extend::unfused(difference * difference);
  }
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
