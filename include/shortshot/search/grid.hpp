// shortshot/search/grid.hpp: the fixed-radius grid. Points are counting-sorted into cubic cells once per cloud; a query
// looks at runs of neighbouring cells. Ten times faster to build than a tree, faster to search, and of bounded memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "../cloud.hpp"
#include "../config.hpp"
#include "../neighborhood.hpp"
#include "../rounded.hpp"
#include "../simd.hpp"
#include "../status.hpp"
#include "grid_box.hpp"
#include "offer_run.hpp"

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
    const Status status = plan(cloud, cell_size, memory);
    if (status == Status::ok) sort(memory);
    return status;
  }

  /// The first half of build(): settles the box of cells. Of the memory only cell_end is touched.
  [[nodiscard]] Status plan(const CloudView& cloud, float cell_size, const Memory& memory) noexcept {
    *this = Grid{};
    cloud_ = cloud;
    status_ = fit(cell_size, memory);
    return status_;
  }

  /// Between the halves: eight cells for each one.
  void halve_cells() noexcept { box_.halve_cells(); }

  /// The second half, a counting sort: count per cell, turn counts into ends of the cells before, and let each placed
  /// point move its cell's end forward to where it belongs.
  void sort(const Memory& memory) const noexcept {
    const Memory to = memory;  // a copy that no store can change stays in registers; so below
    const std::size_t cells = box_.cells();
    const bool roomy = to.xyz != nullptr && points_ >= 2 * simd::lanes;
    const CellNotes notes{roomy ? to.xyz : nullptr, points_};
    if (roomy) note_cells(notes);
    for (std::size_t c = 0; c < cells; ++c) to.cell_end[c] = 0;
    for_each_cell(notes, [&](std::size_t, std::size_t cell) { ++to.cell_end[cell]; });
    Index begin = 0;
    for (std::size_t c = 0; c < cells; ++c) {
      const Index count = to.cell_end[c];
      to.cell_end[c] = begin;
      begin = static_cast<Index>(begin + count);
    }
    for_each_cell(
        notes, [&](std::size_t index, std::size_t cell) { to.order[to.cell_end[cell]++] = static_cast<Index>(index); });
    if (to.xyz != nullptr) copy_points(to.order, to.xyz);
  }

  [[nodiscard]] Status status() const noexcept {
    return points_ == 0 && status_ == Status::ok ? Status::empty_cloud : status_;
  }
  [[nodiscard]] std::size_t cloud_size() const noexcept { return cloud_.size; }
  [[nodiscard]] std::size_t size() const noexcept { return points_; }
  [[nodiscard]] std::size_t cells() const noexcept { return box_.cells(); }

  template <class Neighbors>
  [[nodiscard]] Status gather(const Contents& contents, const Point& center, Radius radius,
                              Neighbors& out) const noexcept {
    clear(out);
    if (status() != Status::ok) return status();
    if (!is_finite(center)) return Status::ok;
    Neighbors found = out;
    // The margin covers the rounding of d2, of the gaps and of the chord: each row gets all cells it needs.
    const float reach = rounded(radius.value * 1.000002f);
    const CellRange y = box_.range(1, center.y, reach);
    const CellRange z = box_.range(2, center.z, reach);
    for (std::uint32_t cz = z.first; cz <= z.last; ++cz) {
      const float gap_z = box_.gap(2, center.z, cz);
      for (std::uint32_t cy = y.first; cy <= y.last; ++cy) {
        const float gap_y = box_.gap(1, center.y, cy);
        // Half the chord that the sphere can have in common with this row of cells, squared.
        const float chord2 = (rounded(reach * reach) - rounded(gap_y * gap_y)) - rounded(gap_z * gap_z);
        if (!(chord2 >= 0.0f)) continue;
        const CellRange x = box_.range(0, center.x, simd::root(chord2));
        const std::size_t row = box_.row(cy, cz);
        offer_cells(contents, row + x.first, row + x.last, center, radius.squared, found);
      }
    }
    out = found;
    return outcome(out);
  }

 private:
  [[nodiscard]] Status fit(float cell_size, const Memory& memory) noexcept {
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
    return Status::ok;
  }

  /// The cell of each valid point and its place in the cloud, so that cells are worked out once: integers, kept where
  /// the coordinates will be. The cells are the first third; the places end a register's length before the last
  /// third does, because lanes are packed by stores of whole registers.
  struct CellNotes {
    float* cells;  ///< null if there is no room
    std::size_t size;
    [[nodiscard]] float* places() const noexcept { return cells + 2 * size - simd::lanes; }
  };

  void note_cells(const CellNotes& notes) const noexcept {
    const GridBox box = box_;
    float* cell = notes.cells;
    float* place = notes.places();
    std::uint32_t lane_numbers[simd::lanes];
    for (std::uint32_t k = 0; k < simd::lanes; ++k) lane_numbers[k] = k;
    const simd::I32 lane = simd::load(lane_numbers);
    for_each_valid_register(cloud_, [&](std::size_t i, const PointLanes& points, simd::Mask valid) {
      const simd::Packing packing = simd::packing(valid);
      const simd::I32 index = simd::all_int(static_cast<std::int32_t>(i)) + lane;
      simd::store(cell, simd::from_bits(box.cells_of(points)), packing);
      simd::store(place, simd::from_bits(index), packing);
      cell += packing.count;
      place += packing.count;
    });
  }

  /// Calls f(index, cell) for each valid point, in order.
  template <class Function>
  void for_each_cell(const CellNotes& notes, Function f) const noexcept {
    if (notes.cells == nullptr) {
      const GridBox box = box_;
      for_each_valid(cloud_, [&](std::size_t index, const Point& p) { f(index, box.cell_of(p)); });
      return;
    }
    const auto integer = [](const float* note) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, note, sizeof bits);
      return bits;
    };
    const float* const places = notes.places();
    for (std::size_t k = 0; k < notes.size; ++k) f(integer(places + k), integer(notes.cells + k));
  }

  /// The points' coordinates, in their new order.
  void copy_points(const Index* order, float* xyz) const noexcept {
    const std::size_t n = points_;
    std::size_t i = 0;
    for (; i + simd::lanes <= n; i += simd::lanes) {
      const PointLanes p = read_lanes(cloud_.points, [&](std::size_t lane) { return order[i + lane]; });
      simd::store(xyz + i, p.x);
      simd::store(xyz + n + i, p.y);
      simd::store(xyz + 2 * n + i, p.z);
    }
    for (; i < n; ++i) {
      const Point p = point(cloud_, order[i]);
      xyz[i] = p.x;
      xyz[n + i] = p.y;
      xyz[2 * n + i] = p.z;
    }
  }

  /// cell_end[c] is where cell c ends in `order`; it begins where the cell before it ends.
  [[nodiscard]] static std::size_t begin_of(const Contents& contents, std::size_t cell) noexcept {
    return cell == 0 ? 0 : contents.cell_end[cell - 1];
  }

  /// Cells that follow each other are one run of points.
  template <class Neighbors>
  void offer_cells(const Contents& contents, std::size_t first, std::size_t last, const Point& center,
                   float radius_squared, Neighbors& out) const noexcept {
    const std::size_t begin = begin_of(contents, first);
    const std::size_t end = contents.cell_end[last];
    if (contents.xyz != nullptr) {
      if (begin < end)
        offer_run<Index>({contents.xyz, contents.order, points_}, begin, end, center, radius_squared, out);
      return;
    }
    for (std::size_t i = begin; i < end; ++i) {
      offer(out, point(cloud_, contents.order[i]), contents.order[i], center, radius_squared);
    }
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
  /// several hundred neighbours and more. Where the cells would not fit the memory (clouds of huge extent, far
  /// outliers) the outliers are put into the outermost cells and, if that is not enough, cells become larger: any cell
  /// size gives the same neighbours, only slower.
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

  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
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

  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    return grid_.gather({order_, cell_end_, nullptr}, center, radius, out);
  }

 private:
  detail::Grid<Index> grid_;
  Index order_[MaxPoints];
  Index cell_end_[MaxCells];
};

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
