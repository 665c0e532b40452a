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
  simd::I32 index[static_cast<std::size_t>(Count)];
  simd::I32 weight[static_cast<std::size_t>(Count)];
};

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
  if (!detail::small_code && (axis.cells & (axis.cells - 1)) == 0) return next & all_int(axis.cells - 1);
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
  return detail::small_code || axis.cells == 1 || axis.end == Beyond::nothing || axis.below_zero == BelowZero::nowhere;
}

template <int Axes>
[[nodiscard]] SHORTSHOT_INLINE simd::I32 primary_index(const Share (&shares)[4]) noexcept {
  simd::I32 index = shares[0].cell;
  detail::each<Axes - 1>([&](auto i) { index = index + shares[i + 1].cell; });
  return index;
}

/// The sum of all axes' shares, twice, that partners have.
template <int Axes>
[[nodiscard]] SHORTSHOT_INLINE simd::I32 twice_all_partners(const Share (&shares)[4]) noexcept {
  simd::I32 sum = shares[0].twice_partner;
  detail::each<Axes - 1>([&](auto i) { sum = sum + shares[i + 1].twice_partner; });
  return sum;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

#endif  // SHORTSHOT_DESCRIPTOR_INTERPOLATION_HPP
