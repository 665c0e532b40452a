// shortshot/search/organized.hpp: neighbors in a window of the depth image. No index at all: for organized clouds on
// targets that cannot spare one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../base/math.hpp"
#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "neighborhood.hpp"
#include "offer.hpp"
#include "pinhole.hpp"
#include "radius.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// First and last pixel of a window.
struct PixelRange {
  std::size_t first;
  std::size_t last;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Search of an organized cloud by projecting the support sphere into the image; a search (see search.hpp). The camera
/// need not be known: build() fits a pinhole to the cloud and keeps the largest deviation as the window's margin, so
/// that the neighbors are exactly those of every other search. Trivial type; the cloud must outlive it.
class OrganizedSearch {
 public:
  /// Statuses: empty_cloud, bad_view, not_organized (height 1, width * height != size, points in front of and behind
  /// the camera, or points that deviate from every pinhole by more than a quarter of the image, as after moving the
  /// cloud into another coordinate system). O(points); allocates nothing.
  [[nodiscard]] Status build(const CloudView& cloud) noexcept {
    *this = OrganizedSearch{};
    cloud_ = cloud;
    status_ = fit();
    return status_;
  }

  /// What the last build() returned; empty_cloud before the first one (in memory that started as zeros).
  [[nodiscard]] Status status() const noexcept { return cloud_.size == 0 ? Status::empty_cloud : status_; }

  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return cloud_.size; }

  /// The points of the cloud within `radius` of `center`, into an empty neighborhood `out`: ok, too_many_neighbors, or
  /// status(). Allocates nothing; reentrant.
  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    extend::clear(out, center);
    if (status() != Status::ok) return status();
    if (!shortshot::is_finite(center)) return Status::ok;
    const float reach = extend::unfused(radius.value * 1.000001f);  // covers the rounding of d2
    const detail::PixelRange columns = window(columns_, center.x, center.z, reach, cloud_.width);
    const detail::PixelRange rows = window(rows_, center.y, center.z, reach, cloud_.height);
    for (std::size_t v = rows.first; v < rows.last; ++v) {
      for (std::size_t u = columns.first; u < columns.last; ++u) {
        const std::size_t i = v * cloud_.width + u;
        extend::offer(out, point(cloud_, i), static_cast<std::uint32_t>(i), center, radius.squared);
      }
    }
    return extend::outcome(out);
  }

 private:
  /// Pixels (first, one past last) that the cube around the sphere projects to; all of them if it reaches the camera.
  [[nodiscard]] static detail::PixelRange window(const detail::Projection& p, float center, float z, float reach,
                                                 std::size_t pixels) noexcept {
    const float near = z - reach;
    const float far = z + reach;
    if (!(near * far > 0.0f)) return {0, pixels};
    const float corners[4] = {(center - reach) / near, (center - reach) / far, (center + reach) / near,
                              (center + reach) / far};
    float low = extend::unfused(p.focal * corners[0]) + p.center;
    float high = low;
    for (const float corner : corners) {
      const float pixel = extend::unfused(p.focal * corner) + p.center;
      low = pixel < low ? pixel : low;
      high = pixel > high ? pixel : high;
    }
    // NaN, where there is no slope and a corner lies beyond float's range, leaves nobody out.
    const float first = low - p.error - 1.0f;
    const float last = high + p.error + 2.0f;
    const auto end = static_cast<float>(pixels);
    return {!(first > 0.0f) ? 0
            : first < end   ? static_cast<std::size_t>(first)
                            : pixels,
            !(last < end) ? pixels
            : last > 0.0f ? static_cast<std::size_t>(last)
                          : 0};
  }

  [[nodiscard]] Status fit() noexcept {
    const Status usable = validate(cloud_);
    if (usable != Status::ok) return usable;
    if (!detail::is_image(cloud_) || cloud_.width < 2) return Status::not_organized;
    bool front = false;
    bool behind = false;
    bool nowhere = false;  // in the camera's own plane: in no pixel
    extend::for_each_valid(cloud_, [&](std::size_t, const Point& p) {
      front = front || p.z > 0.0f;
      behind = behind || p.z < 0.0f;
      nowhere = nowhere || p.z == 0.0f;
    });
    if (!front && !behind && !nowhere) return Status::empty_cloud;
    if ((front && behind) || nowhere) return Status::not_organized;
    return detail::fit_pinhole(cloud_, 1, columns_, rows_);
  }

  CloudView cloud_;
  Status status_;
  detail::Projection columns_;
  detail::Projection rows_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
