// shortshot/voting.hpp: how one point is shared among neighbouring cells, written once over N axes.
//
// A rule has two steps. split() takes a position along one axis, in cells, and finds the cell it lies in and the nearer
// neighbouring cell, its partner, with the share of each. combine() makes a list of votes from the shares of all axes:
// axis 0 radius, 1 elevation, 2 azimuth, and 3 the histogram's signal where the part has one.
#pragma once

#include "config.hpp"
#include "simd.hpp"
#include "unroll.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {

/// What lies beyond the last cell of an axis: nothing (radius, elevation, signal) or the first cell (azimuth).
enum class Beyond { nothing, first_cell };

/// One axis of a part: its number of cells, the distance of two neighbouring cells in the descriptor, and its ends.
template <int Cells, int Stride, Beyond End>
struct Axis {
  static constexpr int cells = Cells;
  static constexpr int stride = Stride;
  static constexpr Beyond end = End;
};

/// A point's share along one axis. Indices are whole numbers in floats: exact, and multiplied without integer lanes.
struct Share {
  simd::F32 cell;     ///< index of the primary cell, times the axis' stride
  simd::F32 partner;  ///< index of the partner cell minus that of the primary one; 0 where there is no partner
  simd::F32 weight;   ///< the primary cell's share; the partner's is 1 - weight
  simd::Mask has_partner;
};

/// The votes of one point: `Count` indices into the part and their weights.
template <int Count>
struct Votes {
  simd::F32 index[Count];
  simd::F32 weight[Count];
};

namespace detail {

/// The cell of a position, clamped to the axis.
template <class Axis>
[[nodiscard]] inline simd::F32 clamped_cell(simd::F32 position) noexcept {
  const simd::F32 cell = simd::truncate(position);
  return simd::max(simd::all(0.0f), simd::min(cell, simd::all(static_cast<float>(Axis::cells - 1))));
}

/// The share of a position whose distance from its cell's lower border is `fraction` (in cells).
template <class Axis>
[[nodiscard]] inline Share share(simd::F32 cell, simd::F32 fraction) noexcept {
  using simd::all;
  constexpr auto stride = static_cast<float>(Axis::stride);
  constexpr auto last = static_cast<float>(Axis::cells - 1);
  const simd::F32 weight = all(1.0f) - simd::abs(fraction - all(0.5f));
  const simd::F32 index = cell * all(stride);
  if constexpr (Axis::cells == 1) return {index, all(0.0f), weight, all(1.0f) < all(0.0f)};

  const simd::Mask upper = fraction > all(0.5f);
  const simd::F32 step = simd::negate(upper, all(-stride));
  const simd::F32 neighbor = cell + simd::negate(upper, all(-1.0f));
  if constexpr (Axis::end == Beyond::first_cell) {
    const simd::F32 around = all(static_cast<float>(Axis::cells) * stride);
    const simd::F32 up = keep(all(0.0f) > neighbor, around);
    const simd::F32 down = keep(neighbor > all(last), around);
    return {index, (step + up) - down, weight, all(0.0f) < all(1.0f)};
  }
  const simd::Mask inside = (neighbor >= all(0.0f)) & (all(last) >= neighbor);
  return {index, keep(inside, step), weight, inside};
}

template <int Axes>
[[nodiscard]] inline simd::F32 primary_index(const Share (&shares)[Axes]) noexcept {
  simd::F32 index = shares[0].cell;
  unroll<Axes - 1>([&](auto i) { index = index + shares[i + 1].cell; });
  return index;
}

}  // namespace detail

