// shortshot/batch/grid_search.hpp: the fixed-radius grid with memory of its own. Hosted only: build allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../dispatch/widest.hpp"
#include "../search/cell_sort.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A fixed-radius grid that owns its memory: 16 bytes a valid point and 4 a cell, with as many cells as the cloud's box
/// holds, but at most four a point (and 4,096). A search (see search.hpp); the cloud must outlive it. build() again for
/// the next frame: its memory is reused. Queries are thread-safe.
class GridSearch {
 public:
  GridSearch() = default;

  /// Sorts the cloud into cells of `radius`, or of half of it where points are dense. If that fails status() says why,
  /// and so do extract() and describe_at().
  GridSearch(const CloudView& cloud, float radius) { static_cast<void>(build(cloud, radius)); }

  /// One that was moved from is as one that was never built: empty_cloud.
  GridSearch(GridSearch&& other) noexcept { swap(other); }
  GridSearch(const GridSearch& other) = default;
  GridSearch& operator=(GridSearch other) noexcept {
    swap(other);
    return *this;
  }
  ~GridSearch() = default;

  /// See GridIndex::build(); may throw std::bad_alloc.
  [[nodiscard]] Status build(const CloudView& cloud, float radius) {
    const std::size_t points = validate(cloud) == Status::ok ? cloud.size : 0;  // a bad view says anything of its size
    const std::size_t cells = 4 * points + 4096;
    if (cell_end_.size() < planning_cells) cell_end_.resize(planning_cells);
    grid_ = {};  // and so it stays if there is no memory
    detail::HostGrid next{};
    if (detail::plan_widest(next, cloud, radius, {nullptr, cell_end_.data(), nullptr, points, cells}) != Status::ok) {
      grid_ = next;
      return next.status();
    }
    // Points lie on surfaces, which pass through few cells of their box: 8 points a cell of the box mean hundreds in
    // those that are not empty, and then smaller cells, fewer of whose points lie outside the sphere, pay.
    if (8 * next.cells() <= next.size()) next.halve_cells();
    if (order_.size() < next.size()) {
      order_.resize(next.size());
      xyz_.resize(3 * next.size());
    }
    if (cell_end_.size() < next.cells()) cell_end_.resize(next.cells());
    detail::sort_widest(next, cloud, {order_.data(), cell_end_.data(), xyz_.data(), order_.size(), cell_end_.size()});
    grid_ = next;
    return Status::ok;
  }

  /// What the last build() returned; empty_cloud before the first one.
  [[nodiscard]] Status status() const noexcept { return grid_.status(); }
  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return grid_.cloud_size(); }

  /// The points of the cloud within `radius` of `center`, into an empty neighborhood `out`: ok, too_many_neighbors, or
  /// status(). Allocates nothing; reentrant.
  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    return detail::gather_widest(grid_, {order_.data(), cell_end_.data(), xyz_.data()}, center, radius, out);
  }

 private:
  static constexpr std::size_t planning_cells = 3 * std::size_t{detail::ThinEnds<std::uint32_t>::slices};

  void swap(GridSearch& other) noexcept {
    std::swap(grid_, other.grid_);
    order_.swap(other.order_);
    cell_end_.swap(other.cell_end_);
    xyz_.swap(other.xyz_);
  }

  detail::HostGrid grid_{};
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> cell_end_;
  std::vector<float> xyz_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
