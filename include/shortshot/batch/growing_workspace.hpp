// shortshot/batch/growing_workspace.hpp: a workspace that grows: one per thread. Hosted only: allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

class GrowingWorkspace {
 public:
  [[nodiscard]] Neighborhood neighborhood() noexcept {
    const std::size_t n = index_.size();
    float* p = floats_.data();
    return {p, p + n, p + 2 * n, p + 3 * n, index_.data(), static_cast<std::uint32_t>(n), 0, 0, {}};
  }

  /// A search's gather(); grows until the neighbors fit.
  template <class Search>
  [[nodiscard]] Status gather(const Search& search, const Point& center, Radius radius, Neighborhood& n) {
    n = neighborhood();
    const Status status = search.gather(center, radius, n);
    if (status != Status::too_many_neighbors || n.found > max_neighbors) return status;
    reserve(n.found);
    n = neighborhood();
    return search.gather(center, radius, n);
  }

  /// Room for `neighbors`; half as much again where it has to grow, so that it seldom does.
  void reserve(std::size_t neighbors) {
    if (neighbors <= index_.size()) return;
    const std::size_t capacity = neighbors + neighbors / 2;
    floats_.resize(4 * capacity);
    index_.resize(capacity);
  }

 private:
  std::vector<float> floats_;
  std::vector<std::uint32_t> index_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
