// shortshot/search/radius.hpp: the support radius.
#ifndef SHORTSHOT_SEARCH_RADIUS_HPP
#define SHORTSHOT_SEARCH_RADIUS_HPP

#include <cstdint>

#include "../base/math.hpp"
#include "../config.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A support radius in meters and its square. Neighbors are points with float d2 < squared: strictly inside.
/// Converts from float, squared in float. from_double() squares in double and rounds once, as PCL does: the same
/// neighbors to the last point on the rim. (Meant for constants and hosts: no double is left in firmware code.)
struct Radius {
  float value;    ///< meters
  float squared;  ///< what squared distances are compared with

  /// Squared in float.
  [[gnu::always_inline]] constexpr Radius(float radius) noexcept
      : value(radius), squared(radius * radius) {}  // NOLINT: 0.04f is a radius
  /// Squared in double, rounded once.
  [[nodiscard, gnu::always_inline]] static constexpr Radius from_double(double radius) noexcept {
    Radius r(static_cast<float>(radius));
    r.squared = static_cast<float>(radius * radius);
    return r;
  }
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// A radius must be a positive number whose square is a normal one, and not so near to the largest that a neighbor's
/// coordinates in a frame might have larger ones: at most about 1.8e19.
[[nodiscard]] inline Status validate(Radius radius) noexcept {
  // Bits of positive numbers order as the numbers do; infinity's follow.
  const auto lies_from = [](std::uint32_t first, float value) {
    return extend::math::bits_of(value) - first < 0x7F780000u - first;
  };
  return lies_from(1u, radius.value) && lies_from(0x00800000u, radius.squared) ? Status::ok : Status::bad_radius;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_SEARCH_RADIUS_HPP
