// shortshot/descriptor/voting.hpp: how one point votes for neighboring bins, written once over N axes: SHOT's
// quadrilinear interpolation as PCL computes it, the published code's rule, and others.
//
// A rule has two steps. split() takes a position along one axis and finds the bin (of the grid: the cell; of azimuths:
// the sector) it lies in and the nearer neighboring one, its partner, with the share of each (interpolation.hpp).
// combine() makes a list of votes from the shares of all axes: axis 0 radius, 1 elevation, 2 azimuth, and 3 the
// histogram's signal where the part has one.
//
// A rule that gives each point one vote for its cell and one for its partner along each axis may say so
// (`votes_for_partners`), and give their weights apart from where they go:
//
//     side()               on which side of its cell's middle a position along an axis lies, and the partner's share
//     weight_of_cell()     and
//     weight_of_partner()  in units, from the sides (or shares) along all axes
//     drops_nowhere        does a partner get no vote if the position is nowhere on the axis (BelowZero::nowhere)?
//
// The kernel then works out where they go, for two registers of points at once (short_votes.hpp) or, where there is one
// lane, without a list of votes (single_votes.hpp).
#ifndef SHORTSHOT_DESCRIPTOR_VOTING_HPP
#define SHORTSHOT_DESCRIPTOR_VOTING_HPP

#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "axis.hpp"
#include "interpolation.hpp"

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
  static constexpr bool partners_get_own_share = false;  ///< of a partner: its own axis' share alone?
  static constexpr bool votes_for_partners = true;       ///< one vote for the cell, and one for each axis' partner
  static constexpr bool drops_nowhere = false;  ///< no vote for a partner where the position is nowhere on the axis
  static constexpr int weight_bits = 2;         ///< a point counts for less than 2^weight_bits units
  /// Votes of a point, at the most.
  template <int Axes>
  static constexpr int votes = Axes + 1;

  /// Where the partner lies along one axis, and its share.
  [[nodiscard]] SHORTSHOT_INLINE static extend::Side side(const extend::Axis& axis, extend::simd::I32 position,
                                                          const extend::VoteUnit& unit) noexcept {
    extend::simd::I32 fraction = position & extend::simd::all_int((std::int32_t{1} << axis.bits) - 1);
    if (axis.below_zero != extend::BelowZero::never) {
      const extend::simd::Mask below = is_negative(position);
      fraction = keep(below, position) + drop(below, fraction);
    }
    return extend::side(axis, fraction, unit, false);
  }

  /// What the primary cell gets, in units.
  template <int Axes, class Sides>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 weight_of_cell(const Sides (&sides)[4],
                                                                         const extend::VoteUnit& unit) noexcept {
    return extend::simd::all_int(Axes * unit.one) -
           extend::simd::shift_right(extend::twice_all_partners<Axes>(sides), 1);
  }
  /// What the partner along `axis` gets, in units.
  template <class Sides>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 weight_of_partner(int axis, const Sides (&sides)[4],
                                                                            extend::simd::I32 of_cell,
                                                                            const extend::VoteUnit& unit) noexcept {
    // A share 1 - p replaced by p.
    const extend::simd::I32 one = extend::simd::all_int(unit.one);
    const extend::simd::I32 weight = (of_cell - one) + sides[axis].twice_partner;
    return FlipRadius && axis == 3 ? weight + (sides[0].twice_partner - one) : weight;
  }

  /// The cell that a position lies in along one axis, its partner, and the partner's share.
  [[nodiscard]] SHORTSHOT_INLINE static extend::Share split(const extend::Axis& axis, extend::simd::I32 position,
                                                            const extend::VoteUnit& unit) noexcept {
    return extend::share(axis, extend::cell_of(axis, position), side(axis, position, unit));
  }

  /// The votes of one point from its shares along all axes.
  template <int Axes>
  [[nodiscard]] SHORTSHOT_INLINE static extend::Votes<Axes + 1> combine(const extend::Axis (&axes)[4],
                                                                        const extend::Share (&shares)[4],
                                                                        const extend::VoteUnit& unit) noexcept {
    return extend::votes_for_cell_and_partners<AdditiveVoting, Axes>(axes, shares, unit);
  }
};

/// The published rule to the last quirk: the library's default.
using PublishedVoting = AdditiveVoting<true>;

/// SHOT's rule, its quadrilinear interpolation: each axis votes by itself. The shares of all axes ADD UP in the primary
/// cell, as in AdditiveVoting, but an axis' partner gets that axis' share alone. At most 1 + N cells a point; a vote
/// beyond the ends of radius, elevation or histogram is lost. `WrapLastBin` is a defect of PCL, in whose code the bins
/// of a histogram are counted one short: a vote from the last bin but one up to the last one goes to the first one
/// instead.
template <bool WrapLastBin>
struct SeparateVoting {
  static constexpr const char* name = WrapLastBin ? "PCL voting" : "SHOT voting";
  static constexpr bool partners_get_own_share = true;
  static constexpr bool votes_for_partners = !WrapLastBin;
  static constexpr bool drops_nowhere = true;
  static constexpr int weight_bits = 3;  // half units
  template <int Axes>
  static constexpr int votes = Axes + 1;

