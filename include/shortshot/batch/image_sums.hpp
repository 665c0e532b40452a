// shortshot/batch/image_sums.hpp: sums over any window of a depth image, at the same cost for all sizes. Hosted only:
// allocates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/point_lanes.hpp"
#include "../config.hpp"
#include "image_geometry.hpp"
#include "pixel_sums.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A window's first and past its last column and row.
struct Window {
  std::size_t left, right, top, bottom;
};

/// A pixel's point in whole numbers.
struct WholePoint {
  std::int32_t x, y, z;
};

/// The whole numbers that a radius counts for: what is lost in rounding means nothing next to any camera's noise.
inline constexpr std::int32_t steps_of_radius = 32;

/// Points in these steps. Those that float does not hold as finely are none, and those in the camera's own plane: many
/// drivers write (0, 0, 0) for "no measurement".
[[nodiscard, gnu::always_inline]] inline PixelLanes in_steps(const ValidLanes& p, simd::F32 scale) noexcept {
  const simd::F32 x = p.points.x * scale;
  const simd::F32 y = p.points.y * scale;
  const simd::F32 z = p.points.z * scale;
  const simd::F32 most = simd::all(4194303.0f);  // what to_whole() can take
  const simd::Mask usable = p.valid & (p.points.z != simd::all(0.0f)) &
                            (simd::max(simd::max(simd::abs(x), simd::abs(y)), simd::abs(z)) < most);
  return {usable, to_whole(keep(usable, x)), to_whole(keep(usable, y)), to_whole(keep(usable, z))};
}

/// Do the points of a part of a window lie within the radius of the window's middle, by root mean square? Where the
/// part has an edge itself, half of the squares must do.
struct Nearness {
  std::uint32_t x, y, z, squares;  ///< of the middle

  [[nodiscard, gnu::always_inline]] bool holds(const PixelSums& part) const noexcept {
    const WrappingQuad& places = part.places;
    const std::uint32_t count = places[0];
    const std::uint32_t along = places[1] * x + places[2] * y + places[3] * z;
    const std::uint32_t distances = part.others[3] + count * squares - 2 * along;
    // Squares of points very far from the middle wrap; but then their mean depth is far from its, too.
    const std::uint32_t within = count * static_cast<std::uint32_t>(steps_of_radius);
    const std::uint32_t limit = within * static_cast<std::uint32_t>(steps_of_radius);
    return distances <= (has_edges(part) ? limit / 2 : limit) && places[3] - count * z + within <= 2 * within;
  }
};

/// Rows of sums over all pixels above and to the left of a pixel, in a ring.
struct SummedRows {
  const PixelSums* rows;
  std::size_t last_slot;
  std::size_t stride;

  [[nodiscard, gnu::always_inline]] PixelSums over(const Window& w) const noexcept {
    const PixelSums* const top = row(w.top);
    const PixelSums* const bottom = row(w.bottom);
    return (bottom[w.right] - bottom[w.left]) - (top[w.right] - top[w.left]);
  }

  /// Over those of nine parts of a window that are near its middle: where there are edges, on this side of them.
  [[nodiscard]] PixelSums over_near_parts(const Window& window, const Window& middle,
                                          const WholePoint& center) const noexcept {
    const std::uint32_t x = static_cast<std::uint32_t>(center.x);
    const std::uint32_t y = static_cast<std::uint32_t>(center.y);
    const std::uint32_t z = static_cast<std::uint32_t>(center.z);
    const Nearness near{x, y, z, x * x + y * y + z * z};
    const std::size_t bounds[4] = {window.top, middle.top, middle.bottom, window.bottom};
    PixelSums sums{};
    for (std::size_t r = 0; r < 3; ++r) {
      const PixelSums* const top = row(bounds[r]);
      const PixelSums* const bottom = row(bounds[r + 1]);
      PixelSums left = bottom[window.left] - top[window.left];
      const auto add_part = [&](std::size_t end) SHORTSHOT_INLINE_LAMBDA {
        const PixelSums right = bottom[end] - top[end];
        const PixelSums part = right - left;
        if (near.holds(part)) sums = sums + part;
        left = right;
      };
      add_part(middle.left);
      add_part(middle.right);
      add_part(window.right);
    }
    return sums;
  }

 private:
  [[nodiscard, gnu::always_inline]] const PixelSums* row(std::size_t r) const noexcept {
    return rows + (r & last_slot) * stride;
  }
};

/// Sums over all pixels above and to the left of each pixel, for as many rows as the highest window has; rows are added
/// as the windows move down. Several of them may work on bands of one image: any window has the same sums in each.
class ImageSums {
 public:
  /// Room for an image of so many columns: 48 bytes for each pixel of 64 rows, if it has not had it before.
  void reserve(std::size_t columns) {
    const std::size_t most = stride_of(columns);
    rows_.resize(std::max(rows_.size(), most_slots * most));
    for (std::vector<float>* depths : {&depths_, &depths_above_}) depths->resize(std::max(depths->size(), most));
  }

