// A neighborhood in memory that grows until all neighbors fit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shortshot/cloud/cloud.hpp"
#include "shortshot/search/neighborhood.hpp"
#include "shortshot/status.hpp"

namespace shortshot_bench::golden {

class Neighbors {
 public:
  // The result lives until the next gather().
  template <class Search>
  const shortshot::Neighborhood& gather(const Search& search, const shortshot::Point& center,
                                        shortshot::Radius radius) {
    if (search.gather(center, radius, neighborhood_) == shortshot::Status::too_many_neighbors) {
      reserve(neighborhood_.found);
      static_cast<void>(search.gather(center, radius, neighborhood_));  // cannot be too many again
    }
    return neighborhood_;
  }

 private:
  void reserve(std::size_t capacity) {
    floats_.resize(4 * capacity);
    indices_.resize(capacity);
    float* p = floats_.data();
    neighborhood_ = {p,
                     p + capacity,
                     p + 2 * capacity,
                     p + 3 * capacity,
                     indices_.data(),
                     static_cast<std::uint32_t>(capacity),
                     0,
                     0,
                     {}};
  }

  std::vector<float> floats_;
  std::vector<std::uint32_t> indices_;
  shortshot::Neighborhood neighborhood_{};
};

}  // namespace shortshot_bench::golden
