// shortshot/search/grid.hpp: the fixed-radius grid. Points are counting-sorted into cubic cells once per cloud; a query
// looks at runs of neighbouring cells. Ten times faster to build than a tree, faster to search, and of bounded memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../cloud.hpp"
#include "../config.hpp"
#include "../neighborhood.hpp"
#include "../simd.hpp"
#include "../status.hpp"
#include "grid_box.hpp"

namespace shortshot {

/// Memory of a GridIndex, borrowed from the caller: `point_capacity` elements of `order`, `cell_capacity` of
/// `cell_end`. `xyz`, if not null, has 3 * point_capacity floats and receives the sorted points' coordinates, all x,
/// then all y, then all z: runs of neighbours are then tested in lanes. Without it every point is read through the
/// view.
template <class Index>
struct GridMemory {
  Index* order;
  Index* cell_end;
  float* xyz;
  std::size_t point_capacity;
  std::size_t cell_capacity;
};

inline namespace SHORTSHOT_ISA {
namespace detail {

/// What a search reads of a grid's memory.
template <class Index>
struct GridContents {
  const Index* order;
  const Index* cell_end;
  const float* xyz;
};

/// What a grid knows besides its memory, which is handed to it at every call: an owner of both can be copied.
template <class Index>
class Grid {
 public:
  using Memory = GridMemory<Index>;
  using Contents = GridContents<Index>;

  [[nodiscard]] Status build(const CloudView& cloud, float cell_size, const Memory& memory) noexcept {
    *this = Grid{};
    cloud_ = cloud;
    status_ = index_points(cell_size, memory);
    return status_;
  }

  [[nodiscard]] Status status() const noexcept {
    return points_ == 0 && status_ == Status::ok ? Status::empty_cloud : status_;
  }
  [[nodiscard]] std::size_t cloud_size() const noexcept { return cloud_.size; }
  [[nodiscard]] std::size_t size() const noexcept { return points_; }

  [[nodiscard]] Status gather(const Contents& contents, const Point& center, Radius radius,
                              Neighborhood& out) const noexcept {
    clear(out);
    if (status() != Status::ok) return status();
    // The margin covers the rounding of d2: a point inside by d2 is never outside by one coordinate.
    const float reach = radius.value * 1.000001f;
    const CellRange x = box_.range(0, center.x, reach);
    const CellRange y = box_.range(1, center.y, reach);
    const CellRange z = box_.range(2, center.z, reach);
    for (std::uint32_t cz = z.first; cz <= z.last; ++cz) {
      for (std::uint32_t cy = y.first; cy <= y.last; ++cy) {
        const std::size_t row = box_.row(cy, cz);
        offer_run(contents, begin_of(contents, row + x.first), contents.cell_end[row + x.last], center, radius, out);
      }
    }
    return outcome(out);
  }

 private:
  [[nodiscard]] Status index_points(float cell_size, const Memory& memory) noexcept {
    const Status usable = check(cloud_);
    if (usable != Status::ok) return usable;
    if (check(Radius(cell_size)) != Status::ok) return Status::bad_radius;
    if (memory.cell_capacity == 0) return Status::out_of_memory;

    Extent extent;
    const std::size_t valid = measure(cloud_, extent);
    if (valid == 0) return Status::empty_cloud;
    constexpr std::size_t most = static_cast<Index>(~Index{0});
    if (valid > memory.point_capacity || valid > most || cloud_.size > most) return Status::out_of_memory;

    box_ = fit_box(cloud_, extent, valid, cell_size, memory.cell_end, memory.cell_capacity);
    points_ = valid;
    sort(memory);
    return Status::ok;
  }

  /// cell_end[c] is where cell c ends in `order`; it begins where the cell before it ends.
  [[nodiscard]] static std::size_t begin_of(const Contents& contents, std::size_t cell) noexcept {
    return cell == 0 ? 0 : contents.cell_end[cell - 1];
  }

  void offer_run(const Contents& contents, std::size_t begin, std::size_t end, const Point& center, Radius radius,
                 Neighborhood& out) const noexcept {
    std::size_t i = begin;
    if (contents.xyz == nullptr) {
      for (; i < end; ++i) offer(out, point(cloud_, contents.order[i]), contents.order[i], center, radius.squared);
      return;
    }
    const float* x = contents.xyz;
    const float* y = x + points_;
    const float* z = y + points_;
    for (; i + simd::lanes <= end; i += simd::lanes) {
      offer_lanes(out, x + i, y + i, z + i, contents.order + i, center, radius.squared);
    }
    for (; i < end; ++i) offer(out, {x[i], y[i], z[i]}, contents.order[i], center, radius.squared);
  }

  /// Counting sort: count per cell, turn counts into ends of the cells before, and let each placed point move its
  /// cell's end forward to where it belongs.
  void sort(const Memory& memory) noexcept {
    const std::size_t cells = box_.cells();
    for (std::size_t c = 0; c < cells; ++c) memory.cell_end[c] = 0;
    for_each_valid(cloud_, [&](std::size_t, const Point& p) { ++memory.cell_end[box_.cell_of(p)]; });
    Index begin = 0;
    for (std::size_t c = 0; c < cells; ++c) {
      const Index count = memory.cell_end[c];
      memory.cell_end[c] = begin;
      begin = static_cast<Index>(begin + count);
    }
    for_each_valid(cloud_, [&](std::size_t index, const Point& p) {
      const std::size_t place = memory.cell_end[box_.cell_of(p)]++;
      memory.order[place] = static_cast<Index>(index);
      if (memory.xyz == nullptr) return;
      memory.xyz[place] = p.x;
      memory.xyz[points_ + place] = p.y;
      memory.xyz[2 * points_ + place] = p.z;
    });
  }

  CloudView cloud_;
  GridBox box_;
  std::size_t points_;
  Status status_;
};

}  // namespace detail

/// The index itself, in memory that somebody else owns; a search (see brute.hpp for the concept). Trivial type: build()
/// before the first gather(). The cloud and the memory must outlive it. `Index` may be uint16_t for clouds of up to
/// 65,535 points, invalid ones included.
template <class Index = std::uint32_t>
class GridIndex {
  static_assert(std::is_same<Index, std::uint16_t>::value || std::is_same<Index, std::uint32_t>::value,
                "GridIndex<Index> supports uint16_t and uint32_t");

 public:
  /// Sort the cloud's valid points into cells of `cell_size` metres; best close to the search radius, or half of it for
  /// a thousand neighbours and more. Where the cells would not fit the memory (clouds of huge extent, far outliers) the
  /// outliers are put into the outermost cells and, if that is not enough, cells become larger: any cell size gives
  /// the same neighbours, only slower.
  ///
  /// Statuses: empty_cloud, bad_view, bad_radius (the cell size), out_of_memory (more valid points than
  /// point_capacity, points with indices beyond Index, or no cell). O(points + cells); allocates nothing.
  [[nodiscard]] Status build(const CloudView& cloud, float cell_size, const GridMemory<Index>& memory) noexcept {
    memory_ = memory;
    return grid_.build(cloud, cell_size, memory);
  }

  /// What the last build() returned; empty_cloud before the first one (in memory that started as zeros).
  [[nodiscard]] Status status() const noexcept { return grid_.status(); }
  [[nodiscard]] std::size_t cloud_size() const noexcept { return grid_.cloud_size(); }

  /// Number of points in the index: the cloud's valid ones.
  [[nodiscard]] std::size_t size() const noexcept { return grid_.size(); }

  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighborhood& out) const noexcept {
    return grid_.gather({memory_.order, memory_.cell_end, memory_.xyz}, center, radius, out);
  }

 private:
  detail::Grid<Index> grid_;
  GridMemory<Index> memory_;
};

/// A GridIndex with its memory inside, for clouds of up to `MaxPoints` valid points: a static or a member, no heap.
/// 2 bytes a point and 2 a cell up to 65,535 points, else 4 (the cloud's indices must fit those bytes, too). Trivial
/// type: build() before the first gather().
template <std::size_t MaxPoints, std::size_t MaxCells>
class StaticGrid {
  static_assert(MaxPoints >= 1 && MaxCells >= 1, "StaticGrid<MaxPoints, MaxCells> supports one or more of both");

 public:
  using Index = std::conditional_t<(MaxPoints <= 65535), std::uint16_t, std::uint32_t>;

  /// See GridIndex::build().
  [[nodiscard]] Status build(const CloudView& cloud, float cell_size) noexcept {
    return grid_.build(cloud, cell_size, {order_, cell_end_, nullptr, MaxPoints, MaxCells});
  }

  [[nodiscard]] Status status() const noexcept { return grid_.status(); }
  [[nodiscard]] std::size_t cloud_size() const noexcept { return grid_.cloud_size(); }

  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighborhood& out) const noexcept {
    return grid_.gather({order_, cell_end_, nullptr}, center, radius, out);
  }

 private:
  detail::Grid<Index> grid_;
  Index order_[MaxPoints];
  Index cell_end_[MaxCells];
};

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
