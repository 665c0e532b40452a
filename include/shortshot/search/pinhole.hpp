// shortshot/search/pinhole.hpp: the camera that an organized cloud was taken with, fitted to its points.
#pragma once

#include <cstddef>

#include "../base/math.hpp"
#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../status.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// pixel = focal * (x / z) + center, for one direction of the image; no valid point is farther than `error` from it.
struct Projection {
  float focal;
  float center;
  float error;

  void widen(float slope, float pixel) noexcept {
    const float deviation = pixel - (extend::unfused(focal * slope) + center);
    const float magnitude = deviation < 0.0f ? 0.0f - deviation : deviation;
    if (!(magnitude <= error)) error = magnitude;
  }
};

/// Least squares of pixel over slope in float, by running means so that a million points do not wear it out. It need
/// not be exact: what the fit misses, the margin covers.
struct PinholeLine {
  float count, mean_slope, mean_pixel, variance, covariance;

  void add_to_mean(float slope, float pixel) noexcept {
    count += 1.0f;
    mean_slope += (slope - mean_slope) / count;
    mean_pixel += (pixel - mean_pixel) / count;
  }
  void add_to_slope(float slope, float pixel) noexcept {
    variance += extend::unfused((slope - mean_slope) * (slope - mean_slope));
    covariance += extend::unfused((slope - mean_slope) * (pixel - mean_pixel));
  }
  [[nodiscard]] bool is_finite() const noexcept {
    return extend::math::is_finite(mean_slope) && extend::math::is_finite({variance, mean_pixel, covariance});
  }
  [[nodiscard]] Projection projection() const noexcept {
    const float focal = variance > 0.0f ? covariance / variance : 0.0f;
    return {focal, mean_pixel - extend::unfused(focal * mean_slope), 0.0f};
  }
};

/// Is it an image, of at least one column? (Whatever the view says, nothing overflows.)
[[nodiscard]] inline bool is_image(const CloudView& cloud) noexcept {
  return cloud.height > 1 && cloud.width > 0 && cloud.size / cloud.width == cloud.height &&
         cloud.size % cloud.width == 0;
}

/// Calls add(column, row, x / z, y / z) for every `step`-th pixel whose point is valid and not in the camera's own
/// plane.
template <class Add>
inline void for_pixels(const CloudView& cloud, std::size_t step, Add add) noexcept {
  for (std::size_t i = 0; i < cloud.size; i += step) {
    const Point p = point(cloud, i);
    if (!is_finite(p) || p.z == 0.0f) continue;
    const std::size_t row = i / cloud.width;
    add(static_cast<float>(i - row * cloud.width), static_cast<float>(row), p.x / p.z, p.y / p.z);
  }
}

/// The camera of an image by every `step`-th point. not_organized: they deviate from every pinhole by more than a
/// quarter of the image.
[[nodiscard]] inline Status fit_pinhole(const CloudView& cloud, std::size_t step, Projection& columns,
                                        Projection& rows) noexcept {
  PinholeLine u_line{};
  PinholeLine v_line{};
  for_pixels(cloud, step, [&](float u, float v, float x, float y) {
    u_line.add_to_mean(x, u);
    v_line.add_to_mean(y, v);
  });
  if (!u_line.is_finite() || !v_line.is_finite()) return Status::not_organized;
  for_pixels(cloud, step, [&](float u, float v, float x, float y) {
    u_line.add_to_slope(x, u);
    v_line.add_to_slope(y, v);
  });
  if (!u_line.is_finite() || !v_line.is_finite()) return Status::not_organized;
  columns = u_line.projection();
  rows = v_line.projection();
  for_pixels(cloud, step, [&](float u, float v, float x, float y) {
    columns.widen(x, u);
    rows.widen(y, v);
  });
  const bool is_pinhole = columns.error <= 0.25f * static_cast<float>(cloud.width) &&
                          rows.error <= 0.25f * static_cast<float>(cloud.height);
  return is_pinhole ? Status::ok : Status::not_organized;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