  /// For windows of rows from `first` on, which reach `reach` rows beyond their middle; `slope` is that of
  /// ImageGeometry. There must be room.
  void begin(const CloudView& cloud, float scale, float slope, std::size_t first, std::size_t reach) noexcept {
    cloud_ = cloud;
    scale_ = scale;
    slope_ = slope;
    stride_ = stride_of(cloud.width);
    slots_ = 4;
    while (slots_ < 2 * reach + 2) slots_ *= 2;
    next_ = first > reach ? first - reach : 0;
    if (next_ > 0) {
      --next_;
      add_row(false);
    }
    std::fill_n(row(next_), stride_, PixelSums{});
  }

  /// Makes sure that all rows above `end` are there.
  void add_rows(std::size_t end) noexcept {
    while (next_ < end) add_row(true);
  }

  [[nodiscard, gnu::always_inline]] SummedRows rows() const noexcept { return {rows_.data(), slots_ - 1, stride_}; }

 private:
  static constexpr std::size_t most_slots = 64;
  static_assert(most_slots >= 2 * widest_window + 2, "the highest window");
  static constexpr float no_depth = 1e9f;  // of rows without a point: an edge to all others

  /// Whole registers, and what is before the first column.
  [[nodiscard]] static std::size_t stride_of(std::size_t columns) noexcept {
    return (columns + simd::lanes - 1) / simd::lanes * simd::lanes + 1;
  }

  [[nodiscard]] PixelSums* row(std::size_t r) noexcept { return rows_.data() + (r & (slots_ - 1)) * stride_; }

  [[nodiscard]] PixelLanes read_register(std::size_t column) const noexcept {
    const std::size_t left = std::min(simd::lanes, cloud_.width - column);
    return in_steps(read_valid(cloud_.points, next_ * cloud_.width + column, left), simd::all(scale_));
  }

  /// The depth that a hole at the row's beginning has: the first one that there is.
  [[nodiscard]] float first_depth() const noexcept {
    for (std::size_t column = 0; column < cloud_.width; column += simd::lanes) {
      const PixelLanes p = read_register(column);
      if (!any(p.valid)) continue;
      float z[simd::lanes];
      store(z, p.z);
      for (const float depth : z) {
        if (depth != 0.0f) return depth;
      }
    }
    return no_depth;
  }

  /// Depths of a register, and those of holes: what is to the left of them.
  [[nodiscard]] static simd::F32 without_holes(const PixelLanes& p, float& last) noexcept {
    float z[simd::lanes];
    store(z, p.z);
    if (!every(p.valid)) {
      float valid[simd::lanes];
      store(valid, keep(p.valid, simd::all(1.0f)));
      for (std::size_t lane = 0; lane < simd::lanes; ++lane) {
        if (valid[lane] == 0.0f) z[lane] = lane == 0 ? last : z[lane - 1];
      }
    }
    last = z[simd::lanes - 1];
    return simd::load(z);
  }

  /// The next row of the image; only its depths, if `with_sums` is false. An edge is where the depth differs from that
  /// to the left or that above by more than the radius and more than any slope does, holes filled with what is to the
  /// left.
  void add_row(bool with_sums) noexcept {
    std::swap(depths_, depths_above_);
    float last = first_depth();
    depths_[0] = last;
    const bool is_first = next_ == 0;
    const PixelSums* above = row(next_) + 1;
    PixelSums* to = row(next_ + 1);
    *to++ = PixelSums{};
    PixelSums sums{};
    for (std::size_t column = 0; column < cloud_.width; column += simd::lanes) {
      const PixelLanes p = read_register(column);
      const simd::F32 depth = without_holes(p, last);
      simd::store(depths_.data() + column + 1, depth);
      if (!with_sums) continue;
      const simd::F32 over = is_first ? depth : simd::load(depths_above_.data() + column + 1);
      const simd::F32 beside = simd::load(depths_.data() + column);
      PixelSums terms[simd::lanes];
      const simd::F32 step =
          simd::max(simd::abs(depth) * simd::all(slope_), simd::all(static_cast<float>(steps_of_radius)));
      terms_of(p, simd::max(simd::abs(depth - beside), simd::abs(depth - over)) > step, terms);
      unroll<lane_count>([&](auto lane) SHORTSHOT_INLINE_LAMBDA {
        sums = sums + terms[lane];
        *to++ = sums + *above++;
      });
    }
    ++next_;
  }

  CloudView cloud_{};
  float scale_ = 0.0f;
  float slope_ = 0.0f;               // the steepest one, as a share of the depth from pixel to pixel
  std::vector<PixelSums> rows_;      // a ring
  std::vector<float> depths_;        // of the last row: one before the first column, then all
  std::vector<float> depths_above_;  // of the one before
  std::size_t stride_ = 0;
  std::size_t slots_ = 0;
  std::size_t next_ = 0;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
