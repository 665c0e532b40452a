// shortshot/descriptor/exact_shells.hpp: distances that fall on the right side of a shell's border.
#pragma once

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../cloud/point_lanes.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Which of these distances (over the radius) are as close to the border or the middle of a shell as their rounding?
/// All of both are multiples of 1 / `borders`.
[[nodiscard]] SHORTSHOT_INLINE simd::Mask near_border(simd::F32 distance, float borders) noexcept {
  const simd::F32 position = distance * simd::all(borders);
  const simd::F32 nearest = simd::to_whole(position);
  return simd::all(1e-6f * borders) > simd::abs(position - nearest);
}

/// Distances over the radius. Points of a regular grid lie exactly on the borders of shells, where one bit decides
/// which neighboring shell gets a vote: there, and only there, they are computed with more bits than a float has.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 exact_distance(simd::F32 d2, const PointLanes& local, Radius radius,
                                                        float borders) noexcept {
  const simd::F32 inverse = simd::all(1.0f / radius.value);
  const simd::F32 distance = simd::sqrt(d2) * inverse;
  const simd::Mask near = near_border(distance, borders);
  if (any(near)) {
    const float splitter = math::length_splitter(radius.value);
    const simd::F32 exact = math::length(local.x, local.y, local.z, splitter) * inverse;
    // A frame that is not quite orthonormal must not move its neighbors from border to border.
    const simd::Mask same = simd::all(2e-6f) > simd::abs(exact - distance);
    return select(near & same, simd::min(exact, simd::all(1.0f)), distance);
  }
  return distance;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
