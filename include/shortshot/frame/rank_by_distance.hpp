// shortshot/frame/rank_by_distance.hpp: the neighbors' order by distance, without sorting.
//
// PCL sorts every neighborhood because a tied vote over an axis' sign looks at the five members in the middle. Ties
// are rare (2 to 5 key points in a hundred), so the order is asked for only then, and found by counting.
#ifndef SHORTSHOT_FRAME_RANK_BY_DISTANCE_HPP
#define SHORTSHOT_FRAME_RANK_BY_DISTANCE_HPP

#include <cstdint>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// Where a neighbor stands in the order: by squared distance (bits of floats >= 0 order as the floats do), then by
/// index in the cloud. The key point and its copies come first, at 0.
using Place = std::uint64_t;

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

template <class Neighbors>
[[nodiscard]] inline Place place_at(const Neighbors& n, std::uint32_t i) noexcept {
  const Neighbor v = neighbor_at(n, i);
  const std::uint32_t bits = math::bits_of(v.d2);
  if (bits == 0 && v.dx == 0.0f && v.dy == 0.0f && v.dz == 0.0f) return 0;
  return (Place{bits} << 32 | v.index) + 1;
}

/// How many neighbors stand before a place.
template <class Neighbors>
[[nodiscard]] inline int count_before(const Neighbors& n, Place limit) noexcept {
  int count = 0;
  std::uint32_t i = 0;
  if (simd::lanes > 1 && limit << 32 == 0) {  // whoever is closer, whole registers at a time
    const float d2 = math::float_of(static_cast<std::uint32_t>(limit >> 32));
    simd::I32 closer{};
    for (; n.size - i >= simd::lanes; i += simd::lanes) {
      closer = increment(load_neighbors(n, i).d2 < simd::all(d2), closer);
    }
    count = sum(closer);
  }
  for (; i < n.size; ++i) count += place_at(n, i) < limit ? 1 : 0;
  return count;
}

/// A place with `rank` neighbors before it, found bit by bit; `rank` must be their number at most.
template <class Neighbors>
[[nodiscard]] inline Place place_of_rank(const Neighbors& n, int rank) noexcept {
  Place place = 0;
  for (Place bit = Place{1} << 62; bit != 0; bit >>= 1) {
    const int before = count_before(n, place | bit);
    if (before <= rank) place |= bit;
    if (before == rank) break;
  }
  return place;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_FRAME_RANK_BY_DISTANCE_HPP