  [[nodiscard]] SHORTSHOT_INLINE static extend::Side side(const extend::Axis& axis, extend::simd::I32 position,
                                                          const extend::VoteUnit& unit) noexcept {
    return side_in_cell(axis, position, extend::cell_of(axis, position), unit);
  }

  template <int Axes, class Sides>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 weight_of_cell(const Sides (&sides)[4],
                                                                         const extend::VoteUnit& unit) noexcept {
    return extend::simd::all_int(2 * Axes * unit.one) - extend::twice_all_partners<Axes>(sides);
  }
  template <class Sides>
  [[nodiscard]] SHORTSHOT_INLINE static extend::simd::I32 weight_of_partner(int axis, const Sides (&sides)[4],
                                                                            extend::simd::I32,
                                                                            const extend::VoteUnit&) noexcept {
    return sides[axis].twice_partner;
  }

  [[nodiscard]] SHORTSHOT_INLINE static extend::Share split(const extend::Axis& axis, extend::simd::I32 position,
                                                            const extend::VoteUnit& unit) noexcept {
    const extend::simd::I32 cell = extend::cell_of(axis, position);
    extend::Share share = extend::share(axis, cell, side_in_cell(axis, position, cell, unit));
    if (axis.below_zero == extend::BelowZero::nowhere) share.step = drop(is_negative(position), share.step);
    return share;
  }

  template <int Axes>
  [[nodiscard]] SHORTSHOT_INLINE static extend::Votes<Axes + 1> combine(const extend::Axis (&axes)[4],
                                                                        const extend::Share (&shares)[4],
                                                                        const extend::VoteUnit& unit) noexcept {
    extend::Votes<Axes + 1> votes = extend::votes_for_cell_and_partners<SeparateVoting, Axes>(axes, shares, unit);
    if constexpr (WrapLastBin && Axes == 4) {
      const std::int32_t last = axes[3].cells - 1;
      const extend::simd::Mask wraps = shares[3].cell + shares[3].step == extend::simd::all_int(last);
      votes.index[4] = votes.index[4] - keep(wraps, extend::simd::all_int(last));
    }
    return votes;
  }

 private:
  [[nodiscard]] SHORTSHOT_INLINE static extend::Side side_in_cell(const extend::Axis& axis, extend::simd::I32 position,
                                                                  extend::simd::I32 cell,
                                                                  const extend::VoteUnit& unit) noexcept {
    extend::Side side = extend::side(axis, extend::fraction_of(axis, position, cell), unit, true);
    if (axis.below_zero == extend::BelowZero::nowhere) {  // nothing for the cell, and a partner that gets nothing
      const extend::simd::Mask nowhere = is_negative(position);
      side.twice_partner = drop(nowhere, side.twice_partner) + keep(nowhere, extend::simd::all_int(2 * unit.one));
    }
    return side;
  }
};

/// SHOT as its paper has it: the default of Shot and Cshot.
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
    return {extend::times(extend::cell_of(axis, position), axis.stride), all_int(0), all_int(0)};
  }

  template <int Axes>
  [[nodiscard]] SHORTSHOT_INLINE static extend::Votes<1> combine(const extend::Axis (&)[4],
                                                                 const extend::Share (&shares)[4],
                                                                 const extend::VoteUnit& unit) noexcept {
    return {{extend::primary_index<Axes>(shares)}, {extend::simd::all_int(unit.one)}};
  }
};

/// Multilinear interpolation (quadrilinear with a histogram): shares multiply, over all 2^N cells around the point. A
/// partition of unity (every point counts exactly once in all: what has no partner stays in the cell) and continuous at
/// every border between cells.
struct MultilinearVoting {
  static constexpr const char* name = "multilinear voting";
  static constexpr bool partners_get_own_share = false;
  static constexpr int weight_bits = 2;
  template <int Axes>
  static constexpr int votes = 1 << Axes;

  [[nodiscard]] SHORTSHOT_INLINE static extend::Share split(const extend::Axis& axis, extend::simd::I32 position,
                                                            const extend::VoteUnit& unit) noexcept {
    extend::Share share = extend::share_in_cell(axis, position, unit, false);
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
    votes.index[0] = extend::primary_index<Axes>(shares);
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

#endif  // SHORTSHOT_DESCRIPTOR_VOTING_HPP
