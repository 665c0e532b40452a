// shortshot/search/pinhole.hpp: the camera that an organized cloud was taken with, fitted to its points.
#pragma once

#include "../base/math.hpp"
#include "../base/unfused.hpp"
#include "../config.hpp"

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

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
