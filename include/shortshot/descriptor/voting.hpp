// shortshot/descriptor/voting.hpp: how one point is shared among neighboring cells, written once over N axes.
//
// A rule has two steps. split() takes a position along one axis and finds the cell it lies in and the nearer
// neighboring cell, its partner, with the share of each. combine() makes a list of votes from the shares of all axes:
// axis 0 radius, 1 elevation, 2 azimuth, and 3 the histogram's signal where the part has one.
//
// All of it is integer arithmetic: shares are added up exactly, and indices need no conversion.
#pragma once

#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "axis.hpp"

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// The fixed-point unit of all votes: `one`, a power of two, is a whole share. A rule may count twice as much for it;
/// its `weight_bits` say how much that makes of a point: less than 2^weight_bits units, or just as much.
struct VoteUnit {
  int bits;
  std::int32_t one;
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// A point's share along one axis.
struct Share {
  simd::I32 cell;           ///< index of the primary cell, times the axis' stride
  simd::I32 step;           ///< index of the partner cell minus that of the primary one; 0 where there is no partner
  simd::I32 twice_partner;  ///< twice the partner's share in units: 0 to 1, to 3 below zero; the rest is the cell's
};

/// The votes of one point: `Count` indices into the part and their weights, in units.
template <int Count>
struct Votes {
  simd::I32 index[Count];
  simd::I32 weight[Count];
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The cell of a position. The very end of the axis is the upper border of the last cell.
[[nodiscard]] SHORTSHOT_INLINE simd::I32 cell_of(const Axis& axis, simd::I32 position) noexcept {
  const simd::I32 cell = simd::small_min(simd::shift_right(position, axis.bits), simd::all_int(axis.cells - 1));
  return axis.below_zero == BelowZero::never ? cell : simd::small_max(cell, simd::all_int(0));
}

/// Cells, or -1, 0 or 1 of them, times a number of values below 2^22.
[[nodiscard]] SHORTSHOT_INLINE simd::I32 times(simd::I32 a, std::int32_t factor) noexcept {
  if (factor == 1) return a;
  const simd::I32 low = simd::small_product(a, simd::all_int(factor & 32767));
  return factor < 32768 ? low : low + simd::shift_left(simd::small_product(a, simd::all_int(factor >> 15)), 15);
}

/// From a cell to the next one in a direction (1 or -1), around the ends.
[[nodiscard]] SHORTSHOT_INLINE simd::I32 next_around(const Axis& axis, simd::I32 cell, simd::I32 direction) noexcept {
  using simd::all_int;
  const simd::I32 next = cell + direction;
  if (!small_code && (axis.cells & (axis.cells - 1)) == 0) return next & all_int(axis.cells - 1);
  return (next + keep(is_negative(next), all_int(axis.cells))) -
         keep(next > all_int(axis.cells - 1), all_int(axis.cells));
}

/// The share of a position in a cell: fraction 0 is the cell's lower border, 2^axis.bits its upper one. `rounds`: the
/// partner's share is rounded to the nearest unit, not down.
[[nodiscard]] SHORTSHOT_INLINE Share share(const Axis& axis, simd::I32 cell, simd::I32 fraction, const VoteUnit& unit,
                                           bool rounds) noexcept {
  using simd::all_int;
  const std::int32_t half = std::int32_t{1} << (axis.bits - 1);
  const simd::I32 side = fraction - all_int(half + 1);
  const simd::Mask lower = is_negative(side);  // the middle of the cell included
  const simd::I32 direction = minus_one_or_one(lower);
  // The partner's share is the distance from the middle; ~side = -side - 1 is what is left up to it.
  simd::I32 distance = invert(lower, side);
  const int finer_bits = axis.bits - unit.bits - 1;
  if (rounds) distance = distance + all_int((std::int32_t{1} << finer_bits) >> 1);
  const simd::I32 twice_partner = simd::shift_right(distance, finer_bits);
  const simd::I32 index = times(cell, axis.stride);
  if (axis.cells == 1) return {index, all_int(0), twice_partner};
  if (axis.end == Beyond::first_cell) {
    return {index, times(next_around(axis, cell, direction) - cell, axis.stride), twice_partner};
  }
  const simd::Mask alone = cell == drop(lower, all_int(axis.cells - 1));  // first and lower, or last and upper
  return {index, drop(alone, times(direction, axis.stride)), twice_partner};
}

/// The share of a position in the cell it lies in.
[[nodiscard]] SHORTSHOT_INLINE Share share_in_cell(const Axis& axis, simd::I32 position, const VoteUnit& unit,
                                                   bool rounds) noexcept {
  const simd::I32 cell = cell_of(axis, position);
  return share(axis, cell, position - simd::shift_left(cell, axis.bits), unit, rounds);
}

/// Are there positions on this axis without a partner?
[[nodiscard]] constexpr bool may_be_alone(const Axis& axis) noexcept {
  return small_code || axis.cells == 1 || axis.end == Beyond::nothing || axis.below_zero == BelowZero::nowhere;
}

template <int Axes>
[[nodiscard]] SHORTSHOT_INLINE simd::I32 primary_index(const Share (&shares)[4]) noexcept {
  simd::I32 index = shares[0].cell;
  each<Axes - 1>([&](auto i) { index = index + shares[i + 1].cell; });
  return index;
}

/// The sum of all axes' shares, twice, that partners have.
template <int Axes>
[[nodiscard]] SHORTSHOT_INLINE simd::I32 twice_all_partners(const Share (&shares)[4]) noexcept {
  simd::I32 sum = shares[0].twice_partner;
  each<Axes - 1>([&](auto i) { sum = sum + shares[i + 1].twice_partner; });
  return sum;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// The additive rule of the published SSH / SCSH code: the shares of all axes ADD UP in the primary cell, and each
/// axis' partner gets the same sum with that axis' share replaced by the partner's. At most 1 + N cells a point, no
/// diagonal ones. Known properties, kept on purpose:
/// * a partner beyond the ends of radius, elevation or signal is dropped, and its weight lost;
/// * the sum of a point's votes depends on where it lies, and jumps when it crosses a border;
/// * a position on the very end of an axis (phi = 180 degrees) counts as the LOWER border of the last cell;
/// * `FlipRadius`: the signal's partner also gets the radial PARTNER's share in place of the radial cell's.
template <bool FlipRadius>
struct AdditiveVoting {
  static constexpr const char* name = FlipRadius ? "published voting" : "additive voting";  ///< for layout_of()
  static constexpr bool partners_get_own_share = false;
  static constexpr int weight_bits = 2;
  template <int Axes>
  static constexpr int votes = Axes + 1;

  [[nodiscard]] SHORTSHOT_INLINE static extend::Share split(const extend::Axis& axis, extend::simd::I32 position,
                                                            const extend::VoteUnit& unit) noexcept {
    extend::simd::I32 fraction = position & extend::simd::all_int((std::int32_t{1} << axis.bits) - 1);
    if (axis.below_zero != extend::BelowZero::never) {
      const extend::simd::Mask below = is_negative(position);
      fraction = keep(below, position) + drop(below, fraction);
    }
    return detail::share(axis, detail::cell_of(axis, position), fraction, unit, false);
  }

  template <int Axes>
  [[nodiscard]] SHORTSHOT_INLINE static extend::Votes<Axes + 1> combine(const extend::Axis (&axes)[4],
                                                                        const extend::Share (&shares)[4],
                                                                        const extend::VoteUnit& unit) noexcept {
    using extend::simd::all_int;
    const extend::simd::I32 sum =
        all_int(Axes * unit.one) - extend::simd::shift_right(detail::twice_all_partners<Axes>(shares), 1);
    const extend::simd::I32 rest = sum - all_int(unit.one);

    extend::Votes<Axes + 1> votes;
    votes.index[0] = detail::primary_index<Axes>(shares);
    votes.weight[0] = sum;
    detail::each<Axes>([&](auto i) {
      // A share 1 - p replaced by p.
      extend::simd::I32 weight = rest + shares[i].twice_partner;
      if (FlipRadius && i == 3) weight = weight + (shares[0].twice_partner - all_int(unit.one));
      votes.index[i + 1] = votes.index[0] + shares[i].step;
      votes.weight[i + 1] = detail::may_be_alone(axes[i]) ? drop(shares[i].step == all_int(0), weight) : weight;
    });
    return votes;
  }
};

/// The published rule to the last quirk: the library's default.
using PublishedVoting = AdditiveVoting<true>;

/// SHOT's rule: each axis votes by itself. The shares of all axes ADD UP in the primary cell, as in AdditiveVoting, but
/// an axis' partner gets that axis' share alone. At most 1 + N cells a point; a vote beyond the ends of radius,
/// elevation or histogram is lost. `WrapLastBin` is a defect of PCL, in whose code the bins of a histogram are counted
/// one short: a vote from the last bin but one up to the last one goes to the first one instead.
template <bool WrapLastBin>
struct SeparateVoting {
  static constexpr const char* name = WrapLastBin ? "PCL voting" : "SHOT voting";
  static constexpr bool partners_get_own_share = true;
  static constexpr int weight_bits = 3;  // half units
  template <int Axes>
  static constexpr int votes = Axes + 1;

  [[nodiscard]] SHORTSHOT_INLINE static extend::Share split(const extend::Axis& axis, extend::simd::I32 position,
                                                            const extend::VoteUnit& unit) noexcept {
    extend::Share share = detail::share_in_cell(axis, position, unit, true);
    if (axis.below_zero == extend::BelowZero::nowhere) {  // nothing for the cell, and a partner that gets nothing
      const extend::simd::Mask nowhere = is_negative(position);
      share.twice_partner = drop(nowhere, share.twice_partner) + keep(nowhere, extend::simd::all_int(2 * unit.one));
      share.step = drop(nowhere, share.step);
    }
    return share;
  }

  template <int Axes>
  [[nodiscard]] SHORTSHOT_INLINE static extend::Votes<Axes + 1> combine(const extend::Axis (&axes)[4],
                                                                        const extend::Share (&shares)[4],
                                                                        const extend::VoteUnit& unit) noexcept {
    using extend::simd::all_int;
    extend::Votes<Axes + 1> votes;
    votes.index[0] = detail::primary_index<Axes>(shares);
    votes.weight[0] = all_int(2 * Axes * unit.one) - detail::twice_all_partners<Axes>(shares);
    detail::each<Axes>([&](auto i) {
      const extend::simd::I32 weight = shares[i].twice_partner;
      extend::simd::I32 index = votes.index[0] + shares[i].step;
      if (WrapLastBin && i == 3) {
        const std::int32_t last = axes[3].cells - 1;
        index = index - keep(shares[3].cell + shares[3].step == all_int(last), all_int(last));
      }
      votes.index[i + 1] = index;
      votes.weight[i + 1] = detail::may_be_alone(axes[i]) ? drop(shares[i].step == all_int(0), weight) : weight;
    });
    return votes;
  }
};

using ShotVoting = SeparateVoting<false>;
using PclVoting = SeparateVoting<true>;  ///< equal to PCL to the last quirk: for what is compared with PCL's output

/// The paper's equation (2): a point counts once, in the cell it falls into.
struct HardVoting {
  static constexpr const char* name = "hard voting";
  static constexpr bool partners_get_own_share = false;
  static constexpr int weight_bits = 2;
  template <int Axes>
  static constexpr int votes = 1;

  [[nodiscard]] SHORTSHOT_INLINE static extend::Share split(const extend::Axis& axis, extend::simd::I32 position,
                                                            const extend::VoteUnit&) noexcept {
    using extend::simd::all_int;
    return {detail::times(detail::cell_of(axis, position), axis.stride), all_int(0), all_int(0)};
  }

  template <int Axes>
  [[nodiscard]] SHORTSHOT_INLINE static extend::Votes<1> combine(const extend::Axis (&)[4],
                                                                 const extend::Share (&shares)[4],
                                                                 const extend::VoteUnit& unit) noexcept {
    return {{detail::primary_index<Axes>(shares)}, {extend::simd::all_int(unit.one)}};
  }
};

/// Multilinear interpolation: shares multiply, over all 2^N cells around the point. A partition of unity (every point
/// counts exactly once in all: what has no partner stays in the cell) and continuous at every border between cells.
struct MultilinearVoting {
  static constexpr const char* name = "multilinear voting";
  static constexpr bool partners_get_own_share = false;
  static constexpr int weight_bits = 2;
  template <int Axes>
  static constexpr int votes = 1 << Axes;

  [[nodiscard]] SHORTSHOT_INLINE static extend::Share split(const extend::Axis& axis, extend::simd::I32 position,
                                                            const extend::VoteUnit& unit) noexcept {
    extend::Share share = detail::share_in_cell(axis, position, unit, false);
    share.twice_partner = drop(share.step == extend::simd::all_int(0), share.twice_partner);
    return share;
  }

  template <int Axes>
  [[nodiscard]] SHORTSHOT_INLINE static extend::Votes<(1 << Axes)> combine(const extend::Axis (&)[4],
                                                                           const extend::Share (&shares)[4],
                                                                           const extend::VoteUnit& unit) noexcept {
    const extend::simd::F32 half = extend::simd::all(0.5f / static_cast<float>(unit.one));
    extend::Votes<(1 << Axes)> votes;
    extend::simd::F32 weight[1 << Axes];
    votes.index[0] = detail::primary_index<Axes>(shares);
    weight[0] = extend::simd::all(static_cast<float>(unit.one));
    detail::unroll<Axes>([&](auto axis) {
      constexpr int count = 1 << decltype(axis)::value;
      const extend::simd::F32 partner = to_float(shares[axis].twice_partner) * half;
      detail::unroll<count>([&](auto i) {
        votes.index[count + i] = votes.index[i] + shares[axis].step;
        weight[count + i] = weight[i] * partner;
        weight[i] = weight[i] - weight[count + i];
      });
    });
    detail::each<(1 << Axes)>([&](auto i) { votes.weight[i] = round_to_int(weight[i]); });
    return votes;
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot
