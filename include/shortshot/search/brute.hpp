// shortshot/search/brute.hpp: neighbors by looking at every point. No index, no memory: the reference, and the choice
// for a handful of key points in a small cloud.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "neighborhood.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {

/// A search is anything with three functions:
/// * `Status gather(Point center, Radius radius, Neighbors& out) const noexcept`, for Neighborhood and whatever else it
///   shall work with, offers each valid point within the radius to `out` exactly once, in any order, by the index it
///   has in the cloud. It returns status() if that is not ok, and too_many_neighbors if `out` is too small, with the
///   number in `out.found`. It allocates nothing, and several threads may call it at once;
/// * `Status status() const noexcept` says why it cannot be asked, if so: what its build() returned;
/// * `std::size_t cloud_size() const noexcept` is the size of its cloud, so that it is not asked about another one.
class BruteSearch {
 public:
  explicit BruteSearch(const CloudView& cloud) noexcept
      : points_(cloud.points), size_(cloud.size), status_(check(cloud)) {}

  [[nodiscard]] Status status() const noexcept { return status_; }

  [[nodiscard]] std::size_t cloud_size() const noexcept { return size_; }

  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    clear(out);
    if (status_ != Status::ok) return status_;
    const Point at = center;  // a local: what is stored cannot change it
    Collector<Neighbors> found = out;
    for (std::size_t i = 0; i < size_; ++i) {
      offer(found, read(points_, i), static_cast<std::uint32_t>(i), at, radius.squared);
    }
    out = found;
    return outcome(out);
  }

 private:
  Float3Channel points_;  // of the cloud, which is borrowed
  std::size_t size_;
  Status status_;
};

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
