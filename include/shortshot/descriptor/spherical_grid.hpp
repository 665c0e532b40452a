// shortshot/descriptor/spherical_grid.hpp: the spherical grid of a part, and how wide its shells are.
#ifndef SHORTSHOT_DESCRIPTOR_SPHERICAL_GRID_HPP
#define SHORTSHOT_DESCRIPTOR_SPHERICAL_GRID_HPP

#include <cstddef>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../config.hpp"
#include "axis.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Divisions of the support sphere: `Radial` shells, `Elevation` cells between the frame's +z and -z, `Azimuth` cells
/// counter-clockwise from the frame's -x. The paper's r, e, a (equation 5): n = r * e * a cells. How they are numbered
/// and laid out is the convention's business (conventions.hpp).
template <int Radial, int Elevation, int Azimuth>
struct SphericalGrid {
  static_assert(Radial >= 1 && Elevation >= 1 && Azimuth >= 1,
                "SphericalGrid<Radial, Elevation, Azimuth> supports one or more divisions of each kind");
  static_assert(Radial <= 1024 && Elevation <= 1024 && Azimuth <= 1024 && 1LL * Radial * Elevation * Azimuth <= 65536,
                "SphericalGrid<Radial, Elevation, Azimuth> supports up to 1024 divisions of each kind, 65536 cells");
  static constexpr int radial = Radial;                       ///< shells
  static constexpr int elevation = Elevation;                 ///< cells from +z to -z
  static constexpr int azimuth = Azimuth;                     ///< sectors around z
  static constexpr int cells = Radial * Elevation * Azimuth;  ///< all of them
};

/// Shells of equal width: the published default.
struct LinearRadius {
  static constexpr const char* name = "equal shells";  ///< for layout_of()
  static constexpr bool is_linear = true;              ///< are shells of equal width?
  /// What a distance below the first border is.
  static constexpr extend::BelowZero below_zero = extend::BelowZero::never;
  /// All borders and middles of shells are multiples of 1 / borders.
  static constexpr int borders(int shells) noexcept { return 2 * shells; }
};

/// The published logarithmic shells: the innermost one reaches out to R * Numerator / Denominator, the others share
/// the rest evenly in log r. (The published default, 0.025 m, is 1/4 of a support radius of 0.1 m.)
template <int Numerator = 1, int Denominator = 4>
struct LogRadius {
  static_assert(0 < Numerator && 100LL * Numerator <= 99LL * Denominator,
                "LogRadius<N, D> supports ratios 0 < N / D <= 0.99");
  static constexpr const char* name = "logarithmic shells";
  static constexpr bool is_linear = false;
  static constexpr extend::BelowZero below_zero = extend::BelowZero::first_cell;
  static constexpr int borders(int) noexcept { return 1; }  // in float's own rounding
  /// Where `u`, the distance over the support radius, 0..1, lies along the axis.
  [[nodiscard]] static extend::simd::F32 position(const extend::Axis& shells, extend::simd::F32 u) noexcept {
    const float shell = shells.one();
    const float log_of_ratio = extend::math::log(static_cast<float>(Numerator) / static_cast<float>(Denominator));
    return extend::simd::map(
        [=](float distance) {
          // Distances below the smallest normal number have no logarithm; any tiny one lies in the innermost shell.
          const float log_of_distance = extend::math::log(distance > 1e-30f ? distance : 1e-30f);
          const float p =
              static_cast<float>(shells.cells - 1) * (log_of_distance - log_of_ratio) / -log_of_ratio + 1.0f;
          // Below zero, what counts is the rest of a shell: the cell is the innermost one anyway.
          return extend::unfused((p < 0.0f ? p - static_cast<float>(static_cast<int>(p)) : p) * shell);
        },
        u);
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

#endif  // SHORTSHOT_DESCRIPTOR_SPHERICAL_GRID_HPP
