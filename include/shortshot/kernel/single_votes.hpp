// shortshot/kernel/single_votes.hpp: the kernel's second pass where there is one lane: each vote is added as soon as it
// is known. For speed every part has code of its own; where code shall be small all parts share one loop over tables of
// axes. The same bits.
#ifndef SHORTSHOT_KERNEL_SINGLE_VOTES_HPP
#define SHORTSHOT_KERNEL_SINGLE_VOTES_HPP

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../descriptor/axis.hpp"
#include "../descriptor/concepts.hpp"
#include "../descriptor/descriptor.hpp"
#include "../descriptor/voting.hpp"
#include "vote_shares.hpp"
#include "vote_sums.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// f(k) for the axes of a part: as many as is known while compiling, or all of `count` where code shall be small.
template <int Axes, class Function>
[[gnu::always_inline]] inline void for_each_axis([[maybe_unused]] int count, Function f) noexcept {
  if constexpr (small_code) {
    for (int k = 0; k < count; ++k) f(k);
  } else {
    unroll<Axes>(f);
  }
}

/// From a point's cell to its partner along an axis, in values; 0 where there is none.
template <class Voting>
[[nodiscard]] SHORTSHOT_INLINE std::int32_t step_to_partner(const Axis& axis, simd::I32 position, simd::I32 cell,
                                                            simd::SignMask lower) noexcept {
  const simd::I32 direction = minus_one_or_one(lower);
  if (axis.end == Beyond::first_cell) {
    if (Voting::drops_nowhere && axis.below_zero == BelowZero::nowhere && any(is_negative(position))) return 0;
    return integer_in(next_around(axis, cell, direction) - cell) * axis.stride;
  }
  const bool is_beyond =
      static_cast<std::uint32_t>(integer_in(cell + direction)) >= static_cast<std::uint32_t>(axis.cells);
  return is_beyond ? 0 : integer_in(direction) * axis.stride;
}

/// One vote of a point for the cell it lies in, and one for its partner along each axis, if there is one.
template <class Voting, class Cells, class Scale, int Axes, class CoordinateAlong>
[[gnu::always_inline]] inline void vote_for_partners(const Axis (&axes)[4], int count,
                                                     const CoordinateAlong& coordinate_along, const VoteUnit& unit,
                                                     float* values) noexcept {
  constexpr bool begins_below_zero =
      Scale::below_zero != BelowZero::never || Cells::azimuth_below_zero != BelowZero::never;
  Side sides[4];
  simd::I32 positions[4];
  simd::I32 places[4];
  std::int32_t steps[4];
  const auto step_along = [&](auto k) SHORTSHOT_INLINE_LAMBDA {
    return step_to_partner<Voting>(axes[k], positions[k], places[k], sides[k].lower);
  };
  // Without a histogram all of a fourth axis' share is its partner's, which does not exist.
  sides[3].twice_partner = simd::all_int(2 * unit.one);
  float* cell = values;
  for_each_axis<Axes>(count, [&](auto k) SHORTSHOT_INLINE_LAMBDA {
    if (!begins_below_zero && axes[k].below_zero != BelowZero::never) __builtin_unreachable();  // tables do not say so
    positions[k] = Cells::template position<Scale>(axes[k], k, coordinate_along(k));
    places[k] = cell_of(axes[k], positions[k]);
    sides[k] = Voting::side(axes[k], positions[k], unit);
    if constexpr (small_code) steps[k] = step_along(k);
    cell += integer_in(places[k]) * axes[k].stride;
  });
  const simd::I32 of_cell = Voting::template weight_of_cell<Axes>(sides, unit);
  add_vote(cell, of_cell);
  for_each_axis<Axes>(count, [&](auto k) SHORTSHOT_INLINE_LAMBDA {
    if constexpr (!small_code) steps[k] = step_along(k);  // just before it is asked for: one comparison does both
    if (may_be_alone(axes[k]) && steps[k] == 0) return;
    add_vote(cell + steps[k], Voting::weight_of_partner(k, sides, of_cell, unit));
  });
}

