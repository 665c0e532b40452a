// shortshot/cloud/cloud.hpp: the only door for point clouds. A CloudView borrows the user's own memory, whatever its
// layout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../config.hpp"
#include "../status.hpp"

namespace shortshot {

/// Three float coordinates per point: where each one of point 0 lies, and how far it is to the same one of point 1.
/// Covers x y z x y z ..., arrays of structs with padding, and separate x, y, z arrays. No alignment is assumed.
struct Float3Channel {
  const unsigned char* x;
  const unsigned char* y;
  const unsigned char* z;
  std::size_t stride_bytes;
};

/// Three color bytes per point, sRGB. The three pointers express the order r g b, b g r (PCL, packed floats) or
/// planes.
struct ColorChannel {
  const unsigned char* r;
  const unsigned char* g;
  const unsigned char* b;
  std::size_t stride_bytes;
};

/// A borrowed point cloud: nothing is copied, nothing is owned, the memory must outlive the view.
/// Positions in meters (any unit works if the radius has the same). Points that are not finite are never neighbors.
/// A channel whose first pointer is null is absent. `width * height == size`; height is 1 for unorganized clouds.
/// Trivial type with plain members, the same in every translation unit; reading it is thread-safe.
struct CloudView {
  Float3Channel points;
  ColorChannel colors;
  Float3Channel normals;
  std::size_t size;
  std::size_t width;
  std::size_t height;
};

struct Point {
  float x, y, z;
};

/// A surface normal: a unit vector, or NaN in all three where a point has none.
struct Normal {
  float x, y, z;
};

/// An sRGB color.
struct Rgb {
  std::uint8_t r, g, b;
};

inline namespace SHORTSHOT_ISA {

[[nodiscard]] inline bool has_colors(const CloudView& cloud) noexcept { return cloud.colors.r != nullptr; }
[[nodiscard]] inline bool has_normals(const CloudView& cloud) noexcept { return cloud.normals.x != nullptr; }

namespace detail {

/// A channel whose x, y and z follow each other by `step` bytes; absent if there is no memory.
[[nodiscard]] inline Float3Channel float3_channel(const float* first, std::size_t step, std::size_t stride) noexcept {
  if (first == nullptr) return {};
  const auto* x = reinterpret_cast<const unsigned char*>(first);
  return {x, x + step, x + 2 * step, stride};
}

[[nodiscard]] inline ColorChannel color_channel(const unsigned char* r, std::size_t step, std::size_t stride) noexcept {
  if (r == nullptr) return {};
  return {r, r + step, r + 2 * step, stride};
}

/// A view of nothing, and of more than nothing: bad_view everywhere.
[[nodiscard]] inline CloudView unusable_view() noexcept {
  CloudView view{};
  view.size = 1;
  return view;
}

}  // namespace detail

/// View of `count` points x y z (floats). `stride_bytes` is the distance between points.
[[nodiscard]] inline CloudView view_xyz(const float* xyz, std::size_t count,
                                        std::size_t stride_bytes = 3 * sizeof(float)) noexcept {
  CloudView view{};
  view.points = detail::float3_channel(xyz, sizeof(float), stride_bytes);
  view.size = count;
  view.width = count;
  view.height = 1;
  return view;
}

/// View of `count` points x y z (floats) and their colors r g b (bytes), each with its own stride.
[[nodiscard]] inline CloudView view_xyz_rgb(const float* xyz, const std::uint8_t* rgb, std::size_t count,
                                            std::size_t xyz_stride_bytes = 3 * sizeof(float),
                                            std::size_t rgb_stride_bytes = 3) noexcept {
  CloudView view = view_xyz(xyz, count, xyz_stride_bytes);
  view.colors = detail::color_channel(rgb, 1, rgb_stride_bytes);
  return view;
}

/// The same cloud with `cloud.size` normals x y z (floats), borrowed like the points. `stride_bytes` is the distance
/// between normals.
[[nodiscard]] inline CloudView with_normals(CloudView cloud, const Normal* normals,
                                            std::size_t stride_bytes = sizeof(Normal)) noexcept {
  cloud.normals = detail::float3_channel(normals == nullptr ? nullptr : &normals->x, sizeof(float), stride_bytes);
  return cloud;
}

/// The same cloud as an image of `width * height` pixels, row by row, for OrganizedSearch.
[[nodiscard]] inline CloudView organized(CloudView cloud, std::size_t width, std::size_t height) noexcept {
  cloud.width = width;
  cloud.height = height;
  return cloud;
}

/// Is this a view that can be read at all? Every entry point asks once.
[[nodiscard]] inline Status check(const CloudView& cloud) noexcept {
  if (cloud.size == 0) return Status::empty_cloud;
  if (cloud.size > 0xFFFFFFFFu) return Status::bad_view;  // indices have 32 bits
  if (cloud.points.x == nullptr || cloud.points.y == nullptr || cloud.points.z == nullptr) return Status::bad_view;
  if (has_colors(cloud) && (cloud.colors.g == nullptr || cloud.colors.b == nullptr)) return Status::bad_view;
  if (has_normals(cloud) && (cloud.normals.y == nullptr || cloud.normals.z == nullptr)) return Status::bad_view;
  return Status::ok;
}

/// Element `index` of a channel. memcpy, because a PointCloud2 blob need not be aligned.
[[nodiscard]] inline Point read(const Float3Channel& channel, std::size_t index) noexcept {
  const std::size_t offset = index * channel.stride_bytes;
  Point p{};
  std::memcpy(&p.x, channel.x + offset, sizeof(float));
  std::memcpy(&p.y, channel.y + offset, sizeof(float));
  std::memcpy(&p.z, channel.z + offset, sizeof(float));
  return p;
}

[[nodiscard]] inline Point point(const CloudView& cloud, std::size_t index) noexcept {
  return read(cloud.points, index);
}

/// The normal of point `index`; the cloud must have normals.
[[nodiscard]] inline Normal normal(const CloudView& cloud, std::size_t index) noexcept {
  const Point n = read(cloud.normals, index);
  return {n.x, n.y, n.z};
}

[[nodiscard]] inline bool is_finite(const Point& p) noexcept {
  return math::is_finite(p.x) && math::is_finite(p.y) && math::is_finite(p.z);
}

/// Coordinate 0, 1 or 2 of a point.
[[nodiscard]] inline float coordinate(const Point& p, std::size_t axis) noexcept {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// Summed as (dx*dx + dy*dy) + dz*dz, like all distances here.
[[nodiscard]] inline float squared_distance(const Point& a, const Point& b) noexcept {
  const float dx = a.x - b.x;
  const float dy = a.y - b.y;
  const float dz = a.z - b.z;
  return (rounded(dx * dx) + rounded(dy * dy)) + rounded(dz * dz);
}

/// The points of one register.
struct PointLanes {
  simd::F32 x, y, z;
};

/// Their component along an axis, rounded as PCL and the published code round it: x + z first, then y.
/// In place for small code as well: a call of it is longer than what it does.
[[nodiscard, gnu::always_inline]] inline simd::F32 along(const simd::F32 (&axis)[3], const PointLanes& v) noexcept {
  return (v.x * axis[0] + v.z * axis[2]) + v.y * axis[1];
}

/// Element index_at(k) in lane k.
template <class Function>
[[nodiscard, gnu::always_inline]] inline PointLanes read_lanes(const Float3Channel& channel,
                                                               Function index_at) noexcept {
  const auto read_component = [&](const unsigned char* first) {
    return simd::from_lanes([&](std::size_t lane) {
      float value = 0.0f;
      std::memcpy(&value, first + index_at(lane) * channel.stride_bytes, sizeof value);
      return value;
    });
  };
  return {read_component(channel.x), read_component(channel.y), read_component(channel.z)};
}

[[nodiscard]] inline simd::Mask is_finite(const PointLanes& p) noexcept {
  const simd::I32 exponent = simd::all_int(0x7F800000);
  const auto below = [&](simd::F32 v) { return (bits_of(v) & exponent) - exponent; };  // negative if v is finite
  return is_negative(below(p.x) & below(p.y) & below(p.z));
}

/// Calls f(index, points, valid) for registers of points in order: the first one's index, and which lanes have three
/// finite coordinates. At least one has; registers without are passed over. The view comes by value: no store that f
/// makes can change it.
template <class Function>
[[gnu::always_inline]] inline void for_each_valid_register(const CloudView cloud, Function f) {
  const std::size_t last = cloud.size - 1;
  for (std::size_t i = 0; i < cloud.size; i += simd::lanes) {
    const bool whole = cloud.size - i >= simd::lanes;
    const PointLanes points =
        whole ? read_lanes(cloud.points, [i](std::size_t lane) { return i + lane; })
              : read_lanes(cloud.points, [=](std::size_t lane) { return i + lane < last ? i + lane : last; });
    const simd::Mask valid = whole ? is_finite(points) : is_finite(points) & simd::first(cloud.size - i);
    if (any(valid)) f(i, points, valid);
  }
}

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

[[nodiscard, gnu::always_inline]] inline Rgb read(const ColorChannel& channel, std::size_t index) noexcept {
  const std::size_t offset = index * channel.stride_bytes;
  return {channel.r[offset], channel.g[offset], channel.b[offset]};
}

/// The color of point `index`; the cloud must have colors.
[[nodiscard]] inline Rgb color(const CloudView& cloud, std::size_t index) noexcept { return read(cloud.colors, index); }

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
