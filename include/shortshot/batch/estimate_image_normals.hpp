// shortshot/batch/estimate_image_normals.hpp: the surface normals of a depth image, fast. Hosted only: allocates,
// starts threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "../base/simd.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/point_lanes.hpp"
#include "../config.hpp"
#include "../frame/normal.hpp"
#include "../frame/viewpoint.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "executor.hpp"
#include "image_geometry.hpp"
#include "image_sums.hpp"
#include "pixel_sums.hpp"
#include "plane_of_sums.hpp"
#include "plausible.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Fewest rows that a thread takes: it sums up those above and below them, too.
inline constexpr std::size_t rows_of_band = 32;

/// What an image is asked for.
struct ImageTask {
  CloudView cloud;
  Radius radius;
  Viewpoint viewpoint;
  ImageGeometry geometry;
  const std::uint8_t* needed;  // one per point; null: all are
};

/// Normals of rows of an image, on one thread.
class ImageBand {
 public:
  void reserve(std::size_t columns) { sums_.reserve(columns); }

  /// Of rows [begin, end). There must be room for the image's columns.
  void estimate(const ImageTask& task, std::size_t begin, std::size_t end, SurfaceNormal* normals) noexcept {
    scale_ = static_cast<float>(steps_of_radius) / task.radius.value;
    const std::size_t reach = task.geometry.most_rows();
    sums_.begin(task.cloud, scale_, task.geometry.slope, begin, reach);
    for (std::size_t row = begin; row < end; ++row) {
      sums_.add_rows(std::min(task.cloud.height, row + reach + 1));
      for (std::size_t column = 0; column < task.cloud.width; column += simd::lanes) {
        estimate_register(task, row, column, normals + row * task.cloud.width + column);
      }
    }
  }

 private:
  /// Columns or rows of the windows around a register of pixels: the first, past the last, and how many they reach
  /// beyond the middle.
  struct Spans {
    std::uint32_t first[simd::lanes], end[simd::lanes], half[simd::lanes];
  };

  /// Those of holes are empty.
  [[nodiscard, gnu::always_inline]] static Spans spans(simd::F32 middle, simd::F32 half, std::size_t size,
                                                       simd::Mask valid) noexcept {
    Spans result;
    const simd::F32 first = simd::max(middle - half, simd::all(0.0f));
    const simd::F32 end = simd::min(middle + half + simd::all(1.0f), simd::all(static_cast<float>(size)));
    simd::store(result.first, round_to_int(first));
    simd::store(result.end, round_to_int(select(valid, end, first)));
    simd::store(result.half, round_to_int(half));
    return result;
  }

  void estimate_register(const ImageTask& task, std::size_t row, std::size_t column,
                         SurfaceNormal* normals) const noexcept {
    const CloudView& cloud = task.cloud;
    const std::size_t count = std::min(simd::lanes, cloud.width - column);
    const std::size_t first = row * cloud.width + column;
    const ValidLanes read = read_valid(cloud.points, first, count);
    const PixelLanes pixels = in_steps(read, simd::all(scale_));
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    if (!any(pixels.valid) || !is_needed(task, first, count)) {
      std::fill_n(normals, count, SurfaceNormal{none, none, none});
      return;
    }
    const SumLanes sums = sums_of_windows(task, row, column, pixels, simd::abs(read.points.z));
    const WrappingLanes center[3] = {wrapping(pixels.x), wrapping(pixels.y), wrapping(pixels.z)};
    const DirectionLanes least = least_scatter(scatter_of(sums, center), to_float(same_bits<simd::I32>(sums.of[0])));
    const PointLanes found = turned(least, pixels.valid, directions(task.viewpoint, read.points));
    if (count == simd::lanes) {
      store(normals, found);
    } else {
      SurfaceNormal few[simd::lanes];
      store(few, found);
      std::copy_n(few, count, normals);
    }
  }

