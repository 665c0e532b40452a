// shortshot/descriptor/conventions.hpp: the conventions of cells: where they begin, on which side a border lies, how
// they are laid out.
//
// There are two: that of the published SSH / SCSH code and that of SHOT as PCL computes it. A descriptor has one.
#pragma once

#include <cstdint>

#include "../base/simd.hpp"
#include "../config.hpp"
#include "axis.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {

/// Distances of neighboring cells in a grid's layout, in cells.
struct CellStrides {
  int radial, elevation, azimuth;
};

/// The cells of the published SSH / SCSH code: elevation from the frame's +z down, a border belongs to the cell above
/// it, radius is laid out fastest and azimuth slowest, and a histogram has bins of equal width.
struct PublishedCells {
  static constexpr const char* name = "published cells";  ///< for layout_of()
  template <class Grid>
  static constexpr CellStrides strides{1, Grid::radial, Grid::radial* Grid::elevation};
  /// Values of a histogram of a signal's `bins`.
  [[nodiscard]] static constexpr int values(int bins) noexcept { return bins; }

  /// Neighbors with a squared distance up to this one are taken for the key point's copies.
  static constexpr float copies_d2 = 1e-15f;
  /// Fewest neighbors, the key point and its copies included.
  static constexpr std::uint32_t min_neighbors = 0;
  /// Distances on the borders of shells are those that double precision gives.
  static constexpr bool has_exact_shells = true;
  /// A neighbor on the frame's z axis has no azimuth.
  static constexpr bool has_poles = false;

  /// Where an angle from +z (over pi) lies along the elevation axis, both 0..1.
  [[nodiscard]] static simd::F32 elevation(simd::F32 from_top) noexcept { return from_top; }
  /// From numbers of cells, times the axis' unit, to fixed-point positions on grid axes.
  [[nodiscard]] static simd::I32 position(simd::F32 scaled) noexcept { return truncate_to_int(scaled); }
  /// Does a signal, 0..1, have its place on the histogram's axis as a coordinate has on an axis of the grid?
  static constexpr bool bins_are_cells = true;
};

/// The cells of SHOT and CSHOT in PCL 1.13: elevation from the frame's -z up, a border belongs to the cell below it (a
/// neighbor at R / 2 to the inner shell, one at z = 0 to the lower half), histograms fastest, then elevation, radius
/// and azimuth, and one value more than a histogram has bins, because those are the distances of their middles.
struct ShotCells {
  static constexpr const char* name = "SHOT cells";
  template <class Grid>
  static constexpr CellStrides strides{Grid::elevation, 1, Grid::radial* Grid::elevation};
  [[nodiscard]] static constexpr int values(int bins) noexcept { return bins + 1; }

  static constexpr float copies_d2 = 1e-30f;
  static constexpr std::uint32_t min_neighbors = 5;
  static constexpr bool has_exact_shells = false;
  static constexpr bool has_poles = true;

  [[nodiscard]] static simd::F32 elevation(simd::F32 from_top) noexcept { return simd::all(1.0f) - from_top; }
  [[nodiscard]] static simd::I32 position(simd::F32 scaled) noexcept {
    return truncate_to_int(simd::max(scaled, simd::all(1.0f))) - simd::all_int(1);
  }
  static constexpr bool bins_are_cells = false;
  /// From a signal to its place on the histogram's axis.
  [[nodiscard]] static simd::I32 bin_position(const Axis& axis, simd::F32 signal) noexcept {
    const std::int32_t middle = std::int32_t{1} << (axis.bits - 1);
    return truncate_to_int(signal * simd::all(static_cast<float>(axis.cells - 1) * axis.one())) + simd::all_int(middle);
  }
};

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
