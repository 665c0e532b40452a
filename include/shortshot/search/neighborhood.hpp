// shortshot/search/neighborhood.hpp: the support radius, and the gathered neighborhood in the caller's memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"

namespace shortshot {

/// Most neighbors of one key point: what the fixed-point sums over them can hold.
inline constexpr std::uint32_t max_neighbors = 1u << 24;

/// The neighbors of one key point: a structure of arrays in memory that somebody else owns. Trivial type.
struct Neighborhood {
  float* dx;  ///< neighbor - key point in meters; `capacity` elements, as in all arrays here
  float* dy;
  float* dz;
  float* d2;             ///< squared distance, summed as (dx*dx + dy*dy) + dz*dz in float
  std::uint32_t* index;  ///< the neighbor's index in the cloud; no two are the same
  std::uint32_t capacity;
  std::uint32_t size;   ///< neighbors stored, the key point itself and its copies included
  std::uint32_t found;  ///< neighbors found; more than `capacity` if they did not fit
};

/// All the scratch memory a key point needs, sized at compile time and owned by the caller: a local, a static, a
/// member. 20 bytes a neighbor. Trivial type; one thread at a time may use it.
template <std::size_t MaxNeighbors>
struct Workspace {
  static_assert(MaxNeighbors >= 5 && MaxNeighbors <= max_neighbors,
                "Workspace<MaxNeighbors> supports 5 (a local reference frame needs as many) to 2^24 neighbors");
  float dx[MaxNeighbors];
  float dy[MaxNeighbors];
  float dz[MaxNeighbors];
  float d2[MaxNeighbors];
  std::uint32_t index[MaxNeighbors];
};

/// The same in a tenth (or, with 32-bit indices, a fifth) of the memory: indices only. Offsets are worked out from the
/// cloud whenever they are asked for, with the same bits. Trivial type.
template <class Index>
struct CompactNeighborhood {
  Float3Channel points;  ///< of the cloud
  Point center;          ///< the key point
  Index* index;          ///< the neighbor's index in the cloud, `capacity` elements; no two are the same
  std::uint32_t capacity;
  std::uint32_t size;   ///< neighbors stored, the key point itself and its copies included
  std::uint32_t found;  ///< neighbors found; more than `capacity` if they did not fit
};

/// A Workspace of 2 bytes a neighbor (`Index` std::uint32_t: 4) for targets that have more time than memory. Clouds of
/// more points than `Index` can tell apart have too_many_neighbors wherever there is a neighbor.
template <std::size_t MaxNeighbors, class Index = std::uint16_t>
struct CompactWorkspace {
  static_assert(MaxNeighbors >= 5 && MaxNeighbors <= max_neighbors,
                "CompactWorkspace<MaxNeighbors> supports 5 (a local reference frame needs as many) to 2^24 neighbors");
  static_assert(std::is_same<Index, std::uint16_t>::value || std::is_same<Index, std::uint32_t>::value,
                "CompactWorkspace<MaxNeighbors, Index> supports uint16_t and uint32_t");
  Index index[MaxNeighbors];
};

inline namespace SHORTSHOT_ISA {

/// A support radius in meters and its square. Neighbors are points with float d2 < squared: strictly inside.
/// Converts from float, squared in float. from_double() squares in double and rounds once, as PCL does: the same
/// neighbors to the last point on the rim. (Meant for constants and hosts: no double is left in firmware code.)
struct Radius {
  float value;
  float squared;

  constexpr Radius(float radius) noexcept : value(radius), squared(radius * radius) {}  // NOLINT: 0.04f is a radius
  [[nodiscard]] static constexpr Radius from_double(double radius) noexcept {
    Radius r(static_cast<float>(radius));
    r.squared = static_cast<float>(radius * radius);
    return r;
  }
};

/// A radius must be a positive number whose square is a normal one.
[[nodiscard]] inline Status check(Radius radius) noexcept {
  // Bits of positive numbers order as the numbers do; infinity's follow.
  const auto lies_from = [](std::uint32_t first, float value) {
    return math::bits_of(value) - first < 0x7F800000u - first;
  };
  return lies_from(1u, radius.value) && lies_from(0x00800000u, radius.squared) ? Status::ok : Status::bad_radius;
}

/// An empty neighborhood in a workspace's memory; a compact one is that of the key point `center` of `cloud`, and must
/// be gathered around it.
template <std::size_t MaxNeighbors>
[[nodiscard]] inline Neighborhood neighborhood_in(Workspace<MaxNeighbors>& w) noexcept {
  return {w.dx, w.dy, w.dz, w.d2, w.index, static_cast<std::uint32_t>(MaxNeighbors), 0, 0};
}

template <std::size_t MaxNeighbors>
[[nodiscard]] inline Neighborhood neighborhood_in(Workspace<MaxNeighbors>& w, const CloudView&, const Point&) noexcept {
  return neighborhood_in(w);
}

template <std::size_t MaxNeighbors, class Index>
[[nodiscard]] inline CompactNeighborhood<Index> neighborhood_in(CompactWorkspace<MaxNeighbors, Index>& w,
                                                                const CloudView& cloud, const Point& center) noexcept {
  const bool all_have_indices = cloud.size - 1 <= static_cast<Index>(~Index{0});
  return {cloud.points, center, w.index, all_have_indices ? static_cast<std::uint32_t>(MaxNeighbors) : 0u, 0, 0};
}

/// One neighbor: from the key point to it, in meters; how far that is, squared, summed as (dx*dx + dy*dy) + dz*dz; and
/// its index in the cloud.
struct Neighbor {
  float dx, dy, dz, d2;
  std::uint32_t index;
};

[[nodiscard]] inline Neighbor neighbor_from(const Point& center, const Point& p, std::uint32_t index) noexcept {
  const float dx = p.x - center.x;
  const float dy = p.y - center.y;
  const float dz = p.z - center.z;
  return {dx, dy, dz, (rounded(dx * dx) + rounded(dy * dy)) + rounded(dz * dz), index};
}

/// Neighbor `i` of a neighborhood.
[[nodiscard]] inline Neighbor neighbor_at(const Neighborhood& n, std::uint32_t i) noexcept {
  return {n.dx[i], n.dy[i], n.dz[i], n.d2[i], n.index[i]};
}
template <class Index>
[[nodiscard]] inline Neighbor neighbor_at(const CompactNeighborhood<Index>& n, std::uint32_t i) noexcept {
  return neighbor_from(n.center, read(n.points, n.index[i]), n.index[i]);
}

/// One register of neighbors. (Of five members, because compilers for ARM move structs of up to four floats to
/// registers and back wherever a function returns them.)
struct NeighborLanes {
  simd::F32 dx, dy, dz, d2;
  simd::I32 index;
};

/// The register from neighbor `i` on. What is left over at the end comes with copies of the key point (all zeros),
/// which no pass counts; nothing is read beyond the neighborhood's size.
template <class Neighbors>
[[nodiscard]] SHORTSHOT_INLINE NeighborLanes load_neighbors(const Neighbors& n, std::uint32_t i) noexcept {
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

/// How many of the neighbors lie within a radius, the key point and its copies included.
template <class Neighbors>
[[nodiscard]] inline std::uint32_t count_within(const Neighbors& n, Radius radius) noexcept {
  simd::I32 counts{};
  std::uint32_t i = 0;
  for (; i < n.size; i += simd::lanes) {
    counts = increment(load_neighbors(n, i).d2 < simd::all(radius.squared), counts);
  }
  return static_cast<std::uint32_t>(sum(counts)) - (i - n.size);  // without what fills up the last register
}

namespace detail {

/// What every estimate from a neighborhood asks of its arguments; `view` gets the vector to the viewpoint, if there is
/// one.
template <class Neighbors>
[[nodiscard]] inline Status check_estimate(const Neighbors& n, Radius radius, const float* towards_viewpoint,
                                           float (&view)[3]) noexcept {
  const Status usable = check(radius);
  if (usable != Status::ok) return usable;
  if (n.size > max_neighbors) return Status::too_many_neighbors;
  for (int k = 0; k < 3 && towards_viewpoint != nullptr; ++k) view[k] = towards_viewpoint[k];
  return math::is_finite(view) ? Status::ok : Status::bad_viewpoint;
}

}  // namespace detail

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
  if (!(v.d2 < radius_squared)) return;
  if (out.size < out.capacity) put(out, out.size++, v);
  ++out.found;
}

/// What a search offers its points to: a local of its own, which no store can change, and which it copies to its
/// caller's in the end; or that one itself, where code shall be small.
template <class Neighbors>
using Collector = std::conditional_t<detail::small_code, Neighbors&, Neighbors>;

/// To be called by a search before it offers the first point.
template <class Neighbors>
inline void clear(Neighbors& out) noexcept {
  out.size = 0;
  out.found = 0;
}

/// To be returned by a search after it has offered the last point.
template <class Neighbors>
[[nodiscard]] inline Status outcome(const Neighbors& out) noexcept {
  return out.found > out.capacity ? Status::too_many_neighbors : Status::ok;
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
