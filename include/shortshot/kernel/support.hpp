// shortshot/kernel/support.hpp: what is described around a key point.
#ifndef SHORTSHOT_KERNEL_SUPPORT_HPP
#define SHORTSHOT_KERNEL_SUPPORT_HPP

#include "../config.hpp"
#include "../frame/viewpoint.hpp"
#include "../search/radius.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What is described around a key point. Converts from a radius: `0.04f` is a support of 4 cm in SHOT's own frame.
struct Support {
  Radius radius;        ///< of the descriptor
  Radius frame_radius;  ///< of the local reference frame (LRF); may be smaller or larger
  Viewpoint viewpoint;  ///< turns the frames' z

  /// The same radius for descriptor and frame; no viewpoint.
  [[gnu::always_inline]] constexpr Support(Radius r) noexcept  // NOLINT: see above
      : radius(r), frame_radius(r) {}
  [[gnu::always_inline]] constexpr Support(float r) noexcept : Support(Radius(r)) {}  // NOLINT: see above
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The larger of the two radii.
[[nodiscard]] inline Radius gather_radius(const Support& support) noexcept {
  return support.frame_radius.squared > support.radius.squared ? support.frame_radius : support.radius;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SUPPORT_HPP
