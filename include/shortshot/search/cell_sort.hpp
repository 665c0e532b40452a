// shortshot/search/cell_sort.hpp: a cloud's points sorted into the cells of a box, and the search among them.
#ifndef SHORTSHOT_SEARCH_CELL_SORT_HPP
#define SHORTSHOT_SEARCH_CELL_SORT_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/point_lanes.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "cell_box.hpp"
#include "neighborhood.hpp"
#include "offer.hpp"
#include "offer_run.hpp"
#include "radius.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Memory of a GridIndex, borrowed from the caller: `point_capacity` elements of `order`, `cell_capacity` of
/// `cell_end`. `xyz`, if not null, has 3 * point_capacity floats and receives the sorted points' coordinates, all x,
/// then all y, then all z: runs of neighbors are then tested in lanes. Without it every point is read through the
/// view.
template <class Index>
struct GridMemory {
  Index* order;                ///< the points' indices, cell by cell
  Index* cell_end;             ///< where each cell's points end
  float* xyz;                  ///< null: none
  std::size_t point_capacity;  ///< of order
  std::size_t cell_capacity;   ///< of cell_end
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What a search reads of a grid's memory.
template <class Index>
struct GridContents {
  const Index* order;
  const Index* cell_end;
  const float* xyz;
};

/// What a grid knows besides its memory, which is handed to it at every call: an owner of both can be copied. A `Small`
/// one takes a third of the flash: it has no `xyz`, looks at a cube of cells for a sphere, and makes its cells larger
/// where they do not fit.
template <class Index, bool Small = false>
class Grid {
 public:
  using Memory = GridMemory<Index>;
  using Contents = GridContents<Index>;

  [[nodiscard]] Status build(const CloudView& cloud, float cell_size, const Memory& memory) noexcept {
    const Status status = plan(cloud, cell_size, memory);
    if (status == Status::ok) sort(cloud, memory);
    return status;
  }

  /// The first half of build(): settles the box of cells. Of the memory only cell_end is touched.
  [[nodiscard]] Status plan(const CloudView& cloud, float cell_size, const Memory& memory) noexcept {
    points_ = 0;
    channel_ = cloud.points;
    cloud_size_ = cloud.size;
    status_ = fit(cloud, cell_size, memory);
    return status_;
  }

  /// Between the halves: eight cells for each one.
  void halve_cells() noexcept { box_.halve_cells(); }

  /// The second half, a counting sort: count per cell, turn counts into ends of the cells before, and let each placed
  /// point move its cell's end forward to where it belongs.
  void sort(const CloudView& cloud, const Memory& memory) const noexcept {
    if constexpr (Small) {
      sort_by_two_passes(cloud, memory);
      return;
    }
    const Memory to = memory;  // a local, see Collector; so below
    const std::size_t cells = box_.cells();
    const bool roomy = to.xyz != nullptr && points_ >= 2 * simd::lanes;
    const CellNotes notes{roomy ? to.xyz : nullptr, points_};
    if (roomy) note_cells(cloud, notes);
    for (std::size_t c = 0; c < cells; ++c) to.cell_end[c] = 0;
    for_each_cell(cloud, notes, [&](std::size_t, std::size_t cell) { ++to.cell_end[cell]; });
    counts_to_begins(to.cell_end, cells);
    for_each_cell(cloud, notes, [&](std::size_t index, std::size_t cell) {
      to.order[to.cell_end[cell]++] = static_cast<Index>(index);
    });
    if (to.xyz != nullptr) copy_points(to.order, to.xyz);
  }

  [[nodiscard]] Status status() const noexcept {
    return points_ == 0 && status_ == Status::ok ? Status::empty_cloud : status_;
  }
  [[nodiscard]] std::size_t cloud_size() const noexcept { return cloud_size_; }
  [[nodiscard]] std::size_t size() const noexcept { return points_; }
  [[nodiscard]] std::size_t cells() const noexcept { return box_.cells(); }

  template <class Neighbors>
  [[nodiscard, gnu::always_inline]] Status gather(const Contents& contents, const Point& center, Radius radius,
                                                  Neighbors& out) const noexcept {
    clear(out, center);
    if (status() != Status::ok) return status();
    if (!is_finite(center)) return Status::ok;
    Collector<Neighbors> found = out;
    // The margin covers the rounding of d2, of the gaps and of the chord: each row gets all cells it needs.
    const float reach = unfused(radius.value * 1.000002f);
    const CellRange y = box_.range(1, center.y, reach);
    const CellRange z = box_.range(2, center.z, reach);
    CellRange x = box_.range(0, center.x, reach);
    for (std::uint32_t cz = z.first; cz <= z.last; ++cz) {
      for (std::uint32_t cy = y.first; cy <= y.last; ++cy) {
        if constexpr (!Small) {
          float half_chord = 0.0f;
          if (!box_.crosses(center, cy, cz, reach, half_chord)) continue;
          x = box_.range(0, center.x, half_chord);
        }
        const std::size_t row = box_.row(cy, cz);
        offer_cells(contents, row + x.first, row + x.last, center, radius.squared, found);
      }
    }
    out = found;
    return outcome(out);
  }

