// shortshot/store/quantize.hpp: a descriptor in one byte a value, a quarter of its floats, and the distance between
// such bytes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../base/unfused.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A descriptor D of D::size values, each as its multiple of `step`: 0 to 255, so that values from 255/512 on are all
/// the same. A trivial type of alignment 1: 336 bytes for SCSH-336.
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
template <class D>
struct ByteDescriptor {
  static_assert(D::size >= 1 && D::size <= 66051, "ByteDescriptor<D> supports 1 to 66051 values");
  static_assert(std::uint64_t{D::size} * 255 * 255 <= 0xFFFFFFFFu, "squared_distance() cannot overflow");
  static constexpr int size = D::size;
  static constexpr std::size_t size_bytes = D::size;
  /// The L2 distance of two descriptors is step * sqrt(squared_distance(a, b)). A power of two: products are exact.
  static constexpr float step = 1.0f / 512.0f;
  std::uint8_t values[size_bytes];
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The number of whole steps that is nearest, halves upwards. Compared before it is converted, and so that NaN becomes
/// 0.
[[nodiscard]] inline std::uint8_t byte_of(float value) noexcept {
  const float half_steps = unfused(value * 1024.0f);
  if (!(half_steps > 0.0f)) return 0;
  const std::int32_t whole_steps = half_steps < 510.0f ? static_cast<std::int32_t>(half_steps + 1.0f) / 2 : 255;
  return static_cast<std::uint8_t>(whole_steps);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The D::size values of a descriptor as bytes. NaN and what is negative become 0, all from 255/512 on, infinity too,
/// 255. No allocation, no error, reentrant; the same bytes on every machine.
///
/// In place, too: `out` may lie where `values` begin. Byte i is written when value i has been read, and lies before the
/// values that have not. A union of both needs no second buffer:
///
///     union { float values[D::size]; ByteDescriptor<D> bytes; } d;
///     if (describe_at<D>(cloud, search, index, 0.04f, workspace, d.values) == Status::ok) quantize(d.values, d.bytes);
template <class D>
void quantize(const float* values, ByteDescriptor<D>& out) noexcept {
  std::uint8_t* const bytes = out.values;  // of a type that may alias the floats
  for (std::size_t i = 0; i < sizeof out.values; ++i) bytes[i] = detail::byte_of(values[i]);
}

/// The squared L2 distance of the bytes, exact: an integer from 0 to D::size * 255^2, for which 32 bits are enough. The
/// order of distances needs no root.
template <class D>
[[nodiscard]] std::uint32_t squared_distance(const ByteDescriptor<D>& a, const ByteDescriptor<D>& b) noexcept {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < sizeof a.values; ++i) {
    const std::int32_t difference = std::int32_t{a.values[i]} - std::int32_t{b.values[i]};
    sum += static_cast<std::uint32_t>(difference * difference);
  }
  return sum;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