  /// Towards the viewpoint; NaN where there is none.
  [[nodiscard, gnu::always_inline]] static PointLanes turned(const DirectionLanes& found, simd::Mask valid,
                                                             const PointLanes& towards) noexcept {
    const PointLanes& n = found.direction;
    const simd::F32 none = simd::all(std::numeric_limits<float>::quiet_NaN());
    const simd::Mask exists = found.exists & valid;
    const simd::Mask away = (n.x * towards.x + n.z * towards.z) + n.y * towards.y < simd::all(0.0f);
    const auto component = [&](simd::F32 v) {
      return select(exists, negate(away, v) + simd::all(0.0f), none);  // no negative zeros
    };
    return {component(n.x), component(n.y), component(n.z)};
  }

  [[nodiscard]] static bool is_needed(const ImageTask& task, std::size_t first, std::size_t count) noexcept {
    if (task.needed == nullptr) return true;
    const std::uint8_t* const marks = task.needed + first;
    return std::any_of(marks, marks + count, [](std::uint8_t mark) { return mark != 0; });
  }

  [[nodiscard, gnu::always_inline]] SumLanes sums_of_windows(const ImageTask& task, std::size_t row, std::size_t column,
                                                             const PixelLanes& pixels, simd::F32 depth) const noexcept {
    const ImageGeometry& geometry = task.geometry;
    const simd::F32 safe = select(pixels.valid, depth, simd::all(1.0f));
    const simd::F32 number = simd::from_lanes([](std::size_t lane) { return static_cast<float>(lane); });
    const Spans columns = spans(simd::all(static_cast<float>(column)) + number,
                                geometry.half_of_window(geometry.columns, safe), task.cloud.width, pixels.valid);
    const Spans rows = spans(simd::all(static_cast<float>(row)), geometry.half_of_window(geometry.rows, safe),
                             task.cloud.height, pixels.valid);
    const SummedRows summed = sums_.rows();
    PixelSums sums[simd::lanes];
    unroll<lane_count>([&](auto lane) SHORTSHOT_INLINE_LAMBDA {
      const Window window{columns.first[lane], columns.end[lane], rows.first[lane], rows.end[lane]};
      sums[lane] = summed.over(window);
      if (has_edges(sums[lane])) {
        sums[lane] = near_parts(window, column + static_cast<std::size_t>(lane), columns.half[lane], row,
                                rows.half[lane], pixels, lane);
      }
    });
    return lanes_of<simd::lanes>(sums);
  }

  [[nodiscard, gnu::noinline]] PixelSums near_parts(const Window& window, std::size_t column, std::size_t half_columns,
                                                    std::size_t row, std::size_t half_rows, const PixelLanes& pixels,
                                                    int lane) const noexcept {
    const std::size_t across = (2 * half_columns + 1) / 6;  // half of a third
    const std::size_t along = (2 * half_rows + 1) / 6;
    const Window middle{std::max(window.left, column - std::min(column, across)),
                        std::min(window.right, column + across + 1), std::max(window.top, row - std::min(row, along)),
                        std::min(window.bottom, row + along + 1)};
    std::int32_t at[3][simd::lanes];
    simd::store(at[0], round_to_int(pixels.x));
    simd::store(at[1], round_to_int(pixels.y));
    simd::store(at[2], round_to_int(pixels.z));
    return sums_.rows().over_near_parts(window, middle, {at[0][lane], at[1][lane], at[2][lane]});
  }

  ImageSums sums_;
  float scale_ = 0.0f;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Estimates the normals of depth image after depth image, and owns the scratch memory that this takes.
///
/// For each thread 48 bytes a pixel of 64 rows, and the normals; with the same estimator and vector again, nothing,
/// until an image is wider than those before it, or more threads work. Starting threads, however, costs small
/// allocations of the C++ runtime's in every call; an executor has none.
class ImageNormalEstimator {
 public:
  /// See the function estimate_image_normals() below.
  template <class Threads = unsigned>
  [[nodiscard]] Status estimate(const CloudView& cloud, Radius radius, const Viewpoint& viewpoint,
                                std::vector<SurfaceNormal>& normals, Threads&& threads = 1u) {
    return estimate_needed(cloud, radius, viewpoint, nullptr, normals, threads);
  }

