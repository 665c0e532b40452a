// shortshot/batch/image_geometry.hpp: how many pixels of a depth image a radius in meters spans. Hosted only.
#pragma once

#include <cstddef>

#include "../base/simd.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/point_lanes.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../search/pinhole.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Windows reach from 1 pixel to so many beyond their middle. No sum over a window leaves 32 bits then: coordinates
/// are in 32nds of the radius, and those of pixels side by side differ by a radius at most, or there is an edge.
inline constexpr std::size_t widest_window = 29;

/// Of an image whose camera is fitted to its points.
struct ImageGeometry {
  float columns;  ///< of half a window, times the depth
  float rows;
  float slope;    ///< how much the depth of the steepest surface changes from pixel to pixel, as a share of it
  float nearest;  ///< of all depths

  /// How many pixels a window reaches beyond its middle: squares with the second moments of a disc of the radius. A
  /// square of 2 h + 1 pixels has h (h + 1) / 3, a disc a quarter of the square of its own.
  [[nodiscard]] static simd::F32 half_of_window(float extent, simd::F32 depth) noexcept {
    const simd::F32 half = simd::all(extent) / depth - simd::all(0.5f);
    const simd::F32 bounded = simd::max(simd::min(half, simd::all(static_cast<float>(widest_window))), simd::all(1.0f));
    return simd::to_whole(bounded);
  }

  [[nodiscard]] std::size_t most_rows() const noexcept {
    return static_cast<std::size_t>(simd::largest(half_of_window(rows, simd::all(nearest))));
  }
};

/// empty_cloud; not_organized: not an image, or not a pinhole camera's, which is looked for in some thousand of the
/// points.
[[nodiscard]] inline Status measure_image(const CloudView& cloud, Radius radius, ImageGeometry& geometry) noexcept {
  if (!is_image(cloud) || cloud.width < 2) return Status::not_organized;
  simd::F32 farthest = simd::all(0.0f);
  simd::F32 behind = simd::all(0.0f);
  simd::F32 nearest = simd::all(3e38f);
  for_each_valid_register(cloud, [&](std::size_t, const PointLanes& p, simd::Mask) {
    farthest = simd::max(farthest, p.z);
    behind = simd::max(behind, simd::all(0.0f) - p.z);
    nearest = simd::min(nearest, select(p.z != simd::all(0.0f), simd::abs(p.z), simd::all(3e38f)));
  });
  const bool in_front = simd::largest(farthest) > 0.0f;
  const bool at_back = simd::largest(behind) > 0.0f;
  if (!in_front && !at_back) return Status::empty_cloud;
  if (in_front && at_back) return Status::not_organized;

  constexpr std::size_t most_looked_at = 4096;
  const std::size_t step = cloud.size / most_looked_at | 1;  // odd: it meets all columns of most widths
  Projection columns{};
  Projection rows{};
  Status status = fit_pinhole(cloud, step, columns, rows);
  if (!(columns.focal * rows.focal != 0.0f)) status = fit_pinhole(cloud, 1, columns, rows);
  if (status != Status::ok) return status;
  constexpr float half_of_square = 0.8660254f;  // of a disc's radius
  constexpr float steepest = 8.0f;              // 83 degrees: noise and steps of the depth look steep, too
  const float reach = radius.value * half_of_square;
  const float focal[2] = {__builtin_fabsf(columns.focal), __builtin_fabsf(rows.focal)};
  const float shorter = focal[0] < focal[1] ? focal[0] : focal[1];
  geometry = {reach * focal[0], reach * focal[1], shorter > steepest ? steepest / shorter : 1.0f,
              0.0f - simd::largest(simd::all(0.0f) - nearest)};
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
