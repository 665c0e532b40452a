// shortshot/search/offer.hpp: how a search fills a neighborhood, and the one rule of who belongs to it.
#ifndef SHORTSHOT_SEARCH_OFFER_HPP
#define SHORTSHOT_SEARCH_OFFER_HPP

#include <cstdint>

#include "../base/quiet.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "neighborhood.hpp"

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// To be called by a search before it offers the first point: an empty neighborhood around `center`.
template <class Neighbors>
inline void clear(Neighbors& out, const Point& center) noexcept {
  out.center = center;
  out.size = 0;
  out.found = 0;
}

/// Write down neighbor `i`.
inline void put(Neighborhood& n, std::uint32_t i, const Neighbor& v) noexcept {
  n.dx[i] = v.dx;
  n.dy[i] = v.dy;
  n.dz[i] = v.dz;
  n.d2[i] = v.d2;
  n.index[i] = v.index;
}
template <class Index>
inline void put(CompactNeighborhood<Index>& n, std::uint32_t i, const Neighbor& v) noexcept {
  n.index[i] = static_cast<Index>(v.index);
}

/// Offer one point of the cloud to the neighborhood: THE membership rule, for every search. A point is a neighbor if
/// its float squared distance is strictly below `radius_squared`; written so that NaN is refused.
template <class Neighbors>
inline void offer(Neighbors& out, const Point& p, std::uint32_t index, const Point& center,
                  float radius_squared) noexcept {
  const Neighbor v = neighbor_from(center, p, index);
  if (!detail::is_below(v.d2, radius_squared)) return;
  if (out.size < out.capacity) put(out, out.size++, v);
  ++out.found;
}

/// To be returned by a search after it has offered the last point.
template <class Neighbors>
[[nodiscard]] inline Status outcome(const Neighbors& out) noexcept {
  return out.found > out.capacity ? Status::too_many_neighbors : Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_SEARCH_OFFER_HPP