 private:
  /// From the counts of cells to where each of them begins.
  static void counts_to_begins(Index* cell_end, std::size_t cells) noexcept {
    Index begin = 0;
    for (std::size_t c = 0; c < cells; ++c) {
      const Index count = cell_end[c];
      cell_end[c] = begin;
      begin = static_cast<Index>(begin + count);
    }
  }

  /// sort() in less flash: one loop over the points counts, and the same one places.
  void sort_by_two_passes(const CloudView& cloud, const Memory& to) const noexcept {
    const std::size_t cells = box_.cells();
    std::memset(to.cell_end, 0, cells * sizeof(Index));
    for (int pass = 0; pass < 2; ++pass) {
      for_each_valid(cloud, [&](std::size_t index, const Point& p) {
        Index& end = to.cell_end[box_.cell_of(p)];
        if (pass == 1) to.order[end] = static_cast<Index>(index);
        ++end;
      });
      if (pass == 0) counts_to_begins(to.cell_end, cells);
    }
  }

  [[nodiscard]] Status fit(const CloudView& cloud, float cell_size, const Memory& memory) noexcept {
    const Status usable = validate(cloud);
    if (usable != Status::ok) return usable;
    if (validate(Radius(cell_size)) != Status::ok) return Status::bad_radius;
    if (memory.cell_capacity == 0) return Status::out_of_memory;

    Extent extent;
    const std::size_t valid = measure(cloud, extent);
    if (valid == 0) return Status::empty_cloud;
    constexpr std::size_t most = static_cast<Index>(~Index{0});
    if (valid > memory.point_capacity || cloud.size > most) return Status::out_of_memory;

    if constexpr (!Small) leave_outliers_out(cloud, valid, cell_size, memory.cell_end, memory.cell_capacity, extent);
    fit_box(extent, cell_size, memory.cell_capacity, box_);
    if constexpr (!Small) box_.note_rounding(extent);
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

  void note_cells(const CloudView& cloud, const CellNotes& notes) const noexcept {
    const GridBox box = box_;
    float* cell = notes.cells;
    float* place = notes.places();
    std::uint32_t lane_numbers[simd::lanes];
    for (std::uint32_t k = 0; k < simd::lanes; ++k) lane_numbers[k] = k;
    const simd::I32 lane = simd::load(lane_numbers);
    for_each_valid_register(cloud, [&](std::size_t i, const PointLanes& points, simd::Mask valid) {
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
  void for_each_cell(const CloudView& cloud, const CellNotes& notes, Function f) const noexcept {
    if (notes.cells == nullptr) {
      const GridBox box = box_;
      for_each_valid(cloud, [&](std::size_t index, const Point& p) { f(index, box.cell_of(p)); });
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
      const PointLanes p = read_lanes(channel_, [&](std::size_t lane) { return order[i + lane]; });
      simd::store(xyz + i, p.x);
      simd::store(xyz + n + i, p.y);
      simd::store(xyz + 2 * n + i, p.z);
    }
    for (; i < n; ++i) {
      const Point p = read(channel_, order[i]);
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
    if constexpr (!Small) {
      if (contents.xyz != nullptr && begin < end) {
        offer_run<Index>({contents.xyz, contents.order, points_}, begin, end, center, radius_squared, out);
        return;
      }
    }
    for (std::size_t i = begin; i < end; ++i) {
      offer(out, read(channel_, contents.order[i]), contents.order[i], center, radius_squared);
    }
  }

  Float3Channel channel_;  // the cloud's points, borrowed
  std::size_t cloud_size_;
  GridBox box_;
  std::size_t points_;
  Status status_;
};

/// A grid's gather() as a function of its own.
template <class Index, class Neighbors>
[[nodiscard]] inline Status gather_from(const Grid<Index>& grid, const GridContents<Index>& contents,
                                        const Point& center, Radius radius, Neighbors& out) noexcept {
  return grid.gather(contents, center, radius, out);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_SEARCH_CELL_SORT_HPP
