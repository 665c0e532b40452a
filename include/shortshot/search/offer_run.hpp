// shortshot/search/offer_run.hpp: a run of points offered to a neighborhood, a register of them at a time.
#ifndef SHORTSHOT_SEARCH_OFFER_RUN_HPP
#define SHORTSHOT_SEARCH_OFFER_RUN_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "neighborhood.hpp"
#include "offer.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Points in an order of their own: all x, then all y, then all z; and where they stand in the cloud.
template <class Index>
struct SortedPoints {
  const float* xyz;
  const Index* order;
  std::size_t size;
};

/// The places in the cloud of a register of points.
template <class Index>
[[nodiscard]] inline simd::I32 load_order(const Index* index) noexcept {
  if constexpr (sizeof(Index) == sizeof(std::uint32_t)) {
    return simd::load(index);
  } else {
    std::uint32_t wide[simd::lanes];
    for (std::size_t k = 0; k < simd::lanes; ++k) wide[k] = index[k];
    return simd::load(wide);
  }
}

/// offer() for the points [i, end).
template <class Index, class Neighbors>
inline void offer_one_by_one(const SortedPoints<Index>& points, std::size_t i, std::size_t end, const Point& center,
                             float radius_squared, Neighbors& out) noexcept {
  const float* const x = points.xyz;
  const std::size_t n = points.size;
  for (; i < end; ++i) offer(out, {x[i], x[n + i], x[2 * n + i]}, points.order[i], center, radius_squared);
}

template <class Index, class Neighbors>
inline void offer_run(const SortedPoints<Index>& points, std::size_t i, std::size_t end, const Point& center,
                      float radius_squared, Neighbors& out) noexcept {
  offer_one_by_one(points, i, end, center, radius_squared, out);
}

template <class Index>
inline void offer_run(const SortedPoints<Index>& points, std::size_t i, std::size_t end, const Point& center,
                      float radius_squared, Neighborhood& out) noexcept {
  const std::size_t n = points.size;
  const float* const x = points.xyz;
  const Index* const order = points.order;
  // Whole registers are read up to the end of the points, and written up to the capacity.
  const bool roomy = simd::lanes > 1 && end + simd::lanes <= n && out.capacity - out.size >= end - i + simd::lanes;
  if (!roomy) {
    offer_one_by_one(points, i, end, center, radius_squared, out);
    return;
  }
  const Neighborhood to = out;
  const simd::F32 center_x = simd::all(center.x);
  const simd::F32 center_y = simd::all(center.y);
  const simd::F32 center_z = simd::all(center.z);
  const simd::F32 limit = simd::all(radius_squared);
  simd::Mask candidates = simd::first(simd::lanes);
  std::uint32_t size = to.size;
  // No branch on who is inside: that is settled by the flip of a coin at every border of the sphere.
  for (; i < end; i += simd::lanes) {
    if (end - i < simd::lanes) candidates = simd::first(end - i);
    const simd::F32 dx = simd::load(x + i) - center_x;
    const simd::F32 dy = simd::load(x + n + i) - center_y;
    const simd::F32 dz = simd::load(x + 2 * n + i) - center_z;
    const simd::F32 d2 = (dx * dx + dy * dy) + dz * dz;
    const simd::Packing inside = simd::packing((d2 < limit) & candidates);
    simd::store(to.dx + size, dx, inside);
    simd::store(to.dy + size, dy, inside);
    simd::store(to.dz + size, dz, inside);
    simd::store(to.d2 + size, d2, inside);
    simd::store(to.index + size, load_order(order + i), inside);
    size += inside.count;
  }
  out.found += size - out.size;
  out.size = size;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_SEARCH_OFFER_RUN_HPP
