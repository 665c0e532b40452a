// shortshot/batch/plane_of_sums.hpp: the normals of planes through the pixels of windows. Hosted only.
#pragma once

#include "../base/simd.hpp"
#include "../cloud/point_lanes.hpp"
#include "../config.hpp"
#include "pixel_sums.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The upper triangle of a symmetric matrix in each lane.
struct SymmetricTriangle {
  simd::F32 xx, xy, xz, yy, yz, zz;

  [[nodiscard]] simd::F32 trace() const noexcept { return xx + yy + zz; }
};

[[nodiscard, gnu::always_inline]] inline SymmetricTriangle operator*(const SymmetricTriangle& m,
                                                                     simd::F32 factor) noexcept {
  return {m.xx * factor, m.xy * factor, m.xz * factor, m.yy * factor, m.yz * factor, m.zz * factor};
}

/// Its eigenvectors are those of the matrix, the products of the other two's eigenvalues its eigenvalues.
[[nodiscard, gnu::always_inline]] inline SymmetricTriangle adjugate(const SymmetricTriangle& m) noexcept {
  return {m.yy * m.zz - m.yz * m.yz, m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy,
          m.xx * m.zz - m.xz * m.xz, m.xy * m.xz - m.xx * m.yz, m.xx * m.yy - m.xy * m.xy};
}

[[nodiscard, gnu::always_inline]] inline SymmetricTriangle square(const SymmetricTriangle& m) noexcept {
  return {m.xx * m.xx + m.xy * m.xy + m.xz * m.xz, m.xx * m.xy + m.xy * m.yy + m.xz * m.yz,
          m.xx * m.xz + m.xy * m.yz + m.xz * m.zz, m.xy * m.xy + m.yy * m.yy + m.yz * m.yz,
          m.xy * m.xz + m.yy * m.yz + m.yz * m.zz, m.xz * m.xz + m.yz * m.yz + m.zz * m.zz};
}

/// How points scatter about their centroid, times their number, of sums about an origin that may be far away: they are
/// moved to `center`, which lies among the points, before they become floats.
[[nodiscard, gnu::always_inline]] inline SymmetricTriangle scatter_of(const SumLanes& sums,
                                                                      const WrappingLanes (&center)[3]) noexcept {
  const auto to_floats = [](WrappingLanes v) { return to_float(same_bits<simd::I32>(v)); };
  const WrappingLanes(&of)[PixelSums::kinds] = sums.of;
  const WrappingLanes moved[3] = {of[1] - of[0] * center[0], of[2] - of[0] * center[1], of[3] - of[0] * center[2]};
  const simd::F32 weight = simd::all(1.0f) / simd::max(to_floats(of[0]), simd::all(1.0f));
  const auto entry = [&](int a, int b, int kind) SHORTSHOT_INLINE_LAMBDA {
    const WrappingLanes about_center = a == b ? of[kind] - center[a] * (of[1 + a] + moved[a])
                                              : of[kind] - center[a] * of[1 + b] - center[b] * moved[a];
    return to_floats(about_center) - to_floats(moved[a]) * (to_floats(moved[b]) * weight);
  };
  return {entry(0, 0, 4), entry(0, 1, 5), entry(0, 2, 6), entry(1, 1, 7), entry(1, 2, 8), entry(2, 2, 9)};
}

/// A direction in each lane, and where there is one.
struct DirectionLanes {
  PointLanes direction;
  simd::Mask exists;
};

/// Along which `members` points scatter least: unit vectors; none for fewer than three, or if they lie on a line within
/// a step of whole numbers. The adjugate is the inverse but for a factor: its powers' columns turn to it, as in a power
/// iteration. Off by the fourth power of how much less the points scatter along it than along the next direction.
[[nodiscard, gnu::always_inline]] inline DirectionLanes least_scatter(const SymmetricTriangle& scatter,
                                                                      simd::F32 members) noexcept {
  using simd::all;
  using simd::F32;
  const F32 extent = simd::max(scatter.trace(), all(1.0f));
  SymmetricTriangle power = adjugate(scatter * (all(1.0f) / extent));
  const F32 second = power.trace() * extent;  // the second eigenvalue, or a little more
  power = square(square(power * (all(1.0f) / simd::max(power.trace(), all(1e-12f)))));
  const F32 trace = power.trace();  // from a 27th to 1, if the sums did not wrap
  const simd::Mask exists = (members > all(2.5f)) & (second > members) & (trace > all(0.015625f)) & (trace < all(2.0f));

  const simd::Mask y_leads = power.yy > power.xx;
  const F32 leading = simd::max(power.xx, power.yy);
  const simd::Mask z_leads = power.zz > leading;
  const auto column = [&](F32 of_x, F32 of_y, F32 of_z)
                          SHORTSHOT_INLINE_LAMBDA { return select(z_leads, of_z, select(y_leads, of_y, of_x)); };
  const F32 x = column(power.xx, power.xy, power.xz);
  const F32 y = column(power.xy, power.yy, power.yz);
  const F32 z = column(power.xz, power.yz, power.zz);
  const F32 shortened = all(1.0f) / simd::sqrt(simd::max(x * x + y * y + z * z, all(1e-30f)));
  return {{x * shortened, y * shortened, z * shortened}, exists};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