/// The additive rule of the published SSH / SCSH code: the shares of all axes ADD UP in the primary cell, and each
/// axis' partner gets the same sum with that axis' share replaced by the partner's. At most 1 + N cells a point, no
/// diagonal ones. Known properties, kept on purpose:
/// * a partner beyond the ends of radius, elevation or signal is dropped, and its weight lost;
/// * the sum of a point's votes depends on where it lies, and jumps when it crosses a border;
/// * a position on the very end of an axis (phi = 180 degrees) counts as the LOWER border of the last cell;
/// * `FlipRadius`: the signal's partner also gets the radial PARTNER's share in place of the radial cell's.
template <bool FlipRadius>
struct AdditiveVoting {
  template <int Axes>
  static constexpr int votes = Axes + 1;

  template <class Axis>
  [[nodiscard]] static Share split(simd::F32 position) noexcept {
    return detail::share<Axis>(detail::clamped_cell<Axis>(position), position - simd::truncate(position));
  }

  template <int Axes>
  [[nodiscard]] static Votes<Axes + 1> combine(const Share (&shares)[Axes]) noexcept {
    using simd::all;
    simd::F32 sum = shares[0].weight;
    detail::unroll<Axes - 1>([&](auto i) { sum = sum + shares[i + 1].weight; });

    Votes<Axes + 1> votes;
    votes.index[0] = detail::primary_index(shares);
    votes.weight[0] = sum;
    detail::unroll<Axes>([&](auto i) {
      simd::F32 weight = sum + swap_share(shares[i]);
      if (FlipRadius && i == 3) weight = weight + swap_share(shares[0]);
      votes.index[i + 1] = votes.index[0] + shares[i].partner;
      votes.weight[i + 1] = keep(shares[i].has_partner, weight);
    });
    return votes;
  }

 private:
  /// What a sum of shares changes by when a primary share w is replaced by its partner's, 1 - w.
  [[nodiscard]] static simd::F32 swap_share(const Share& share) noexcept {
    return simd::all(1.0f) - (share.weight + share.weight);
  }
};

/// The published rule to the last quirk: the library's default.
using PublishedVoting = AdditiveVoting<true>;

/// The paper's equation (2): a point counts once, in the cell it falls into.
struct HardVoting {
  template <int Axes>
  static constexpr int votes = 1;

  template <class Axis>
  [[nodiscard]] static Share split(simd::F32 position) noexcept {
    const simd::F32 index = detail::clamped_cell<Axis>(position) * simd::all(static_cast<float>(Axis::stride));
    return {index, simd::all(0.0f), simd::all(1.0f), simd::all(1.0f) < simd::all(0.0f)};
  }

  template <int Axes>
  [[nodiscard]] static Votes<1> combine(const Share (&shares)[Axes]) noexcept {
    return {{detail::primary_index(shares)}, {simd::all(1.0f)}};
  }
};

/// Multilinear interpolation: shares multiply, over all 2^N cells around the point. A partition of unity (every point
/// counts exactly once in all: what has no partner stays in the cell) and continuous at every border between cells.
struct MultilinearVoting {
  template <int Axes>
  static constexpr int votes = 1 << Axes;

  template <class Axis>
  [[nodiscard]] static Share split(simd::F32 position) noexcept {
    const simd::F32 cell = detail::clamped_cell<Axis>(position);
    Share share = detail::share<Axis>(cell, position - cell);
    share.weight = select(share.has_partner, share.weight, simd::all(1.0f));
    return share;
  }

  template <int Axes>
  [[nodiscard]] static Votes<(1 << Axes)> combine(const Share (&shares)[Axes]) noexcept {
    Votes<(1 << Axes)> votes;
    votes.index[0] = detail::primary_index(shares);
    votes.weight[0] = simd::all(1.0f);
    detail::unroll<Axes>([&](auto axis) {
      constexpr int half = 1 << decltype(axis)::value;
      detail::unroll<half>([&](auto i) {
        votes.index[half + i] = votes.index[i] + shares[axis].partner;
        votes.weight[half + i] = votes.weight[i] * (simd::all(1.0f) - shares[axis].weight);
        votes.weight[i] = votes.weight[i] * shares[axis].weight;
      });
    });
    return votes;
  }
};

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
