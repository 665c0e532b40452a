// shortshot/store/nibbles.hpp: a descriptor in four bits a value, an eighth of its floats, and the distance between
// such.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "../base/unfused.hpp"
#include "../config.hpp"
#include "../descriptor/compact.hpp"
#include "../descriptor/descriptor.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Steps in 1 for D in nibbles: for the published descriptors, whose values are seldom above 15 / 32. Specialize it for
/// your own, as below.
template <class D>
inline constexpr int nibble_scale = 32;
template <>
inline constexpr int nibble_scale<ShapeColor95> = 50;
template <>
inline constexpr int nibble_scale<RoomColor95> = 50;
template <>
inline constexpr int nibble_scale<ShapeColor32> = 40;
template <>
inline constexpr int nibble_scale<HeightShape96> = 60;
template <>
inline constexpr int nibble_scale<ColorRings27> = 50;

/// A descriptor D of D::size values, each as a whole multiple of `step`: 0 to 15, or -7 to 7 in parts whose values have
/// signs (stored as 1 to 15); what lies beyond is cut off. A trivial type of alignment 1: 95 bytes for ShapeColor95.
///
/// Layout: value 2 i in the low half of byte i, value 2 i + 1 in the high one; what is left over at the end is 0.
///
/// Steps are 1 / `Scale`; nibble_scale<D> cuts off few values.
template <class D, int Scale = nibble_scale<D>>
struct NibbleDescriptor {
  static_assert(Scale >= 1 && Scale <= 65536, "NibbleDescriptor<D, Scale> supports scales from 1 to 65536");
  static_assert(D::size >= 1 && D::size <= 65536, "NibbleDescriptor<D> supports 1 to 65536 values");
  static constexpr int size = D::size;
  static constexpr std::size_t size_bytes = (static_cast<std::size_t>(D::size) + 1) / 2;
  /// The L2 distance of two descriptors is step * sqrt(squared_distance(a, b)).
  static constexpr float step = 1.0f / static_cast<float>(Scale);
  std::uint8_t bytes[size_bytes];
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What is stored of a value: the nearest whole number of steps, halves away from 0. NaN becomes 0 steps. Compared
/// before it is converted.
[[nodiscard]] inline unsigned nibble_of(float value, float scale, bool has_sign) noexcept {
  const float half_steps = unfused(value * (2.0f * scale));
  const float high = half_steps < 0.0f ? -half_steps : half_steps;
  const float most = has_sign ? 14.0f : 30.0f;
  const auto steps = high < most ? (static_cast<std::int32_t>(high) + 1) / 2 : high >= most ? (has_sign ? 7 : 15) : 0;
  if (!has_sign) return half_steps > 0.0f ? static_cast<unsigned>(steps) : 0u;
  return static_cast<unsigned>(half_steps < 0.0f ? 8 - steps : 8 + steps);
}

/// The sum of squared differences of the halves of `size` bytes, up to 2^22. In pieces of a fixed length, which
/// compilers turn into lanes at -O2, too.
[[nodiscard]] inline std::uint32_t squared_nibble_distance(const std::uint8_t* a, const std::uint8_t* b,
                                                           std::size_t size) noexcept {
  constexpr std::size_t width = 16;
  std::uint32_t sum = 0;
  const auto add = [&](const std::uint8_t* of_a, const std::uint8_t* of_b) {
    std::int32_t part = 0;
    for (std::size_t k = 0; k < width; ++k) {
      const auto low = static_cast<std::int16_t>((of_a[k] & 15) - (of_b[k] & 15));
      part += low * low;
    }
    for (std::size_t k = 0; k < width; ++k) {
      const auto high = static_cast<std::int16_t>((of_a[k] >> 4) - (of_b[k] >> 4));
      part += high * high;
    }
    sum += static_cast<std::uint32_t>(part);
  };
  std::size_t i = 0;
  for (; i + width <= size; i += width) add(a + i, b + i);
  if (i < size) {
    std::uint8_t rest_of_a[width] = {};
    std::uint8_t rest_of_b[width] = {};
    std::memcpy(rest_of_a, a + i, size - i);
    std::memcpy(rest_of_b, b + i, size - i);
    add(rest_of_a, rest_of_b);
  }
  return sum;
}

template <class Voting, class... Parts, std::size_t... I>
[[nodiscard]] constexpr bool has_sign_at(Descriptor<Voting, Parts...>, std::index_sequence<I...>, int value) noexcept {
  using D = Descriptor<Voting, Parts...>;
  return ((Parts::has_signs && value >= D::offset(I) && value < D::offset(I) + Parts::size) || ...);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The D::size values of a descriptor as nibbles. No allocation, no error, reentrant; the same bytes on every machine.
/// In place, too: `out` may lie where `values` begin, as for bytes.
template <class D, int Scale>
void quantize(const float* values, NibbleDescriptor<D, Scale>& out) noexcept {
  constexpr auto parts = std::make_index_sequence<static_cast<std::size_t>(D::parts)>{};
  constexpr auto scale = static_cast<float>(Scale);
  std::uint8_t* const bytes = out.bytes;  // of a type that may alias the floats
  for (int i = 0; i < D::size; i += 2) {
    unsigned byte = detail::nibble_of(values[i], scale, detail::has_sign_at(D{}, parts, i));
    if (i + 1 < D::size) byte |= detail::nibble_of(values[i + 1], scale, detail::has_sign_at(D{}, parts, i + 1)) << 4;
    bytes[i / 2] = static_cast<std::uint8_t>(byte);
  }
}

/// The values that nibbles stand for, D::size floats.
template <class D, int Scale>
void dequantize(const NibbleDescriptor<D, Scale>& nibbles, float* values) noexcept {
  constexpr auto parts = std::make_index_sequence<static_cast<std::size_t>(D::parts)>{};
  for (int i = 0; i < D::size; ++i) {
    const int stored = i % 2 == 0 ? nibbles.bytes[i / 2] & 15 : nibbles.bytes[i / 2] >> 4;
    const int steps = detail::has_sign_at(D{}, parts, i) ? stored - 8 : stored;
    values[i] = static_cast<float>(steps) * NibbleDescriptor<D, Scale>::step;
  }
}

/// The squared L2 distance in steps, exact: an integer from 0 to D::size * 225. The order of distances needs no root.
template <class D, int Scale>
[[nodiscard]] std::uint32_t squared_distance(const NibbleDescriptor<D, Scale>& a,
                                             const NibbleDescriptor<D, Scale>& b) noexcept {
  return detail::squared_nibble_distance(a.bytes, b.bytes, sizeof a.bytes);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
