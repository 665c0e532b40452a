// shortshot/frame/viewpoint.hpp: to which side of a surface normals and frames are turned.
#ifndef SHORTSHOT_FRAME_VIEWPOINT_HPP
#define SHORTSHOT_FRAME_VIEWPOINT_HPP

#include <cstdint>

#include "../base/math.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A point, in the cloud's coordinates, to which or from which normals and the z axes of frames are turned. Absent (the
/// default): a normal's sign is the solver's, a frame's z is turned by SHOT's vote. Trivially copyable.
struct Viewpoint {
  /// What the point is.
  enum class Side : std::uint8_t { absent, towards, away_from };
  Side side = Side::absent;  ///< absent: the point means nothing
  Point point = {};          ///< in the cloud's coordinates

  /// To the camera, which sees the surface from outside. In a depth camera's own coordinates it is at {0, 0, 0}.
  [[nodiscard, gnu::always_inline]] static constexpr Viewpoint towards(const Point& camera) noexcept {
    return {Side::towards, camera};
  }
  /// Outwards, from a point inside: for whole objects.
  [[nodiscard, gnu::always_inline]] static constexpr Viewpoint away_from(const Point& inside) noexcept {
    return {Side::away_from, inside};
  }
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// ok or bad_viewpoint.
[[nodiscard]] inline Status validate(const Viewpoint& viewpoint) noexcept {
  return viewpoint.side == Viewpoint::Side::absent || is_finite(viewpoint.point) ? Status::ok : Status::bad_viewpoint;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What to turn to at a place; zeros if the viewpoint is absent. bad_viewpoint if it is not finite, or so far away that
/// the difference overflows.
[[nodiscard]] inline Status direction_at(const Viewpoint& viewpoint, const Point& place, float (&view)[3]) noexcept {
  view[0] = view[1] = view[2] = 0.0f;
  if (viewpoint.side == Viewpoint::Side::absent) return Status::ok;
  const float side = viewpoint.side == Viewpoint::Side::towards ? 1.0f : -1.0f;
  view[0] = (viewpoint.point.x - place.x) * side;
  view[1] = (viewpoint.point.y - place.y) * side;
  view[2] = (viewpoint.point.z - place.z) * side;
  return math::is_finite(view) ? Status::ok : Status::bad_viewpoint;
}

/// What every estimate from a neighborhood asks of its arguments; `view` becomes the direction to turn to.
template <class Neighbors>
[[nodiscard]] inline Status validate_estimate(const Neighbors& n, Radius radius, const Viewpoint& viewpoint,
                                              float (&view)[3]) noexcept {
  const Status usable = validate(radius);
  if (usable != Status::ok) return usable;
  return n.size > max_neighbors ? Status::too_many_neighbors : direction_at(viewpoint, n.center, view);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_FRAME_VIEWPOINT_HPP
