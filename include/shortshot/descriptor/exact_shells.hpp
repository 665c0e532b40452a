// shortshot/descriptor/exact_shells.hpp: distances that fall on the right side of a shell's border.
#ifndef SHORTSHOT_DESCRIPTOR_EXACT_SHELLS_HPP
#define SHORTSHOT_DESCRIPTOR_EXACT_SHELLS_HPP

#include <cstddef>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../cloud/point_lanes.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// Where votes jump from shell to shell: on the borders and in the middles of shells, multiples of R / `Multiples`
/// both. For each grid, that is every so many `Steps` of these multiples, borders and middles by turns. Without grids:
/// a float's own rounding is as good as any.
template <int Multiples, int... Steps>
struct ShellBorders {
  static constexpr float per_radius = static_cast<float>(Multiples);      ///< multiples
  static constexpr int grids = static_cast<int>(sizeof...(Steps));        ///< number of them
  static constexpr float steps[] = {static_cast<float>(Steps)..., 0.0f};  ///< of each grid, in multiples; 0: the end
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::extend

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The smallest common multiple, up to 2^20: as far as floats tell multiples of its inverse apart.
template <class... Numbers>
constexpr int common_multiple(Numbers... numbers) noexcept {
  constexpr int most = 1 << 20;
  int all = 1;
  for (const int number : {numbers...}) {
    int multiple = all;
    while (multiple % number != 0 && multiple < most - all) multiple += all;
    all = multiple % number == 0 ? multiple : most;
  }
  return all;
}

/// How many of `all` multiples of 1 / all lie between two of the `own` of a grid. One shell (2) alone has no border
/// where votes jump: beyond all.
constexpr int step_between(int all, int own) noexcept { return own > 2 ? all / own : 2 * all; }

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// How much longer a vector is than `multiple` >= 1 times R / per_radius, in these units.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 units_beyond(const PointLanes& vector, simd::F32 multiple, Radius radius,
                                                      float per_radius) noexcept {
  using simd::all;
  const float splitter = unfused(12288.0f * radius.value);
  const simd::F32 r = all(radius.value);
  const simd::F32 coarse_r = math::coarse(r, splitter);
  const simd::F32 units = all(per_radius);
  const simd::F32 unit = r / units;
  // multiple * R / per_radius in two parts
  const simd::F32 large = math::coarse(multiple * unit, splitter);
  const simd::F32 rest = ((multiple * coarse_r - units * large) + multiple * (r - coarse_r)) / units;
  return math::length_beyond(vector.x, vector.y, vector.z, large, rest, splitter) / unit;
}

/// How far a place beyond a multiple of R / per_radius is from it as the published code sees it, which rounds a
/// distance in shells to float once: 0 if that makes it the multiple itself. A border is told from what lies below it,
/// a middle from what lies above it.
template <class Borders>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 rounded_beyond(simd::F32 multiple, simd::F32 beyond) noexcept {
  using simd::all;
  if constexpr (Borders::grids == 1) return (multiple + beyond) - multiple;  // it may as well know the other side
  simd::F32 rounded = all(0.0f);
  for (const float* each = Borders::steps; *each > 0.0f; ++each) {
    const simd::F32 step = all(*each);
    const simd::F32 halves = multiple / step;  // of shells
    const simd::F32 off = (halves + beyond / step) - halves;
    // Even numbers of halves are borders, odd ones middles: whole if the votes of this grid jump on that side.
    const simd::F32 jumps = all(0.5f) * select(off > all(0.0f), halves + all(1.0f), halves);
    rounded = select(jumps != simd::to_whole(jumps), rounded, rounded + off * step);
  }
  return rounded;
}

/// Distances over the radius. Points of a regular grid lie exactly on the borders and in the middles of shells, where
/// one bit decides which neighboring shell gets a vote: there, and only there, they fall on the side on which the
/// published code has them.
template <class Borders>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 distance_over_radius(simd::F32 d2, const PointLanes& local,
                                                              Radius radius) noexcept {
  const simd::F32 distance = simd::sqrt(d2) * simd::all(1.0f / radius.value);
  if constexpr (Borders::grids == 0) return distance;
  const simd::F32 position = distance * simd::all(Borders::per_radius);
  const simd::F32 nearest = simd::to_whole(position);
  const simd::F32 rounding = simd::all(1e-6f * Borders::per_radius);
  const simd::Mask near = rounding > simd::abs(position - nearest);
  if (any(near)) {
    const simd::F32 multiple = simd::max(nearest, simd::all(1.0f));  // nothing jumps at 0
    const simd::F32 beyond = units_beyond(local, multiple, radius, Borders::per_radius);
    const simd::F32 side = rounded_beyond<Borders>(multiple, beyond);
    // Twice as far from the border as it is, which no rounding on the way from here to a cell undoes.
    const simd::F32 exact = ((multiple + side) + side) / simd::all(Borders::per_radius);
    // A frame that is not quite orthonormal must not move its neighbors from border to border.
    const simd::Mask same = rounding > simd::abs(beyond);
    return select(near & same, exact, distance);
  }
  return distance;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_DESCRIPTOR_EXACT_SHELLS_HPP
