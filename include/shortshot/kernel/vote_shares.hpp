// shortshot/kernel/vote_shares.hpp: from where a chunk's neighbors lie to their shares among the cells of a part, and
// their votes.
#ifndef SHORTSHOT_KERNEL_VOTE_SHARES_HPP
#define SHORTSHOT_KERNEL_VOTE_SHARES_HPP

#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../descriptor/axis.hpp"
#include "../descriptor/voting.hpp"
#include "measure_signals.hpp"
#include "to_spherical.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The votes that a point has for a part.
template <class Voting, class Part>
inline constexpr int votes_of = Voting::template votes<Part::axis_count>;

/// The share of a `coordinate` along axis `k` of a part (3: its histogram's).
template <class Voting, class Cells, class Scale>
[[nodiscard]] SHORTSHOT_INLINE Share share_along_axis(const Axis& axis, int k, simd::F32 coordinate,
                                                      const VoteUnit& unit) noexcept {
  return Voting::split(axis, Cells::template position<Scale>(axis, k, coordinate), unit);
}

/// What axis `K` of a part (3: its histogram's) goes by, of one register of a chunk's neighbors from `i` on.
template <class Part, int K, class Chunk>
[[nodiscard]] SHORTSHOT_INLINE simd::F32 coordinate_at(const Chunk& chunk, std::uint32_t i) noexcept {
  if constexpr (K == 3) {
    using Signal = typename Part::Signal;
    return place_in_histogram<Signal>(simd::load(chunk.row(Chunk::template row_of<Signal>, i)));
  } else {
    return simd::load(chunk.row(K, i));
  }
}

/// One register of a chunk's neighbors in the frame's spherical coordinates.
struct Coordinates {
  simd::F32 of[3];
};

template <class Chunk>
[[nodiscard]] SHORTSHOT_INLINE Coordinates coordinates_at(const Chunk& chunk, std::uint32_t i) noexcept {
  return {{simd::load(chunk.row(0, i)), simd::load(chunk.row(1, i)), simd::load(chunk.row(2, i))}};
}

/// The shares of a point along all axes of a part, those of the grid first.
struct PointShares {
  Share axes[4];
};

/// The shares in a part's grid if every cell of it had `Values` values.
template <class Voting, class Part, int Values>
[[nodiscard]] SHORTSHOT_INLINE PointShares grid_shares(const Coordinates& at, const VoteUnit& unit) noexcept {
  PointShares shares;
  each<3>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
    shares.axes[k] = share_along_axis<Voting, typename Part::Cells, typename Part::Scale>(
        Part::template axes<Values>[k], k, at.of[k], unit);
  });
  return shares;
}

/// The same in a grid whose cells have `Factor` times as many values; the cell of all axes is the first one's.
template <int Factor>
[[nodiscard]] SHORTSHOT_INLINE PointShares widened(const PointShares& shares) noexcept {
  PointShares wide = shares;
  wide.axes[0].cell = times((shares.axes[0].cell + shares.axes[1].cell) + shares.axes[2].cell, Factor);
  wide.axes[1].cell = wide.axes[2].cell = simd::all_int(0);
  wide.axes[0].step = times(shares.axes[0].step, Factor);
  wide.axes[1].step = times(shares.axes[1].step, Factor);
  wide.axes[2].step = times(shares.axes[2].step, Factor);
  return wide;
}

/// All votes for a part of one register of a chunk's neighbors, from `i` on, whose shares in the grid are known.
/// Those of the signal are put into the same object: on a Cortex-M a copy of it costs 56 instructions per neighbor.
template <class Voting, class Part, class Chunk>
[[nodiscard]] SHORTSHOT_INLINE Votes<votes_of<Voting, Part>> votes_at(const Chunk& chunk, std::uint32_t i,
                                                                      PointShares& shares,
                                                                      const VoteUnit& unit) noexcept {
  constexpr const Axis(&axes)[4] = Part::template axes<Part::values>;
  if constexpr (Part::has_histogram) {
    const simd::F32 signal = coordinate_at<Part, 3>(chunk, i);
    shares.axes[3] = share_along_axis<Voting, typename Part::Cells, typename Part::Scale>(axes[3], 3, signal, unit);
  }
  return Voting::template combine<Part::axis_count>(axes, shares.axes, unit);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_VOTE_SHARES_HPP
