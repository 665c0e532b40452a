// shortshot/ranking.hpp: the members of a neighbourhood that make its frame, and their rank in distance without
// sorting.
//
// PCL sorts every neighbourhood because a tied vote over an axis' sign looks at the five members in the middle. Ties
// are rare (2 to 5 key points in a hundred), so the order is asked for only then, and found by bisection in place.
#pragma once

#include <cstdint>
#include <cstring>

#include "config.hpp"
#include "neighborhood.hpp"
#include "simd.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// A member makes a frame: it lies strictly inside the frame's radius and not at the key point itself.
[[nodiscard]] inline bool is_member(const Neighborhood& n, std::uint32_t i, Radius radius) noexcept {
  return n.d2[i] < radius.squared && (n.dx[i] != 0.0f || n.dy[i] != 0.0f || n.dz[i] != 0.0f);
}

/// A place in the order of members: by squared distance, then by index in the cloud (below all of them: -1).
struct Place {
  float d2;
  std::int64_t index;
};

[[nodiscard]] inline bool before(Place a, Place b) noexcept {
  return a.d2 < b.d2 || (a.d2 == b.d2 && a.index < b.index);
}

/// The first member behind a place; n.size if there is none.
[[nodiscard]] inline std::uint32_t next_member(const Neighborhood& n, Radius radius, Place place) noexcept {
  std::uint32_t best = n.size;
  for (std::uint32_t i = 0; i < n.size; ++i) {
    const Place candidate{n.d2[i], n.index[i]};
    if (!before(place, candidate) || !is_member(n, i, radius)) continue;
    if (best == n.size || before(candidate, {n.d2[best], n.index[best]})) best = i;
  }
  return best;
}

/// How many neighbours have a squared distance of at most `limit`.
[[nodiscard]] inline int count_within(const Neighborhood& n, float limit) noexcept {
  simd::I32 within{};
  std::uint32_t i = 0;
  for (; n.size - i >= simd::lanes; i += simd::lanes) {
    within = increment(simd::all(limit) >= simd::load(n.d2 + i), within);
  }
  int count = sum(within);
  for (; i < n.size; ++i) count += n.d2[i] <= limit ? 1 : 0;
  return count;
}

/// The member of the given rank; rank 0 is the closest. The neighbourhood must have more members than that.
[[nodiscard]] inline std::uint32_t member_of_rank(const Neighborhood& n, Radius radius, int rank) noexcept {
  int copies = 0;  // of the key point: at distance 0, and within every limit
  for (std::uint32_t i = 0; i < n.size; ++i) copies += n.d2[i] == 0.0f && !is_member(n, i, radius) ? 1 : 0;
  const auto as_float = [](std::uint32_t bits) {
    float value = 0.0f;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  };
  // Bits of floats >= 0 order as the floats do: bisect for the smallest d2 with more than `rank` members within.
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::memcpy(&high, &radius.squared, sizeof high);
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (count_within(n, as_float(middle)) - copies > rank) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  const float d2 = as_float(low);
  const int closer = low == 0 ? 0 : count_within(n, as_float(low - 1)) - copies;
  std::uint32_t member = next_member(n, radius, {d2, -1});
  for (int k = closer; k < rank; ++k) member = next_member(n, radius, {d2, n.index[member]});
  return member;
}

}  // namespace detail
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
