// shortshot/search/cell_box.hpp: the box of cells under a grid search, of bounded size whatever the cloud.
#ifndef SHORTSHOT_SEARCH_CELL_BOX_HPP
#define SHORTSHOT_SEARCH_CELL_BOX_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/point_lanes.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Smallest and largest coordinate along each axis.
struct Extent {
  float low[3];
  float high[3];
};

/// Extent of the valid points; returns how many there are.
[[nodiscard]] inline std::size_t measure(const CloudView& cloud, Extent& extent) noexcept {
  constexpr float most = 3.402823466e38f;
  if constexpr (simd::lanes == 1) {
    extent = {{most, most, most}, {-most, -most, -most}};
    std::size_t valid_points = 0;
    for_each_valid(cloud, [&](std::size_t, const Point& p) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float v = coordinate(p, axis);
        if (v < extent.low[axis]) extent.low[axis] = v;
        if (v > extent.high[axis]) extent.high[axis] = v;
      }
      ++valid_points;
    });
    return valid_points;
  }
  simd::F32 low[3] = {simd::all(most), simd::all(most), simd::all(most)};
  simd::F32 high[3] = {simd::all(-most), simd::all(-most), simd::all(-most)};
  simd::I32 valid_points{};
  for_each_valid_register(cloud, [&](std::size_t, const PointLanes& p, simd::Mask valid) {
    const simd::F32 v[3] = {p.x, p.y, p.z};
    unroll<3>([&](auto axis) {
      low[axis] = min(select(valid, v[axis], low[axis]), low[axis]);
      high[axis] = max(select(valid, v[axis], high[axis]), high[axis]);
    });
    valid_points = increment(valid, valid_points);
  });
  for (int axis = 0; axis < 3; ++axis) {
    extent.low[axis] = 0.0f - simd::largest(simd::all(0.0f) - low[axis]);
    extent.high[axis] = simd::largest(high[axis]);
  }
  return static_cast<std::uint32_t>(sum(valid_points));
}

/// First and last cell of a range, both inside the box.
struct CellRange {
  std::uint32_t first;
  std::uint32_t last;
};

/// Cubic cells, x fastest. Coordinates outside the box belong to its outermost cells: since that map never decreases,
/// a range of coordinates always maps to a range of cells, and no box is too small to be right.
struct GridBox {
  float low[3];
  float rounding[3];  ///< more than rounding can move a cell's edge, in meters
  float cell_size;
  float cells_per_meter;
  float last[3];  ///< dims - 1
  std::uint32_t dims[3];

  [[nodiscard]] std::uint32_t cell(int axis, float v) const noexcept {
    const float position = (v - low[axis]) * cells_per_meter;
    const float inside = position > 0.0f ? position : 0.0f;  // NaN, too
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(inside < last[axis] ? inside : last[axis]));
  }

  [[nodiscard]] CellRange range(int axis, float center, float reach) const noexcept {
    return {cell(axis, center - reach), cell(axis, center + reach)};
  }

  /// How far `v` is at least from the points of a cell; 0 in its own cell. Outermost cells have no outer edge, but it
  /// is always the edge towards v that counts.
  [[nodiscard]] float gap(int axis, float v, std::uint32_t other) const noexcept {
    const std::uint32_t own = cell(axis, v);
    if (other == own) return 0.0f;
    const float near_edge = low[axis] + unfused(static_cast<float>(other < own ? other + 1 : other) * cell_size);
    const float distance = (other < own ? v - near_edge : near_edge - v) - rounding[axis];
    return distance > 0.0f ? distance : 0.0f;
  }

  /// To be called before gap() and crosses().
  void note_rounding(const Extent& extent) noexcept {
    const auto magnitude = [](float v) { return v < 0.0f ? 0.0f - v : v; };
    for (int axis = 0; axis < 3; ++axis) {
      // A dozen roundings of numbers as large as the coordinates.
      rounding[axis] = 1e-6f * (magnitude(extent.low[axis]) + magnitude(extent.high[axis]));
    }
  }

  /// Does a sphere reach a row of cells? `half_chord` is half of what they can have in common.
  [[nodiscard]] bool crosses(const Point& center, std::uint32_t y, std::uint32_t z, float reach,
                             float& half_chord) const noexcept {
    const float gap_y = gap(1, center.y, y);
    const float gap_z = gap(2, center.z, z);
    const float squared = (unfused(reach * reach) - unfused(gap_y * gap_y)) - unfused(gap_z * gap_z);
    if (!(squared >= 0.0f)) return false;
    half_chord = simd::sqrt(squared);
    return true;
  }

  [[nodiscard]] std::size_t row(std::uint32_t y, std::uint32_t z) const noexcept {
    return (static_cast<std::size_t>(z) * dims[1] + y) * dims[0];
  }

  [[nodiscard]] std::size_t cell_of(const Point& p) const noexcept {
    return row(cell(1, p.y), cell(2, p.z)) + cell(0, p.x);
  }

  /// The cells of a register of points; those of points that are not valid mean nothing.
  [[nodiscard]] simd::I32 cells_of(const PointLanes& p) const noexcept {
    const auto along = [this](int axis, simd::F32 v) {
      const simd::F32 position = (v - simd::all(low[axis])) * simd::all(cells_per_meter);
      return truncate_to_int(min(max(position, simd::all(0.0f)), simd::all(last[axis])));
    };
    const auto stride = [this](int axis) { return simd::all_int(static_cast<std::int32_t>(dims[axis])); };
    return product(product(along(2, p.z), stride(1)) + along(1, p.y), stride(0)) + along(0, p.x);
  }

  /// Cells of half the size, over the same box.
  void halve_cells() noexcept {
    cell_size *= 0.5f;
    cells_per_meter *= 2.0f;
    for (int axis = 0; axis < 3; ++axis) {
      dims[axis] *= 2;
      last[axis] = static_cast<float>(dims[axis] - 1);
    }
  }

  [[nodiscard]] std::size_t cells() const noexcept { return static_cast<std::size_t>(dims[0]) * dims[1] * dims[2]; }
};

