// shortshot/search/cell_index.hpp: the fixed-radius grid. Points are counting-sorted into cubic cells once per cloud; a
// query looks at runs of neighboring cells. Ten times faster to build than a tree, faster to search, and of bounded
// memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "cell_sort.hpp"
#include "neighborhood.hpp"
#include "radius.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The index itself, in memory that somebody else owns; a search (see search.hpp for the concept). Trivial type:
/// build() before the first gather(). The cloud and the memory must outlive it. `Index` may be uint16_t for clouds of
/// up to 65,535 points, invalid ones included.
template <class Index = std::uint32_t>
class GridIndex {
  static_assert(std::is_same<Index, std::uint16_t>::value || std::is_same<Index, std::uint32_t>::value,
                "GridIndex<Index> supports uint16_t and uint32_t");

 public:
  /// Sort the cloud's valid points into cells of `cell_size` meters; best close to the search radius, or half of it for
  /// several hundred neighbors and more. Where the cells would not fit the memory (clouds of huge extent, far
  /// outliers) the outliers are put into the outermost cells and, if that is not enough, cells become larger: any cell
  /// size gives the same neighbors, only slower.
  ///
  /// Statuses: empty_cloud, bad_view, bad_radius (the cell size), out_of_memory (more valid points than
  /// point_capacity, points with indices beyond Index, or no cell). O(points + cells); allocates nothing.
  [[nodiscard]] Status build(const CloudView& cloud, float cell_size, const GridMemory<Index>& memory) noexcept {
    memory_ = memory;
    return grid_.build(cloud, cell_size, memory);
  }

  /// What the last build() returned; empty_cloud before the first one (in memory that started as zeros).
  [[nodiscard]] Status status() const noexcept { return grid_.status(); }
  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return grid_.cloud_size(); }

  /// Number of points in the index: the cloud's valid ones.
  [[nodiscard]] std::size_t size() const noexcept { return grid_.size(); }

  /// The points of the cloud within `radius` of `center`, into an empty neighborhood `out`: ok, too_many_neighbors, or
  /// status(). Allocates nothing; reentrant.
  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    return grid_.gather({memory_.order, memory_.cell_end, memory_.xyz}, center, radius, out);
  }

 private:
  detail::Grid<Index> grid_;
  GridMemory<Index> memory_;
};

/// A grid with its memory inside, for clouds of up to `MaxPoints` valid points: a static or a member, no heap. 2 bytes
/// a point and 2 a cell up to 65,535 points, else 4 (the cloud's indices must fit those bytes, too). Trivial type:
/// build() before the first gather().
///
/// It takes less flash than a GridIndex and finds the same neighbors, but where a cloud's extent asks for more than
/// `MaxCells` cells, all of them become larger: take stray far returns out of the cloud (as NaN), or a GridIndex, which
/// leaves them out of its box.
template <std::size_t MaxPoints, std::size_t MaxCells>
class StaticGrid {
  static_assert(MaxPoints >= 1 && MaxCells >= 1, "StaticGrid<MaxPoints, MaxCells> supports one or more of both");

 public:
  /// Type of its indices.
  using Index = std::conditional_t<(MaxPoints <= 65535), std::uint16_t, std::uint32_t>;

  /// See GridIndex::build(), but for outliers.
  [[nodiscard]] Status build(const CloudView& cloud, float cell_size) noexcept {
    return grid_.build(cloud, cell_size, {order_, cell_end_, nullptr, MaxPoints, MaxCells});
  }

  [[nodiscard]] Status status() const noexcept { return grid_.status(); }
  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return grid_.cloud_size(); }

  template <class Neighbors>
  [[nodiscard, gnu::always_inline]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    return grid_.gather({order_, cell_end_, nullptr}, center, radius, out);
  }

 private:
  detail::Grid<Index, true> grid_;
  Index order_[MaxPoints];
  Index cell_end_[MaxCells];
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
