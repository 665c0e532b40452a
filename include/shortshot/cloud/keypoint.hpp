// shortshot/cloud/keypoint.hpp: a place to describe.
#ifndef SHORTSHOT_CLOUD_KEYPOINT_HPP
#define SHORTSHOT_CLOUD_KEYPOINT_HPP

#include <cstddef>
#include <type_traits>

#include "../config.hpp"
#include "cloud.hpp"
#include "read.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A place to describe: a point of the cloud, or any other position (a voxel's centroid), with the color and the
/// intensity that its neighbors' are compared with. Where a descriptor needs one that a key point does not have, the
/// key point has the status missing_colors or missing_intensities. Trivially copyable.
struct KeyPoint {
  Point position;          ///< in the cloud's coordinates
  float intensity;         ///< if has_intensity
  Rgb color;               ///< if has_color
  bool has_color : 1;      ///< can its color be compared?
  bool has_intensity : 1;  ///< can its intensity be compared?

  KeyPoint() = default;
  /// Without a color or an intensity.
  [[gnu::always_inline]] constexpr KeyPoint(const Point& p) noexcept  // NOLINT: a point can be described
      : position(p), intensity(0.0f), color{}, has_color(false), has_intensity(false) {}
  /// With a color.
  [[gnu::always_inline]] constexpr KeyPoint(const Point& p, const Rgb& rgb) noexcept
      : position(p), intensity(0.0f), color(rgb), has_color(true), has_intensity(false) {}
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// The key point at point `index` of a cloud, which must be below cloud.size, with what the cloud has there.
[[nodiscard]] inline KeyPoint keypoint(const CloudView& cloud, std::size_t index) noexcept {
  KeyPoint key(point(cloud, index));
  key.has_color = has_colors(cloud);
  key.has_intensity = has_intensities(cloud);
  if (key.has_color) key.color = color(cloud, index);
  if (key.has_intensity) key.intensity = intensity(cloud, index);
  return key;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Is this the index of a point of the cloud? Negative ones become far too large, and wide ones are compared as they
/// are: where std::size_t has 32 bits, 2^32 is not point 0.
template <class Index>
[[nodiscard, gnu::always_inline]] inline bool is_index(const CloudView& cloud, Index index) noexcept {
  using Number = typename std::conditional_t<(sizeof(Index) > sizeof(std::size_t)), std::make_unsigned<Index>,
                                             std::common_type<std::size_t>>::type;
  return static_cast<Number>(index) < cloud.size;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_CLOUD_KEYPOINT_HPP
