// Brute force for a sample of the neighborhoods: what --check can ask of a whole frame, whose points times points would
// take minutes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shortshot/base/math.hpp"
#include "shortshot/batch/grid_search.hpp"
#include "shortshot/cloud/cloud.hpp"
#include "shortshot/search/brute.hpp"
#include "shortshot/search/neighborhood.hpp"
#include "shortshot/search/radius.hpp"
#include "shortshot/status.hpp"

namespace shortshot_bench {

/// One neighborhood in how many brute force can look at, where it asks for `queries` of them: distances to 2^31 points,
/// which take a few seconds.
inline std::size_t brute_share(std::size_t points, std::size_t queries) {
  constexpr std::size_t most = std::size_t{1} << 31;
  return 1 + points * queries / most;
}

/// A search that asks brute force for one neighborhood in `share`, always the same ones, and a grid for the others.
class SampledBruteSearch {
 public:
  SampledBruteSearch(const shortshot::CloudView& cloud, float radius, std::size_t share)
      : brute_(cloud), grid_(cloud, radius), share_(share) {}

  [[nodiscard]] shortshot::Status status() const { return grid_.status(); }
  [[nodiscard]] std::size_t cloud_size() const { return grid_.cloud_size(); }

  template <class Neighbors>
  [[nodiscard]] shortshot::Status gather(const shortshot::Point& center, shortshot::Radius radius,
                                         Neighbors& out) const {
    return is_sampled(center) ? brute_.gather(center, radius, out) : grid_.gather(center, radius, out);
  }

  [[nodiscard]] bool is_sampled(const shortshot::Point& center) const {
    std::uint32_t hash = 0;
    for (const float v : {center.x, center.y, center.z}) {
      hash = (hash ^ shortshot::extend::math::bits_of(v)) * 2654435769u;
      hash ^= hash >> 15;
    }
    return hash % share_ == 0;
  }

 private:
  shortshot::BruteSearch brute_;
  shortshot::GridSearch grid_;
  std::size_t share_;
};

}  // namespace shortshot_bench