  /// The same where normals are needed: `needed` has a number for each point (see mark_neighbors()), and points where
  /// it is 0 may get NaN. sizes_differ if there are not as many.
  template <class Threads = unsigned>
  [[nodiscard]] Status estimate(const CloudView& cloud, Radius radius, const Viewpoint& viewpoint,
                                const std::vector<std::uint8_t>& needed, std::vector<SurfaceNormal>& normals,
                                Threads&& threads = 1u) {
    if (validate(cloud) == Status::ok && needed.size() != cloud.size) {
      normals.clear();
      return Status::sizes_differ;
    }
    return estimate_needed(cloud, radius, viewpoint, needed.data(), normals, threads);
  }

 private:
  template <class Threads>
  [[nodiscard]] Status estimate_needed(const CloudView& cloud, Radius radius, const Viewpoint& viewpoint,
                                       const std::uint8_t* needed, std::vector<SurfaceNormal>& normals,
                                       Threads& threads) {
    normals.clear();
    detail::ImageTask task{cloud, radius, viewpoint, {}, needed};
    Status status = validate(cloud);
    if (status == Status::ok) status = validate(radius);
    if (status == Status::ok) status = validate(viewpoint);
    if (status == Status::ok) status = detail::measure_image(cloud, radius, task.geometry);
    if (status == Status::ok && detail::all_are_coarse(cloud, radius)) status = Status::coarse_coordinates;
    if (status != Status::ok) return status;

    auto&& executor = detail::executor_of(threads, (cloud.height + detail::rows_of_band - 1) / detail::rows_of_band);
    const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
    if (bands_.size() < team) bands_.resize(team);
    for (std::size_t t = 0; t < team; ++t) bands_[t].reserve(cloud.width);  // whichever thread gets work this time
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    normals.assign(cloud.size, {none, none, none});  // and so they stay where an executor throws before their turn
    const std::size_t rows = std::max(detail::rows_of_band, (cloud.height + team - 1) / team);
    detail::for_blocks(executor, team, cloud.height, rows, [&](std::size_t thread, std::size_t begin, std::size_t end) {
      bands_[thread].estimate(task, begin, end, normals.data());
    });
    return Status::ok;
  }

  std::vector<detail::ImageBand> bands_;  // one per thread
};

/// The surface normal at each point of a depth image, at a cost that does not depend on how many neighbors it has: of a
/// frame of 640 x 480, within 1 cm, a tenth of estimate_normals()' instructions, and no index. Not the same normals,
/// but near them, 1 to 2 degrees on surfaces: bench/RESULTS.md says how near, by depth and by distance from an edge.
///
/// A normal is that of the plane through the points of a square window, whose sums come from running sums over the
/// image, of points rounded to a 32nd of the radius. The window has the second moments of a disc of the radius that
/// faces the camera at the point's depth, and at most 59 x 59 pixels. Where it has an edge (depths side by side, or
/// across a hole, that differ by more than the radius and more than on any slope up to 83 degrees), those of its nine
/// parts count whose points lie within the radius of the middle by root mean square; half of the square, if the part
/// has an edge.
///
/// `cloud`      an image (width and height) that a pinhole camera took, in its own coordinates: z is the depth. Points
///              that are not finite, or whose z is 0, are holes
/// `radius`     what estimate_normals() would be given, in meters
/// `viewpoint`  to which side of the surface normals point, as in estimate_normals()
/// `normals`    one per point, all three components NaN where the point is a hole or has no normal: fewer than three
///              points in the window, or all of them on a line within a 32nd of the radius
/// `threads`    how many threads share the work, or an executor (see extract()); the result is the same, bit for bit,
///              for any number
///
/// Statuses: empty_cloud, bad_view, bad_radius, bad_viewpoint (not finite), not_organized (height 1, width * height is
/// not the size, points in front of and behind the camera, or points that deviate from every pinhole by more than a
/// quarter of the image, as after moving the cloud into another coordinate system), coarse_coordinates (as in
/// estimate_normals()); `normals` is empty then. Allocates what ImageNormalEstimator does, anew in every call. May
/// throw what extract() may.
template <class Threads = unsigned>
[[nodiscard]] Status estimate_image_normals(const CloudView& cloud, Radius radius, const Viewpoint& viewpoint,
                                            std::vector<SurfaceNormal>& normals, Threads&& threads = 1u) {
  return ImageNormalEstimator().estimate(cloud, radius, viewpoint, normals, threads);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
