// shortshot/search/brute.hpp: neighbors by looking at every point. No index, no memory: the reference, and the choice
// for a handful of key points in a small cloud.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "neighborhood.hpp"
#include "offer.hpp"
#include "radius.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A search (search.hpp) without an index.
class BruteSearch {
 public:
  /// Borrows the cloud's memory; a view that cannot be read is its status().
  explicit BruteSearch(const CloudView& cloud) noexcept
      : points_(cloud.points), size_(cloud.size), status_(validate(cloud)) {}

  /// ok, or why the cloud cannot be read.
  [[nodiscard]] Status status() const noexcept { return status_; }

  /// Points of the cloud, valid or not.
  [[nodiscard]] std::size_t cloud_size() const noexcept { return size_; }

  /// The points of the cloud within `radius` of `center`, into an empty neighborhood `out`: ok, too_many_neighbors, or
  /// status(). O(points); allocates nothing; reentrant.
  template <class Neighbors>
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighbors& out) const noexcept {
    extend::clear(out, center);
    if (status_ != Status::ok) return status_;
    const Point at = center;  // a local: what is stored cannot change it
    extend::Collector<Neighbors> found = out;
    for (std::size_t i = 0; i < size_; ++i) {
      extend::offer(found, extend::read(points_, i), static_cast<std::uint32_t>(i), at, radius.squared);
    }
    out = found;
    return extend::outcome(out);
  }

 private:
  Float3Channel points_;  // of the cloud, which is borrowed
  std::size_t size_;
  Status status_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
