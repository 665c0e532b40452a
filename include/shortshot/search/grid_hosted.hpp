// shortshot/search/grid_hosted.hpp: the fixed-radius grid with memory of its own. Hosted only: build allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../cloud.hpp"
#include "../config.hpp"
#include "../neighborhood.hpp"
#include "../status.hpp"
#include "grid.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {

/// A fixed-radius grid that owns its memory: 16 bytes a point and 4 a cell, with at most four cells a point (and 4,096)
/// whatever the cloud's extent. A search (see brute.hpp); the cloud must outlive it. build() again for the next frame:
/// its memory is reused. Queries are thread-safe.
class GridSearch {
 public:
  GridSearch() = default;

  /// Sorts the cloud into cells of `radius`. If that fails status() says why, and so do extract() and describe_at().
  GridSearch(const CloudView& cloud, float radius) { static_cast<void>(build(cloud, radius)); }

  /// See GridIndex::build(); may throw std::bad_alloc.
  [[nodiscard]] Status build(const CloudView& cloud, float radius) {
    const std::size_t points = check(cloud) == Status::ok ? cloud.size : 0;  // a bad view says anything of its size
    const std::size_t cells = 4 * points + 4096;
    if (order_.size() < points) {
      order_.resize(points);
      xyz_.resize(3 * points);
    }
    if (cell_end_.size() < cells) cell_end_.resize(cells);
    return grid_.build(cloud, radius, {order_.data(), cell_end_.data(), xyz_.data(), order_.size(), cells});
  }

  [[nodiscard]] Status status() const noexcept { return grid_.status(); }
  [[nodiscard]] std::size_t cloud_size() const noexcept { return grid_.cloud_size(); }

  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighborhood& out) const noexcept {
    return grid_.gather({order_.data(), cell_end_.data(), xyz_.data()}, center, radius, out);
  }

 private:
  detail::Grid<std::uint32_t> grid_{};
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> cell_end_;
  std::vector<float> xyz_;
};

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
