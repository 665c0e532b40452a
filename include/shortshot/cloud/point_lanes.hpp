// shortshot/cloud/point_lanes.hpp: the points of one register.
#ifndef SHORTSHOT_CLOUD_POINT_LANES_HPP
#define SHORTSHOT_CLOUD_POINT_LANES_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../config.hpp"
#include "cloud.hpp"
#include "read.hpp"

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// The points of one register.
struct PointLanes {
  simd::F32 x, y, z;  ///< of each lane's point
};

/// Their component along an axis, rounded as PCL and the published code round it: x + z first, then y.
/// In place for small code as well: a call of it is longer than what it does.
[[nodiscard, gnu::always_inline]] inline simd::F32 along(const simd::F32 (&axis)[3], const PointLanes& v) noexcept {
  return (v.x * axis[0] + v.z * axis[2]) + v.y * axis[1];
}
[[nodiscard]] SHORTSHOT_INLINE simd::F32 along(const float (&axis)[3], const PointLanes& v) noexcept {
  return (v.x * simd::all(axis[0]) + v.z * simd::all(axis[2])) + v.y * simd::all(axis[1]);
}

/// Element index_at(k) in lane k.
template <class Function>
[[nodiscard, gnu::always_inline]] inline PointLanes read_lanes(const Float3Channel& channel,
                                                               Function index_at) noexcept {
  const auto read_component = [&](const unsigned char* first) SHORTSHOT_INLINE_LAMBDA {
    return simd::from_lanes([&](std::size_t lane) SHORTSHOT_INLINE_LAMBDA {
      float value = 0.0f;
      std::memcpy(&value, first + index_at(lane) * channel.stride_bytes, sizeof value);
      return value;
    });
  };
  return {read_component(channel.x), read_component(channel.y), read_component(channel.z)};
}

/// Which points have three finite coordinates.
[[nodiscard]] inline simd::Mask is_finite(const PointLanes& p) noexcept {
  const simd::I32 exponent = simd::all_int(0x7F800000);
  const auto below = [&](simd::F32 v) { return (bits_of(v) & exponent) - exponent; };  // negative if v is finite
  return is_negative(below(p.x) & below(p.y) & below(p.z));
}

/// Some points, and which of them have three finite coordinates; the others are zeros.
struct ValidLanes {
  PointLanes points;  ///< zeros where not valid
  simd::Mask valid;   ///< which they are
};

/// `count` points from index `first` on, at most a register, at least one. Beyond them nothing is read or valid.
[[nodiscard, gnu::always_inline]] inline ValidLanes read_valid(const Float3Channel& channel, std::size_t first,
                                                               std::size_t count) noexcept {
  const bool whole = count >= simd::lanes;
  PointLanes p = whole
                     ? read_lanes(channel, [=](std::size_t lane) { return first + lane; })
                     : read_lanes(channel, [=](std::size_t lane) { return first + (lane < count ? lane : count - 1); });
  const simd::Mask valid = whole ? is_finite(p) : is_finite(p) & simd::first(count);
  if (!every(valid)) p = {keep(valid, p.x), keep(valid, p.y), keep(valid, p.z)};
  return {p, valid};
}

/// Calls f(index, points, valid) for registers of points in order: the first one's index, and which lanes have three
/// finite coordinates. At least one has; registers without are passed over. The other lanes are zeros. The view comes
/// by value: no store that f makes can change it.
template <class Function>
[[gnu::always_inline]] inline void for_each_valid_register(const CloudView cloud, Function f) {
  for (std::size_t i = 0; i < cloud.size; i += simd::lanes) {
    const ValidLanes read = read_valid(cloud.points, i, cloud.size - i);
    if (any(read.valid)) f(i, read.points, read.valid);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_CLOUD_POINT_LANES_HPP
