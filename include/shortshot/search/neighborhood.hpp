// shortshot/search/neighborhood.hpp: the neighbors of one key point, in memory that somebody else owns.
#ifndef SHORTSHOT_SEARCH_NEIGHBORHOOD_HPP
#define SHORTSHOT_SEARCH_NEIGHBORHOOD_HPP

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "radius.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Most neighbors of one key point: what the fixed-point sums over them can hold.
inline constexpr std::uint32_t max_neighbors = 1u << 24;

/// The neighbors of one key point: a structure of arrays in memory that somebody else owns. Trivial type.
struct Neighborhood {
  float* dx;               ///< neighbor - key point in meters; `capacity` elements, as in all arrays here
  float* dy;               ///< the same along y
  float* dz;               ///< the same along z
  float* d2;               ///< squared distance, summed as (dx*dx + dy*dy) + dz*dz in float
  std::uint32_t* index;    ///< the neighbor's index in the cloud; no two are the same
  std::uint32_t capacity;  ///< how many fit
  std::uint32_t size;      ///< neighbors stored, the key point itself and its copies included
  std::uint32_t found;     ///< neighbors found; more than `capacity` if they did not fit
  Point center;            ///< the key point: what gather() was asked for
};

/// The same in a tenth (or, with 32-bit indices, a fifth) of the memory: indices only. Offsets are worked out from the
/// cloud whenever they are asked for, with the same bits. Trivial type.
template <class Index>
struct CompactNeighborhood {
  Float3Channel points;    ///< of the cloud
  Point center;            ///< the key point
  Index* index;            ///< the neighbor's index in the cloud, `capacity` elements; no two are the same
  std::uint32_t capacity;  ///< how many fit
  std::uint32_t size;      ///< neighbors stored, the key point itself and its copies included
  std::uint32_t found;     ///< neighbors found; more than `capacity` if they did not fit
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// One neighbor: from the key point to it, in meters; how far that is, squared, summed as (dx*dx + dy*dy) + dz*dz; and
/// its index in the cloud.
struct Neighbor {
  float dx, dy, dz, d2;  ///< offset and squared distance
  std::uint32_t index;   ///< in the cloud
};

/// A neighbor of `center` at `p`.
[[nodiscard]] inline Neighbor neighbor_from(const Point& center, const Point& p, std::uint32_t index) noexcept {
  const float dx = p.x - center.x;
  const float dy = p.y - center.y;
  const float dz = p.z - center.z;
  return {dx, dy, dz, (unfused(dx * dx) + unfused(dy * dy)) + unfused(dz * dz), index};
}

/// Neighbor `i` of a neighborhood.
[[nodiscard]] inline Neighbor neighbor_at(const Neighborhood& n, std::uint32_t i) noexcept {
  return {n.dx[i], n.dy[i], n.dz[i], n.d2[i], n.index[i]};
}
template <class Index>
[[nodiscard]] inline Neighbor neighbor_at(const CompactNeighborhood<Index>& n, std::uint32_t i) noexcept {
  return neighbor_from(n.center, read_in_place(n.points, n.index[i]), n.index[i]);
}

/// One register of neighbors. (Of five members, because compilers for ARM move structs of up to four floats to
/// registers and back wherever a function returns them.)
struct NeighborLanes {
  simd::F32 dx, dy, dz, d2;  ///< offsets and squared distances
  simd::I32 index;           ///< in the cloud
};

/// The register from neighbor `i` on. What is left over at the end comes with copies of the key point (all zeros),
/// which no pass counts; nothing is read beyond the neighborhood's size.
template <class Neighbors>
[[nodiscard]] SHORTSHOT_INLINE NeighborLanes load_neighbors(const Neighbors& n, std::uint32_t i) noexcept {
  if constexpr (simd::lanes == 1) {
    const Neighbor v = neighbor_at(n, i);
    return {simd::all(v.dx), simd::all(v.dy), simd::all(v.dz), simd::all(v.d2), simd::load(&v.index)};
  }
  float lanes[4][simd::lanes] = {};
  std::uint32_t index[simd::lanes] = {};
  for (std::uint32_t k = 0; k < simd::lanes && k < n.size - i; ++k) {
    const Neighbor v = neighbor_at(n, i + k);
    lanes[0][k] = v.dx;
    lanes[1][k] = v.dy;
    lanes[2][k] = v.dz;
    lanes[3][k] = v.d2;
    index[k] = v.index;
  }
  return {simd::load(lanes[0]), simd::load(lanes[1]), simd::load(lanes[2]), simd::load(lanes[3]), simd::load(index)};
}

[[nodiscard]] SHORTSHOT_INLINE NeighborLanes load_neighbors(const Neighborhood& n, std::uint32_t i) noexcept {
  if (simd::lanes == 1 || n.size - i >= simd::lanes) {
    return {simd::load(n.dx + i), simd::load(n.dy + i), simd::load(n.dz + i), simd::load(n.d2 + i),
            simd::load(n.index + i)};
  }
  return load_neighbors<Neighborhood>(n, i);
}

/// Their squared distances alone.
template <class Neighbors>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 load_d2(const Neighbors& n, std::uint32_t i) noexcept {
  return load_neighbors(n, i).d2;
}
[[nodiscard]] SHORTSHOT_INLINE simd::F32 load_d2(const Neighborhood& n, std::uint32_t i) noexcept {
  return simd::lanes == 1 || n.size - i >= simd::lanes ? simd::load(n.d2 + i) : load_neighbors(n, i).d2;
}

/// How many of the neighbors lie within a radius, the key point and its copies included.
template <class Neighbors>
[[nodiscard]] inline std::uint32_t count_within(const Neighbors& n, Radius radius) noexcept {
  simd::I32 counts{};
  std::uint32_t i = 0;
  for (; i < n.size; i += simd::lanes) {
    counts = increment(load_d2(n, i) < simd::all(radius.squared), counts);
  }
  return static_cast<std::uint32_t>(sum(counts)) - (i - n.size);  // without what fills up the last register
}

/// A local copy, for loops that store: the compiler knows that no store changes a local, and keeps it in registers
/// (aliasing; all "copies" in this library are for that). Searches copy theirs back in the end. Where code shall be
/// small, no copy.
template <class Neighbors>
using Collector = std::conditional_t<detail::small_code, Neighbors&, Neighbors>;

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_SEARCH_NEIGHBORHOOD_HPP
