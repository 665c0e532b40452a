// shortshot/descriptor/interpolation.hpp: linear interpolation along one axis: how a point is shared between the bin it
// lies in and the nearer neighboring one, its partner.
//
// All of it is integer arithmetic: shares are added up exactly, and indices need no conversion. A partner's share is
// kept twice, in half units, because it is the distance from the bin's middle in units of half a bin.
#ifndef SHORTSHOT_DESCRIPTOR_INTERPOLATION_HPP
#define SHORTSHOT_DESCRIPTOR_INTERPOLATION_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../base/simd_shorts.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "axis.hpp"

namespace shortshot::extend {
inline namespace SHORTSHOT_TYPES {

/// The fixed-point unit of all votes: `one`, a power of two, is a whole share. A rule may count twice as much for it;
/// its `weight_bits` say how much that makes of a point: less than 2^weight_bits units, or just as much.
struct VoteUnit {
  int bits;          ///< one is 2^bits
  std::int32_t one;  ///< a whole share
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
  simd::I32 index[static_cast<std::size_t>(Count)];   ///< of cells, in the part
  simd::I32 weight[static_cast<std::size_t>(Count)];  ///< what each gets
};

// Cells are counted in lanes of 32 bits (I32), or of 16 (I16), two registers at a time: `Int`. `Lower` is a mask of
// them.

/// Cells on the axis: of those beyond its ends, the last and the first one. (The very end of the axis is the upper
/// border of the last cell.)
template <class Int>
[[nodiscard]] SHORTSHOT_INLINE Int cell_on(const Axis& axis, Int cell) noexcept {
  if (axis.reaches_end || detail::small_code) cell = simd::small_min(cell, simd::like(cell, axis.cells - 1));
  const bool saturates = simd::saturates && !detail::small_code && (axis.cells & (axis.cells - 1)) == 0;
  return axis.below_zero == BelowZero::never && !saturates ? cell : simd::small_max(cell, simd::like(cell, 0));
}

/// The cell of a position.
[[nodiscard]] SHORTSHOT_INLINE simd::I32 cell_of(const Axis& axis, simd::I32 position) noexcept {
  return cell_on(axis, simd::shift_right(position, axis.bits));
}

/// Cells, or -1, 0 or 1 of them, times a number of values below 2^22.
[[nodiscard]] SHORTSHOT_INLINE simd::I32 times(simd::I32 a, std::int32_t factor) noexcept {
  if (factor == 1) return a;
  const simd::I32 low = simd::small_product(a, simd::all_int(factor & 32767));
  return factor < 32768 ? low : low + simd::shift_left(simd::small_product(a, simd::all_int(factor >> 15)), 15);
}

[[nodiscard]] SHORTSHOT_INLINE simd::I16 times(simd::I16 a, std::int32_t factor) noexcept {
  const bool is_shift = (factor & (factor - 1)) == 0;
  return is_shift ? simd::I16{a.v * simd::like(a, factor).v} : a * simd::like(a, factor);
}

/// From a cell to the next one in a direction (1 or -1), around the ends.
template <class Int>
[[nodiscard]] SHORTSHOT_INLINE Int next_around(const Axis& axis, Int cell, Int direction) noexcept {
  const Int next = cell + direction;
  if (!detail::small_code && (axis.cells & (axis.cells - 1)) == 0) return next & simd::like(next, axis.cells - 1);
  return (next + keep(is_negative(next), simd::like(next, axis.cells))) -
         keep(next > simd::like(next, axis.cells - 1), simd::like(next, axis.cells));
}

/// Is there no cell on that side: first and lower, or last and upper?
template <class Int, class Lower>
[[nodiscard]] SHORTSHOT_INLINE auto is_alone(const Axis& axis, Int cell, Lower lower) noexcept {
  return cell == drop(lower, simd::like(cell, axis.cells - 1));
}

/// Where in its cell a position lies.
struct Side {
  simd::SignMask lower;     ///< its partner is the lower neighbor: it lies below the cell's middle, or on it
  simd::I32 twice_partner;  ///< as in a Share
};

/// Fraction 0 is the cell's lower border, 2^axis.bits its upper one. `rounds`: the partner's share is rounded to the
/// nearest unit, not down.
[[nodiscard]] SHORTSHOT_INLINE Side side(const Axis& axis, simd::I32 fraction, const VoteUnit& unit,
                                         bool rounds) noexcept {
  using simd::all_int;
  const std::int32_t half = std::int32_t{1} << (axis.bits - 1);
  const simd::I32 side = fraction - all_int(half + 1);
  const simd::SignMask lower = is_negative(side);
  // The partner's share is the distance from the middle; ~side = -side - 1 is what is left up to it.
  simd::I32 distance = invert(lower, side);
  const int finer_bits = axis.bits - unit.bits - 1;
  if (rounds) distance = distance + all_int((std::int32_t{1} << finer_bits) >> 1);
  return {lower, simd::shift_right(distance, finer_bits)};
}

/// The share of a position on a side of a cell.
[[nodiscard]] SHORTSHOT_INLINE Share share(const Axis& axis, simd::I32 cell, const Side& side) noexcept {
  using simd::all_int;
  const simd::I32 direction = minus_one_or_one(side.lower);
  const simd::I32 index = times(cell, axis.stride);
  if (axis.cells == 1) return {index, all_int(0), side.twice_partner};
  if (axis.end == Beyond::first_cell) {
    return {index, times(next_around(axis, cell, direction) - cell, axis.stride), side.twice_partner};
  }
  return {index, drop(is_alone(axis, cell, side.lower), times(direction, axis.stride)), side.twice_partner};
}

/// How far above its cell's lower border a position is. (On the very end of the axis: a whole cell.)
[[nodiscard]] SHORTSHOT_INLINE simd::I32 fraction_of(const Axis& axis, simd::I32 position, simd::I32 cell) noexcept {
  if (!detail::small_code && !axis.reaches_end && axis.below_zero != BelowZero::first_cell) {
    return position & simd::all_int((std::int32_t{1} << axis.bits) - 1);
  }
  return position - simd::shift_left(cell, axis.bits);
}

/// The share of a position in the cell it lies in.
[[nodiscard]] SHORTSHOT_INLINE Share share_in_cell(const Axis& axis, simd::I32 position, const VoteUnit& unit,
                                                   bool rounds) noexcept {
  const simd::I32 cell = cell_of(axis, position);
  return share(axis, cell, side(axis, fraction_of(axis, position, cell), unit, rounds));
}

/// Are there positions on this axis without a partner?
[[nodiscard]] constexpr bool may_be_alone(const Axis& axis) noexcept {
  return detail::small_code || axis.cells == 1 || axis.end == Beyond::nothing || axis.below_zero == BelowZero::nowhere;
}

/// Index of the primary cell in the part, from the shares along `Axes` axes.
template <int Axes>
[[nodiscard]] SHORTSHOT_INLINE simd::I32 primary_index(const Share (&shares)[4]) noexcept {
  simd::I32 index = shares[0].cell;
  detail::each<Axes - 1>([&](auto i) { index = index + shares[i + 1].cell; });
  return index;
}

/// The sum of all axes' shares, twice, that partners have. (Of `Shares`, or of sides.)
template <int Axes, class Shares>
[[nodiscard]] SHORTSHOT_INLINE simd::I32 twice_all_partners(const Shares (&shares)[4]) noexcept {
  simd::I32 sum = shares[0].twice_partner;
  detail::each<Axes - 1>([&](auto i) { sum = sum + shares[i + 1].twice_partner; });
  return sum;
}

/// The votes of a rule with one for the cell and one for the partner along each axis. Those to partners that do not
/// exist get no weight.
template <class Voting, int Axes>
[[nodiscard, gnu::always_inline]] inline Votes<Axes + 1> votes_for_cell_and_partners(const Axis (&axes)[4],
                                                                                     const Share (&shares)[4],
                                                                                     const VoteUnit& unit) noexcept {
  Votes<Axes + 1> votes;
  votes.index[0] = primary_index<Axes>(shares);
  votes.weight[0] = Voting::template weight_of_cell<Axes>(shares, unit);
  detail::each<Axes>([&](auto i) {
    const simd::I32 weight = Voting::weight_of_partner(i, shares, votes.weight[0], unit);
    votes.index[i + 1] = votes.index[0] + shares[i].step;
    votes.weight[i + 1] = may_be_alone(axes[i]) ? drop(shares[i].step == simd::all_int(0), weight) : weight;
  });
  return votes;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_DESCRIPTOR_INTERPOLATION_HPP
