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

/// The smallest number in [low, high] for which `enough` holds; it does for `high`, and for all above one for which it
/// does.
template <class Predicate>
[[nodiscard]] inline std::uint32_t bisect(std::uint32_t low, std::uint32_t high, const Predicate& enough) noexcept {
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (enough(middle)) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
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
  // Bits of floats >= 0 order as the floats do.
  std::uint32_t most = 0;
  std::memcpy(&most, &radius.squared, sizeof most);
  const auto within = [&](std::uint32_t bits) { return count_within(n, as_float(bits)) - copies; };
  const std::uint32_t bits = bisect(0, most, [&](std::uint32_t limit) { return within(limit) > rank; });
  const float d2 = as_float(bits);
  const int closer = bits == 0 ? 0 : within(bits - 1);
  if (rank == closer) return next_member(n, radius, {d2, -1});

  const std::uint32_t index = bisect(0, 0xFFFFFFFFu, [&](std::uint32_t limit) {
    int equally_far = 0;
    for (std::uint32_t i = 0; i < n.size; ++i) {
      equally_far += n.d2[i] == d2 && n.index[i] <= limit && is_member(n, i, radius) ? 1 : 0;
    }
    return equally_far > rank - closer;
  });
  return next_member(n, radius, {d2, static_cast<std::int64_t>(index) - 1});
}

}  // namespace detail
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
