// shortshot/neighborhood.hpp: the support radius, and the gathered neighbourhood in the caller's memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cloud.hpp"
#include "config.hpp"
#include "math.hpp"
#include "rounded.hpp"
#include "simd.hpp"
#include "status.hpp"

namespace shortshot {

/// Most neighbours of one key point: what the fixed-point sums over them can hold.
inline constexpr std::uint32_t max_neighbors = 1u << 24;

/// The neighbours of one key point: a structure of arrays in memory that somebody else owns. Trivial type.
struct Neighborhood {
  float* dx;  ///< neighbour - key point in metres; `capacity` elements, as in all arrays here
  float* dy;
  float* dz;
  float* d2;             ///< squared distance, summed as (dx*dx + dy*dy) + dz*dz in float
  std::uint32_t* index;  ///< the neighbour's index in the cloud; no two are the same
  std::uint32_t capacity;
  std::uint32_t size;   ///< neighbours stored, the key point itself and its copies included
  std::uint32_t found;  ///< neighbours found; more than `capacity` if they did not fit
};

/// All the scratch memory a key point needs, sized at compile time and owned by the caller: a local, a static, a
/// member. 20 bytes a neighbour. Trivial type; one thread at a time may use it.
template <std::size_t MaxNeighbors>
struct Workspace {
  static_assert(MaxNeighbors >= 5 && MaxNeighbors <= max_neighbors,
                "Workspace<MaxNeighbors> supports 5 (a local reference frame needs as many) to 2^24 neighbours");
  float dx[MaxNeighbors];
  float dy[MaxNeighbors];
  float dz[MaxNeighbors];
  float d2[MaxNeighbors];
  std::uint32_t index[MaxNeighbors];
};

inline namespace SHORTSHOT_ISA {

/// A support radius in metres and its square. Neighbours are points with float d2 < squared: strictly inside.
/// Converts from float, squared in float. from_double() squares in double and rounds once, as PCL does: the same
/// neighbours to the last point on the rim. (Meant for constants and hosts: no double is left in firmware code.)
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

[[nodiscard]] inline Status check(Radius radius) noexcept {
  const bool usable = math::is_finite(radius.value) && math::is_finite(radius.squared) && radius.value > 0.0f &&
                      radius.squared > 1.17549435e-38f;
  return usable ? Status::ok : Status::bad_radius;
}

/// An empty neighbourhood in a workspace's memory.
template <std::size_t MaxNeighbors>
[[nodiscard]] inline Neighborhood neighborhood_in(Workspace<MaxNeighbors>& w) noexcept {
  return {w.dx, w.dy, w.dz, w.d2, w.index, static_cast<std::uint32_t>(MaxNeighbors), 0, 0};
}

/// One register of neighbours, from `i` on. What is left over at the end comes with copies of the key point (all
/// zeros), which no pass counts; nothing is read beyond the neighbourhood's size.
struct Offsets {
  simd::F32 dx, dy, dz, d2;
};

[[nodiscard, gnu::always_inline]] inline Offsets load_offsets(const Neighborhood& n, std::uint32_t i) noexcept {
  if (n.size - i >= simd::lanes) {
    return {simd::load(n.dx + i), simd::load(n.dy + i), simd::load(n.dz + i), simd::load(n.d2 + i)};
  }
  float rest[4][simd::lanes];
  for (float(&lanes)[simd::lanes] : rest) simd::store(lanes, simd::all(0.0f));
  for (std::uint32_t k = 0; k < n.size - i; ++k) {
    rest[0][k] = n.dx[i + k];
    rest[1][k] = n.dy[i + k];
    rest[2][k] = n.dz[i + k];
    rest[3][k] = n.d2[i + k];
  }
  return {simd::load(rest[0]), simd::load(rest[1]), simd::load(rest[2]), simd::load(rest[3])};
}

/// The same register's indices; 0 for what is left over.
[[nodiscard, gnu::always_inline]] inline simd::I32 load_indices(const Neighborhood& n, std::uint32_t i) noexcept {
  if (n.size - i >= simd::lanes) return simd::load(n.index + i);
  std::uint32_t rest[simd::lanes] = {};
  for (std::uint32_t k = 0; k < n.size - i; ++k) rest[k] = n.index[i + k];
  return simd::load(rest);
}

/// How many of the neighbours lie within a radius, the key point and its copies included.
[[nodiscard]] inline std::uint32_t count_within(const Neighborhood& n, Radius radius) noexcept {
  simd::I32 counts{};
  std::uint32_t i = 0;
  for (; i < n.size; i += simd::lanes) {
    counts = increment(load_offsets(n, i).d2 < simd::all(radius.squared), counts);
  }
  return static_cast<std::uint32_t>(sum(counts)) - (i - n.size);  // without what fills up the last register
}

namespace detail {

/// What every estimate from a neighbourhood asks of its arguments; `view` gets the vector to the viewpoint, if there is
/// one.
[[nodiscard]] inline Status check_estimate(const Neighborhood& n, Radius radius, const float* towards_viewpoint,
                                           float (&view)[3]) noexcept {
  const Status usable = check(radius);
  if (usable != Status::ok) return usable;
  if (n.size > max_neighbors) return Status::too_many_neighbors;
  for (int k = 0; k < 3 && towards_viewpoint != nullptr; ++k) view[k] = towards_viewpoint[k];
  return math::is_finite(view) ? Status::ok : Status::bad_viewpoint;
}

}  // namespace detail

/// Offer one point of the cloud to the neighbourhood: THE membership rule, for every search. A point is a neighbour if
/// its float squared distance is strictly below `radius_squared`; written so that NaN is refused.
inline void offer(Neighborhood& out, const Point& p, std::uint32_t index, const Point& center,
                  float radius_squared) noexcept {
  const float dx = p.x - center.x;
  const float dy = p.y - center.y;
  const float dz = p.z - center.z;
  const float d2 = (rounded(dx * dx) + rounded(dy * dy)) + rounded(dz * dz);
  if (!(d2 < radius_squared)) return;
  if (out.size < out.capacity) {
    out.dx[out.size] = dx;
    out.dy[out.size] = dy;
    out.dz[out.size] = dz;
    out.d2[out.size] = d2;
    out.index[out.size] = index;
    ++out.size;
  }
  ++out.found;
}

/// To be called by a search before it offers the first point.
inline void clear(Neighborhood& out) noexcept {
  out.size = 0;
  out.found = 0;
}

/// To be returned by a search after it has offered the last point.
[[nodiscard]] inline Status outcome(const Neighborhood& out) noexcept {
  return out.found > out.capacity ? Status::too_many_neighbors : Status::ok;
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