/// Cells along each axis for an extent of any size; false if together they would be more than `capacity`.
[[nodiscard]] inline bool count_cells(const Extent& extent, float cell_size, std::size_t capacity,
                                      std::uint32_t (&dims)[3]) noexcept {
  std::size_t room = capacity < 0x7FFFFFFFu ? capacity : 0x7FFFFFFFu;
  for (int axis = 0; axis < 3; ++axis) {
    const float cells = (extent.high[axis] - extent.low[axis]) / cell_size + 1.0f;
    if (!(cells < 8388608.0f)) return false;  // float counts them exactly, and twice as many
    dims[axis] = static_cast<std::uint32_t>(cells);
    room /= dims[axis];
    if (room == 0) return false;
  }
  return true;
}

/// Slices of an extent along some of its axes, and how many points lie in each: of 64 slices those at either end that
/// together hold at most 1 point in 128 can be cut off.
template <class Index>
class ThinEnds {
 public:
  static constexpr int slices = 64;

  /// Counts the valid points of a cloud along the axes from `first` on, as many as `counts` has room for; looks at all
  /// points.
  void count(const CloudView& cloud, const Extent& extent, std::size_t first, Index* counts,
             std::size_t room) noexcept {
    first_ = first;
    end_ = 3 * std::size_t{slices} <= room ? 3 : first + 1;
    counts_ = counts;
    simd::F32 low[3], width[3];
    for (std::size_t axis = first; axis < end_; ++axis) {
      width_[axis] = extent.high[axis] / slices - extent.low[axis] / slices;  // finite, whatever the extent
      low[axis] = simd::all(extent.low[axis]);
      width[axis] = simd::all(width_[axis] > 0.0f ? width_[axis] : 1.0f);
      for (int s = 0; s < slices; ++s) at(axis)[s] = 0;
    }
    for_each_valid_register(cloud, [&](std::size_t, const PointLanes& p, simd::Mask valid) {
      const simd::F32 v[3] = {p.x, p.y, p.z};
      const simd::Packing packing = simd::packing(valid);
      for (std::size_t axis = first_; axis < end_; ++axis) {
        const simd::F32 slice = (v[axis] - low[axis]) / width[axis];
        std::uint32_t slice_of[simd::lanes];
        simd::store(slice_of, truncate_to_int(min(max(slice, simd::all(0.0f)), simd::all(slices - 1.0f))), packing);
        for (std::uint32_t k = 0; k < packing.count; ++k) ++at(axis)[slice_of[k]];
      }
    });
  }

  [[nodiscard]] bool has_counted(std::size_t axis) const noexcept { return first_ <= axis && axis < end_; }

  /// Cuts thin ends off an axis that was counted. Returns whether that at least halved the extent, which is when
  /// another round is worth while.
  [[nodiscard]] bool cut(std::size_t valid, std::size_t axis, Extent& extent) const noexcept {
    const float width = width_[axis];
    if (!(width > 0.0f)) return false;
    const Index* const counts = at(axis);
    int first = 0;
    int last = slices - 1;
    std::size_t below = counts[first];
    std::size_t above = counts[last];
    for (; below <= valid / 128 && first < last; below += counts[first]) ++first;
    for (; above <= valid / 128 && first < last; above += counts[last]) --last;
    const float low = extent.low[axis];
    const auto begin_of = [&](int slice) {
      const float half = unfused(static_cast<float>(slice) * (0.5f * width));
      return (low + half) + half;
    };
    extent.low[axis] = begin_of(first);
    extent.high[axis] = begin_of(last + 1);
    return 2 * (last + 1 - first) <= slices;
  }

 private:
  [[nodiscard]] Index* at(std::size_t axis) const noexcept { return counts_ + (axis - first_) * slices; }

  Index* counts_ = nullptr;
  std::size_t first_ = 0, end_ = 0;  ///< axes
  float width_[3] = {};
};

/// Where the cells of an extent are more than `capacity`: cut thinly populated ends off it. `scratch` has as many
/// elements and is free to be written.
template <class Index>
inline void leave_outliers_out(const CloudView& cloud, std::size_t valid, float cell_size, Index* scratch,
                               std::size_t capacity, Extent& extent) noexcept {
  std::uint32_t dims[3];
  ThinEnds<Index> ends;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // A round divides the extent by up to 64: two dozen span all of float's range.
    for (int round = 0; round < 24 && capacity >= ThinEnds<Index>::slices; ++round) {
      if (count_cells(extent, cell_size, capacity, dims)) return;
      if (round > 0 || !ends.has_counted(axis)) ends.count(cloud, extent, axis, scratch, capacity);
      if (!ends.cut(valid, axis, extent)) break;
    }
  }
}

/// A box of at most `capacity` cells, which may become larger than `cell_size`.
inline void fit_box(const Extent& extent, float cell_size, std::size_t capacity, GridBox& box) noexcept {
  bool fits = false;
  for (; !(fits = count_cells(extent, cell_size, capacity, box.dims)) && cell_size < 1e37f; cell_size *= 1.25f) {
  }

  box.cell_size = cell_size;
  box.cells_per_meter = 1.0f / cell_size;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = extent.low[axis];
    if (!fits) box.dims[axis] = 1;  // an extent of all of float's range
    box.last[axis] = static_cast<float>(box.dims[axis] - 1);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_SEARCH_CELL_BOX_HPP
