// shortshot/cloud/cloud.hpp: the only door for point clouds. A CloudView borrows the user's own memory, whatever its
// layout.
#ifndef SHORTSHOT_CLOUD_CLOUD_HPP
#define SHORTSHOT_CLOUD_CLOUD_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "../config.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Three float coordinates per point: where each one of point 0 lies, and how far it is to the same one of point 1.
/// Covers x y z x y z ..., arrays of structs with padding, and separate x, y, z arrays. No alignment is assumed.
struct Float3Channel {
  /// A float of point 0.
  const unsigned char* x;
  const unsigned char* y;
  const unsigned char* z;
  std::size_t stride_bytes;  ///< bytes from one point to the next
};

/// Three color bytes per point, sRGB. The three pointers express the order r g b, b g r (PCL, packed floats) or
/// planes.
struct ColorChannel {
  /// A byte of point 0.
  const unsigned char* r;
  const unsigned char* g;
  const unsigned char* b;
  std::size_t stride_bytes;  ///< bytes from one point to the next
};

/// How the numbers of a ScalarChannel are stored.
enum class ScalarType : std::uint8_t { float32, uint8, uint16 };

/// One number per point, as the intensity of a lidar's or a time-of-flight camera's echo.
struct ScalarChannel {
  const unsigned char* value;  ///< of point 0
  std::size_t stride_bytes;    ///< bytes from one point to the next
  ScalarType type;             ///< how each is stored
};

/// What a descriptor may need of a cloud beyond its points; `own`: something that no view has, but the caller.
enum class Channel : std::uint8_t { colors, normals, intensities, own };

/// A borrowed point cloud: nothing is copied, nothing is owned, the memory must outlive the view.
/// Positions in meters (any unit works if the radius has the same). Points that are not finite are never neighbors.
/// A channel whose first pointer is null is absent. `width * height == size`; height is 1 for unorganized clouds.
/// Trivial type with plain members, the same in every translation unit; reading it is thread-safe.
struct CloudView {
  Float3Channel points;       ///< where they are
  ColorChannel colors;        ///< r null: none
  Float3Channel normals;      ///< x null: none
  ScalarChannel intensities;  ///< value null: none
  std::size_t size;           ///< number of points, valid or not
  std::size_t width;          ///< columns of the image; `size` for unorganized clouds
  std::size_t height;         ///< rows of the image, from top to bottom
  Status status;              ///< ok, or why the view could not be made: whoever is asked to read it says so
};

/// A position, in the cloud's unit. Trivial type.
struct Point {
  float x, y, z;  ///< coordinates
};

/// A surface normal: a unit vector, or NaN in all three where a point has none.
struct SurfaceNormal {
  float x, y, z;  ///< components
};

/// An sRGB color.
struct Rgb {
  std::uint8_t r, g, b;  ///< red, green and blue
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Does the cloud have this channel?
[[nodiscard]] inline bool has_colors(const CloudView& cloud) noexcept { return cloud.colors.r != nullptr; }
[[nodiscard]] inline bool has_normals(const CloudView& cloud) noexcept { return cloud.normals.x != nullptr; }
[[nodiscard]] inline bool has_intensities(const CloudView& cloud) noexcept {
  return cloud.intensities.value != nullptr;
}

/// Is this a view that can be read at all? Every entry point asks once.
[[nodiscard]] inline Status validate(const CloudView& cloud) noexcept {
  if (cloud.status != Status::ok) return cloud.status;
  if (cloud.size == 0) return Status::empty_cloud;
  if (cloud.size > 0xFFFFFFFFu) return Status::bad_view;  // indices have 32 bits
  if (cloud.points.x == nullptr || cloud.points.y == nullptr || cloud.points.z == nullptr) return Status::bad_view;
  if (has_colors(cloud) && (cloud.colors.g == nullptr || cloud.colors.b == nullptr)) return Status::bad_view;
  if (has_normals(cloud) && (cloud.normals.y == nullptr || cloud.normals.z == nullptr)) return Status::bad_view;
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

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

/// float32, uint8 or uint16: how a ScalarChannel reads a Scalar.
template <class Scalar>
inline constexpr bool is_channel_scalar =
    std::is_same<Scalar, float>::value || std::is_same<Scalar, std::uint8_t>::value ||
    std::is_same<Scalar, std::uint16_t>::value;

template <class Scalar>
[[nodiscard]] ScalarChannel scalar_channel(const Scalar* first, std::size_t stride) noexcept {
  static_assert(is_channel_scalar<Scalar>, "Intensities are supported as float, std::uint8_t and std::uint16_t");
  if (first == nullptr) return {};
  return {reinterpret_cast<const unsigned char*>(first), stride,
          sizeof(Scalar) == 4   ? ScalarType::float32
          : sizeof(Scalar) == 2 ? ScalarType::uint16
                                : ScalarType::uint8};
}

/// A view of nothing, for a reason.
[[nodiscard]] inline CloudView unusable_view(Status reason) noexcept {
  CloudView view{};
  view.status = reason;
  return view;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

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
[[nodiscard]] inline CloudView with_normals(CloudView cloud, const SurfaceNormal* normals,
                                            std::size_t stride_bytes = sizeof(SurfaceNormal)) noexcept {
  cloud.normals = detail::float3_channel(normals == nullptr ? nullptr : &normals->x, sizeof(float), stride_bytes);
  return cloud;
}

/// The same cloud with `cloud.size` intensities (float, std::uint8_t or std::uint16_t), borrowed like the points.
/// `stride_bytes` is the distance between two of them.
template <class Scalar>
[[nodiscard]] CloudView with_intensities(CloudView cloud, const Scalar* intensities,
                                         std::size_t stride_bytes = sizeof(Scalar)) noexcept {
  cloud.intensities = detail::scalar_channel(intensities, stride_bytes);
  return cloud;
}

/// The same cloud as an image of `width * height` pixels, row by row, for OrganizedSearch.
[[nodiscard]] inline CloudView organized(CloudView cloud, std::size_t width, std::size_t height) noexcept {
  cloud.width = width;
  cloud.height = height;
  return cloud;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_CLOUD_CLOUD_HPP
