// shortshot/cloud/read.hpp: what a view says of one point.
#ifndef SHORTSHOT_CLOUD_READ_HPP
#define SHORTSHOT_CLOUD_READ_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../base/math.hpp"
#include "../base/unfused.hpp"
#include "../config.hpp"
#include "cloud.hpp"

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// Element `index` of a channel. memcpy, because a PointCloud2 blob need not be aligned. (In place: where each call
/// deepens the stack.)
[[nodiscard, gnu::always_inline]] inline Point read_in_place(const Float3Channel& channel, std::size_t index) noexcept {
  const std::size_t offset = index * channel.stride_bytes;
  Point p{};
  std::memcpy(&p.x, channel.x + offset, sizeof(float));
  std::memcpy(&p.y, channel.y + offset, sizeof(float));
  std::memcpy(&p.z, channel.z + offset, sizeof(float));
  return p;
}

/// Element `index` of a channel of points, or of normals.
[[nodiscard]] inline Point read(const Float3Channel& channel, std::size_t index) noexcept {
  return read_in_place(channel, index);
}

/// Element `index` of a channel of numbers.
[[nodiscard]] inline float read(const ScalarChannel& channel, std::size_t index) noexcept {
  const unsigned char* const at = channel.value + index * channel.stride_bytes;
  if (channel.type == ScalarType::uint8) return static_cast<float>(*at);
  if (channel.type == ScalarType::uint16) {
    std::uint16_t value = 0;
    std::memcpy(&value, at, sizeof value);
    return static_cast<float>(value);
  }
  float value = 0.0f;
  std::memcpy(&value, at, sizeof value);
  return value;
}

[[nodiscard, gnu::always_inline]] inline Rgb read(const ColorChannel& channel, std::size_t index) noexcept {
  const std::size_t offset = index * channel.stride_bytes;
  return {channel.r[offset], channel.g[offset], channel.b[offset]};
}

/// Coordinate 0, 1 or 2 of a point.
[[nodiscard]] inline float coordinate(const Point& p, std::size_t axis) noexcept {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The position of point `index`, which must be below cloud.size, finite or not.
[[nodiscard]] inline Point point(const CloudView& cloud, std::size_t index) noexcept {
  return extend::read(cloud.points, index);
}

/// The normal of point `index`; the cloud must have normals.
[[nodiscard]] inline SurfaceNormal normal(const CloudView& cloud, std::size_t index) noexcept {
  const Point n = extend::read(cloud.normals, index);
  return {n.x, n.y, n.z};
}

/// The color of point `index`; the cloud must have colors.
[[nodiscard]] inline Rgb color(const CloudView& cloud, std::size_t index) noexcept {
  return extend::read(cloud.colors, index);
}

/// The intensity of point `index`, in whatever unit the sensor has; the cloud must have intensities.
[[nodiscard]] inline float intensity(const CloudView& cloud, std::size_t index) noexcept {
  return extend::read(cloud.intensities, index);
}

/// Are all three coordinates finite?
[[nodiscard]] inline bool is_finite(const Point& p) noexcept {
  return extend::math::is_finite(p.x) && extend::math::is_finite(p.y) && extend::math::is_finite(p.z);
}

/// Summed as (dx*dx + dy*dy) + dz*dz, like all distances here.
[[nodiscard]] inline float squared_distance(const Point& a, const Point& b) noexcept {
  const float dx = a.x - b.x;
  const float dy = a.y - b.y;
  const float dz = a.z - b.z;
  return (extend::unfused(dx * dx) + extend::unfused(dy * dy)) + extend::unfused(dz * dz);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// The first point from index `i` on with three finite coordinates; cloud.size if there is none.
[[nodiscard]] inline std::size_t next_valid(const CloudView& cloud, std::size_t i, Point& p) noexcept {
  for (; i < cloud.size; ++i) {
    p = point(cloud, i);
    if (is_finite(p)) break;
  }
  return i;
}

/// Calls f(index, point) for each point with three finite coordinates, in order.
template <class Function>
void for_each_valid(const CloudView& cloud, Function f) {
  Point p;
  for (std::size_t i = next_valid(cloud, 0, p); i < cloud.size; i = next_valid(cloud, i + 1, p)) f(i, p);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_CLOUD_READ_HPP
