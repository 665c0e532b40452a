// shortshot/descriptor/conventions.hpp: the conventions of cells: who is described, where cells begin, on which side a
// border lies, how cells are laid out.
//
// There are two: that of the published SSH / SCSH code and that of SHOT as PCL computes it. A descriptor has one. A
// convention owns its positions: the kernel asks it, and knows none of its rules.
#ifndef SHORTSHOT_DESCRIPTOR_CONVENTIONS_HPP
#define SHORTSHOT_DESCRIPTOR_CONVENTIONS_HPP

#include <cstdint>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../cloud/point_lanes.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "axis.hpp"

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// Distances of neighboring cells in a grid's layout, in cells.
struct CellStrides {
  int radial, elevation, azimuth;  ///< from one shell, elevation or sector to the next
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// The cells of the published SSH / SCSH code: elevation from the frame's +z down, a border belongs to the cell above
/// it, radius is laid out fastest and azimuth slowest, and a histogram has bins of equal width.
struct PublishedCells {
  static constexpr const char* name = "published cells";  ///< for layout_of()
  /// Are frames meant to look at the camera, where it is known?
  static constexpr bool wants_viewpoint = false;
  /// Does it depend on the frame in which cell a neighbor lies? Always: whether it is beyond the border of a shell is
  /// worked out from its coordinates there.
  template <class Grid>
  static constexpr bool needs_frame = true;

  /// How the cells of a grid are laid out.
  template <class Grid>
  static constexpr extend::CellStrides strides{1, Grid::radial, Grid::radial* Grid::elevation};
  /// Values of a histogram of a signal's `bins`.
  [[nodiscard, gnu::always_inline]] static constexpr int values(int bins) noexcept { return bins; }
  /// What positions below zero mean on the azimuth axis.
  static constexpr extend::BelowZero azimuth_below_zero = extend::BelowZero::never;
  /// May a position be the very end of its axis?
  static constexpr bool reaches_end = true;
  /// Distances on the borders of shells, multiples of R / borders, are those that double precision gives.
  [[nodiscard, gnu::always_inline]] static constexpr int exact_borders(int borders) noexcept { return borders; }

  /// Are there neighbors enough to describe?
  template <class Neighbors>
  [[nodiscard, gnu::always_inline]] static bool has_enough(const Neighbors&, Radius) noexcept {
    return true;
  }
  /// Which neighbors are described: all but the key point and its copies.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::Mask are_described(extend::simd::F32 d2, Radius radius) noexcept {
    return (d2 < extend::simd::all(radius.squared)) & (d2 > extend::simd::all(1e-15f));
  }

  /// Coordinates 1 and 2 of neighbors (0 is the distance over the radius): the angle from +z over pi, and the angle
  /// from -x, counter-clockwise, in turns; both 0..1.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 elevation(const extend::PointLanes& local,
                                                                    extend::simd::F32 from_axis, Radius) noexcept {
    return extend::math::elevation(from_axis, local.z);
  }
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 azimuth(const extend::PointLanes& local,
                                                                  extend::simd::F32) noexcept {
    return extend::math::azimuth(local.x, local.y);
  }

  /// Where a coordinate, or the value of a signal (k = 3), lies along axis `k`, in the axis' fixed-point unit.
  template <class Scale>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 position(const extend::Axis& axis, int k,
                                                                   extend::simd::F32 coordinate) noexcept {
    if constexpr (!Scale::is_linear) {
      if (k == 0) return truncate_to_int(Scale::position(axis, coordinate));
    }
    return truncated_product(coordinate, extend::simd::all(axis.length()));
  }
};

/// The cells of SHOT and CSHOT in PCL 1.13: elevation from the frame's -z up, a border belongs to the cell below it (a
/// neighbor at R / 2 to the inner shell, one at z = 0 to the lower half), histograms fastest, then elevation, radius
/// and azimuth, and one value more than a histogram has bins, because those are the distances of their middles. (The
/// field's words: azimuth cells are sectors, a histogram of cosines is a local histogram.) A neighbor on the frame's z
/// axis has no azimuth.
struct ShotCells {
  static constexpr const char* name = "SHOT cells";
  static constexpr bool wants_viewpoint = false;
  template <class Grid>
  static constexpr bool needs_frame = true;