/// The votes of neighbor `i` of a chunk for one part, added at once: there is one lane only.
template <class Voting, class Part, class Chunk>
SHORTSHOT_INLINE void add_point(const Chunk& chunk, std::uint32_t i, const Coordinates& at, const VoteUnit& unit,
                                float* values) noexcept {
  if constexpr (VotesForPartners<Voting>::value) {
    const auto coordinate_along = [&](auto k) SHORTSHOT_INLINE_LAMBDA {
      if constexpr (k == 3) {
        return coordinate_at<Part, 3>(chunk, i);
      } else {
        return at.of[k];
      }
    };
    vote_for_partners<Voting, typename Part::Cells, typename Part::Scale, Part::axis_count>(
        Part::template axes<Part::values>, Part::axis_count, coordinate_along, unit, values);
  } else {
    constexpr int count = votes_of<Voting, Part>;
    PointShares shares = grid_shares<Voting, Part, Part::values>(at, unit);
    const Votes<count> votes = votes_at<Voting, Part>(chunk, i, shares, unit);
    each<count>([&](auto k)
                    SHORTSHOT_INLINE_LAMBDA { add_vote(values + integer_in(votes.index[k]), votes.weight[k]); });
  }
}

/// All parts in one loop: what they have in common is worked out once.
template <class Voting, class... Parts, std::size_t... I, class Chunk>
[[gnu::noinline]] inline void add_points(Descriptor<Voting, Parts...>, std::index_sequence<I...>, const Chunk& chunk,
                                         VoteUnit unit, float* out) noexcept {
  using D = Descriptor<Voting, Parts...>;
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; ++i) {
    const Coordinates at = coordinates_at(chunk, i);
    (add_point<Voting, Parts>(chunk, i, at, unit, out + D::offset(I)), ...);
  }
}

/// The row of a chunk that has the signal of a part; 0 if the part has no histogram.
template <class Part, class Chunk>
constexpr int signal_row() noexcept {
  if constexpr (Part::has_histogram) {
    return Chunk::template row_of<typename Part::Signal>;
  } else {
    return 0;
  }
}

/// The signal of a part if it is a signed one.
template <class Part>
using SignedOf = std::conditional_t<Part::Signal::is_signed, typename Part::Signal, void>;

/// The same of one part where code shall be small: this function for all parts with these rules. `signal` is the row of
/// the part's signal, or 0 if it has no histogram.
template <class Voting, class Cells, class Scale, class Signed, class Chunk>
[[gnu::noinline]] inline void add_points_of_part(const Chunk& chunk, const Axis (&axes)[4], int signal,
                                                 const VoteUnit& unit, float* values) noexcept {
  for (std::uint32_t i = 0; i < chunk.size; ++i) {
    const auto coordinate_along = [&](int k) SHORTSHOT_INLINE_LAMBDA {
      const simd::F32 coordinate = simd::load(chunk.row(k == 3 ? signal : k, i));
      if constexpr (!std::is_void<Signed>::value) {
        if (k == 3) return place_in_histogram<Signed>(coordinate);
      }
      return coordinate;
    };
    const int count = signal == 0 ? 3 : 4;
    if constexpr (VotesForPartners<Voting>::value) {
      vote_for_partners<Voting, Cells, Scale, 4>(axes, count, coordinate_along, unit, values);
    } else {
      Share shares[4];
      // Without a histogram all of a fourth axis' share is its partner's, which does not exist.
      shares[3] = {simd::all_int(0), simd::all_int(0), simd::all_int(2 * unit.one)};
      for (int k = 0; k < count; ++k) {
        shares[k] = share_along_axis<Voting, Cells, Scale>(axes[k], k, coordinate_along(k), unit);
      }
      const auto votes = Voting::template combine<4>(axes, shares, unit);
      for (int k = 0; k < Voting::template votes<4>; ++k) {
        add_vote(values + integer_in(votes.index[k]), votes.weight[k]);
      }
    }
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SINGLE_VOTES_HPP
