// shortshot/store/coded.hpp: a descriptor in 8, 4 or 3 bits a value, and the distance between such.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../base/unfused.hpp"
#include "../config.hpp"
#include "../descriptor/descriptor.hpp"
#include "code_distance.hpp"
#include "code_scale.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A descriptor D of D::size values, each as a whole multiple of `step`, in `Bits` bits (8, 4 or 3): from 0 to
/// 2^Bits - 1 (255, 15, 7), or in parts whose values have signs from -m to m with m = 2^(Bits - 1) - 1 (127, 7, 3),
/// which are stored as 1 to 2 m + 1. What lies beyond is cut off. A trivial type of alignment 1.
///
/// Layout: the bits of value i are those from Bits * i on, the lowest ones of a byte first; what is left over at the
/// end is 0. So is value 2 i of 4 bits the low half of byte i.
///
/// Steps are 1 / `Scale`; code_scale<D, Bits> cuts off few values.
template <class D, int Bits, int Scale = code_scale<D, Bits>>
struct CodedDescriptor {
  static_assert(Bits == 8 || Bits == 4 || Bits == 3, "CodedDescriptor<D, Bits> supports 8, 4 or 3 bits a value");
  static_assert(Scale >= 1 && Scale <= 65536, "CodedDescriptor<D, Bits, Scale> supports scales from 1 to 65536");
  static_assert(D::size >= 1 && D::size <= 66051, "CodedDescriptor<D, Bits> supports 1 to 66051 values");
  static_assert(std::uint64_t{66051} * 255 * 255 <= 0xFFFFFFFFu, "squared_distance() cannot overflow");
  static constexpr int size = D::size;                                                           ///< number of values
  static constexpr int bits = Bits;                                                              ///< of each value
  static constexpr std::size_t size_bytes = (static_cast<std::size_t>(D::size) * Bits + 7) / 8;  ///< of all values
  /// The L2 distance of two descriptors is step * sqrt(squared_distance(a, b)).
  static constexpr float step = 1.0f / static_cast<float>(Scale);
  std::uint8_t bytes[size_bytes];  ///< the codes
};

/// One byte a value, a quarter of its floats: 336 bytes for SCSH-336, with steps of 1/512 from 0 to 255/512.
///
/// A value below that comes back within half a step, 1/1024 (and 6e-11 for rounding), and so the distance of two
/// descriptors, at the worst, within sqrt(D::size) / 512. What it costs in practice: of 12,630 key points of generated
/// tabletop scenes, seen twice with other pixels and noise, 92 % (SSH-32) to 97 % (SCSH-696) have the same nearest
/// neighbor in the other view as with floats; the others have one at most 1.11 times as far away, and as many of all
/// are right. Distances to it, 0.07 to 0.18 long, are wrong by 0.001 (root mean square). Steps of 1/255, which reach 1,
/// make that 0.0016 to 0.002; finer ones cut off too much: in SSH-32 every fifth value is above 1/4.
///
/// SHOT-352 and CSHOT-1344 have peaks above 1/2 (one value in 4,000 and in 200,000). Nearest neighbors are kept as
/// well (95 % and 98 %), but the distance from a descriptor with such a peak can be too small by 0.4 and 0.2.
///
/// Compact descriptors have steps of 1/360, and no value is cut off.
template <class D, int Scale = code_scale<D, 8>>
using ByteDescriptor = CodedDescriptor<D, 8, Scale>;

/// Half a byte a value, an eighth of its floats: 95 bytes for ShapeColor95.
template <class D, int Scale = code_scale<D, 4>>
using NibbleDescriptor = CodedDescriptor<D, 4, Scale>;

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// May value i of D be below 0?
template <class D>
struct SignsOf {
  [[nodiscard, gnu::always_inline]] static constexpr bool at(int) noexcept { return false; }
};
template <class Voting, class... Parts>
struct SignsOf<Descriptor<Voting, Parts...>> {
  [[nodiscard, gnu::always_inline]] static constexpr bool at(int value) noexcept {
    int part = 0;
    bool has_sign = false;
    ((has_sign = has_sign || (Parts::has_signs && value >= Descriptor<Voting, Parts...>::offset(part) &&
                              value < Descriptor<Voting, Parts...>::offset(part) + Parts::size),
      ++part),
     ...);
    return has_sign;
  }
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// What is stored of a value: the nearest whole number of steps (of the product, a float), halves away from 0. NaN
/// becomes 0 steps. Compared before it is converted.
template <int Bits>
[[nodiscard]] inline unsigned code_of(float value, float scale, bool has_sign) noexcept {
  constexpr int zero = 1 << (Bits - 1);  // as it is stored where there are signs
  const float half_steps = unfused(value * (2.0f * scale));
  const float high = half_steps < 0.0f ? -half_steps : half_steps;
  const int most = has_sign ? zero - 1 : 2 * zero - 1;
  const auto limit = static_cast<float>(2 * most);
  const int steps = high < limit ? (static_cast<std::int32_t>(high) + 1) / 2 : high >= limit ? most : 0;
  if (!has_sign) return half_steps > 0.0f ? static_cast<unsigned>(steps) : 0u;
  return static_cast<unsigned>(half_steps < 0.0f ? zero - steps : zero + steps);
}

/// The whole number of steps that value i is stored as.
template <class D, int Bits, int Scale>
[[nodiscard, gnu::always_inline]] inline int steps_at(const CodedDescriptor<D, Bits, Scale>& coded, int i) noexcept {
  const auto stored = static_cast<int>(number_at<Bits>(coded.bytes, static_cast<std::size_t>(i)));
  return SignsOf<D>::at(i) ? stored - (1 << (Bits - 1)) : stored;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The D::size values of a descriptor as codes. NaN becomes 0. No allocation, no error, reentrant; the same bytes on
/// every machine.
///
/// In place, too: `out` may lie where `values` begin. A byte is written when its values have been read, and lies before
/// those that have not. A union of both needs no second buffer:
///
///     union { float values[D::size]; ByteDescriptor<D> bytes; } d;
///     if (describe_at<D>(cloud, search, index, 0.04f, workspace, d.values) == Status::ok) quantize(d.values, d.bytes);
template <class D, int Bits, int Scale>
void quantize(const float* values, CodedDescriptor<D, Bits, Scale>& out) noexcept {
  detail::write_numbers<Bits>(out.bytes, D::size, [&](int i) {
    return detail::code_of<Bits>(values[i], static_cast<float>(Scale), detail::SignsOf<D>::at(i));
  });
}

/// The values that codes stand for, D::size floats. No allocation, no error, reentrant; the same bits on every machine.
template <class D, int Bits, int Scale>
void dequantize(const CodedDescriptor<D, Bits, Scale>& coded, float* values) noexcept {
  for (int i = 0; i < D::size; ++i) {
    values[i] = static_cast<float>(detail::steps_at(coded, i)) * CodedDescriptor<D, Bits, Scale>::step;
  }
}

/// The squared L2 distance in steps, exact: an integer from 0 to D::size * (2^Bits - 1)^2, for which 32 bits are
/// enough. The order of distances needs no root.
template <class D, int Bits, int Scale>
[[nodiscard]] std::uint32_t squared_distance(const CodedDescriptor<D, Bits, Scale>& a,
                                             const CodedDescriptor<D, Bits, Scale>& b) noexcept {
  return detail::squared_code_distance<Bits>(a.bytes, b.bytes, sizeof a.bytes);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