  template <class Grid>
  static constexpr extend::CellStrides strides{Grid::elevation, 1, Grid::radial* Grid::elevation};
  [[nodiscard, gnu::always_inline]] static constexpr int values(int bins) noexcept { return bins + 1; }
  static constexpr extend::BelowZero azimuth_below_zero = extend::BelowZero::nowhere;
  static constexpr bool reaches_end = false;
  [[nodiscard, gnu::always_inline]] static constexpr int exact_borders(int) noexcept { return 1; }

  /// Five within the radius, the key point and its copies included.
  template <class Neighbors>
  [[nodiscard, gnu::always_inline]] static bool has_enough(const Neighbors& n, Radius radius) noexcept {
    std::uint32_t missing = 5;
    for (std::uint32_t i = 0; i < n.size; ++i) {
      if (extend::neighbor_at(n, i).d2 < radius.squared && --missing == 0) return true;
    }
    return false;
  }
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::Mask are_described(extend::simd::F32 d2, Radius radius) noexcept {
    return (d2 < extend::simd::all(radius.squared)) & (d2 > extend::simd::all(1e-30f));
  }

  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 elevation(const extend::PointLanes& local,
                                                                    extend::simd::F32 from_axis, Radius) noexcept {
    return extend::math::elevation(from_axis, local.z);
  }
  /// Below 0 on the z axis.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 azimuth(const extend::PointLanes& local,
                                                                  extend::simd::F32 from_axis) noexcept {
    const extend::simd::F32 angle = extend::math::azimuth(local.x, local.y);
    return select(from_axis > extend::simd::all(0.0f), angle, extend::simd::all(-1.0f));
  }

  template <class Scale>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 position(const extend::Axis& axis, int k,
                                                                   extend::simd::F32 coordinate) noexcept {
    using namespace extend;
    if (k == 3) {
      const std::int32_t middle = std::int32_t{1} << (axis.bits - 1);
      return truncated_product(coordinate, simd::all(static_cast<float>(axis.cells - 1) * axis.one())) +
             simd::all_int(middle);
    }
    if constexpr (!Scale::is_linear) {
      if (k == 0) return of_scaled(Scale::position(axis, coordinate));
    }
    const simd::F32 along = k == 1 ? simd::all(1.0f) - coordinate : coordinate;
    const simd::I32 position = of_scaled(along * simd::all(axis.length()));
    if (k == 2) return invert(is_negative(bits_of(coordinate)), position);  // 0 to -1: nowhere
    return position;
  }

 private:
  /// A border belongs to the cell below it.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 of_scaled(extend::simd::F32 scaled) noexcept {
    return truncate_to_int(extend::simd::max(scaled, extend::simd::all(1.0f))) - extend::simd::all_int(1);
  }
};

/// The published cells, but for elevation: a cell is a slice of heights over the tangent plane, from R / 2 above it
/// down to R / 2 below, in place of a cone of angles. Surfaces are flat where they are small: most neighbors lie near
/// the plane, where the cones' borders meet. Distances are as floats round them.
struct HeightCells : PublishedCells {
  static constexpr const char* name = "height cells";
  static constexpr bool wants_viewpoint = true;  // a surface and its back are each other's mirror image in height
  template <class Grid>
  static constexpr bool needs_frame = Grid::elevation > 1 || Grid::azimuth > 1;

  [[nodiscard, gnu::always_inline]] static constexpr int exact_borders(int) noexcept { return 1; }
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::Mask are_described(extend::simd::F32 d2, Radius radius) noexcept {
    return (d2 < extend::simd::all(radius.squared)) & (d2 > extend::simd::all(0.0f));
  }
  /// How far below R / 2 over the plane, over R; cut off at both ends.
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::F32 elevation(const extend::PointLanes& local, extend::simd::F32,
                                                                    Radius radius) noexcept {
    using namespace extend;
    const simd::F32 depth = simd::all(0.5f) - local.z * simd::all(1.0f / radius.value);
    return simd::max(simd::min(depth, simd::all(1.0f)), simd::all(0.0f));
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

#endif  // SHORTSHOT_DESCRIPTOR_CONVENTIONS_HPP
