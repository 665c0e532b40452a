// shortshot/kernel/short_votes.hpp: votes with indices of 16 bits, where there are lanes: two registers of neighbors at
// a time. What a rule of voting for a cell and its partners (voting.hpp) says about weights stays in 32 bits, and so do
// the sums; the arithmetic of cells is the same (interpolation.hpp), in half the instructions.
//
// A vote to a partner that does not exist is not sorted out: it has a place of its own behind the end of all sums,
// which nobody looks at. Indices count from that end: those of values are below 0, and to drop one is to make it 0.
#ifndef SHORTSHOT_KERNEL_SHORT_VOTES_HPP
#define SHORTSHOT_KERNEL_SHORT_VOTES_HPP

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "../base/simd.hpp"
#include "../base/simd_shorts.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../descriptor/concepts.hpp"
#include "../descriptor/descriptor.hpp"
#include "../descriptor/interpolation.hpp"
#include "accumulate.hpp"
#include "soft_cells.hpp"
#include "vote_shares.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Two registers' shares along one axis: their cells, the way to their partners, and who has none.
struct ShortShare {
  simd::I16 cell;
  simd::I16 step;   ///< in values; see step_left_out()
  simd::I16 alone;  ///< a mask
};

/// Between one cell and the next there is nothing but a stride: where an instruction that adds has room for a constant,
/// a partner's index is that of the lower one, and the stride goes into the constant.
[[nodiscard]] constexpr int step_left_out(const Axis& axis) noexcept {
  return simd::adds_to_memory && axis.end == Beyond::nothing ? axis.stride : 0;
}

/// `cell`: of positions as they are, also beyond the ends.
template <class Voting>
[[nodiscard]] SHORTSHOT_INLINE ShortShare short_share(const Axis& axis, simd::I16 cell, simd::I16 lower) noexcept {
  using simd::like;
  const simd::I16 on_axis = cell_on(axis, cell);
  if (axis.cells == 1) return {on_axis, like(cell, 0), like(cell, -1)};
  if (axis.end == Beyond::nothing) {
    const simd::I16 step = like(cell, axis.stride - step_left_out(axis)) - keep(lower, like(cell, 2 * axis.stride));
    return {on_axis, step, is_alone(axis, on_axis, lower)};
  }
  const bool drops_nowhere = Voting::drops_nowhere && axis.below_zero == BelowZero::nowhere;
  const simd::I16 next = next_around(axis, on_axis, minus_one_or_one(lower));
  return {on_axis, times(next - on_axis, axis.stride), drops_nowhere ? is_negative(cell) : like(cell, 0)};
}

/// Votes for a part that begins `-Begin` values before the end of the descriptor.
template <class Voting, class Part, int Begin, std::uint32_t ChunkSize>
struct ShortVotes : VoteRows<Voting, Part, std::int16_t, ChunkSize> {
  static constexpr bool goes_to_distinct_places = true;  // but for votes to partners that do not exist
  static constexpr int axis_count = Part::axis_count;
  static constexpr const Axis (&axes)[4] = Part::template axes<Part::values>;
  using ShortVotes::VoteRows::count;

  ShortVotes() noexcept {}  // else `ShortVotes()` is zeros

  /// Where index 0 of vote `k` is: at the end of all sums, or behind it.
  static constexpr int origin(int k) noexcept { return k == 0 ? 0 : step_left_out(axes[k - 1]); }

  /// The votes of two registers of neighbors, from `i` on. (Weights of the first one are stored before the second one
  /// is looked at: there are not registers enough for both.)
  template <bool First, class Chunk>
  SHORTSHOT_INLINE void cast(const Chunk& chunk, std::uint32_t i, const VoteUnit& unit) noexcept {
    simd::I32 positions[4];
    Side first[4];
    unroll<axis_count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      positions[k] = position_at<k>(chunk, i);
      first[k] = Voting::side(axes[k], positions[k], unit);
    });
    cast_weights<First>(i, first, unit);
    Side second[4];
    ShortShare shares[4];
    unroll<axis_count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      const simd::I32 position = position_at<k>(chunk, i + simd::lanes);
      second[k] = Voting::side(axes[k], position, unit);
      const simd::I16 cells = narrow(shift_right(positions[k], axes[k].bits), shift_right(position, axes[k].bits));
      shares[k] = short_share<Voting>(axes[k], cells, narrow(first[k].lower, second[k].lower));
    });
    cast_weights<First>(i + simd::lanes, second, unit);
    cast_indices(i, shares);
  }

 private:
  template <int K, class Chunk>
  [[nodiscard]] SHORTSHOT_INLINE static simd::I32 position_at(const Chunk& chunk, std::uint32_t i) noexcept {
    return Part::Cells::template position<typename Part::Scale>(axes[K], K, coordinate_at<Part, K>(chunk, i));
  }

  template <bool First>
  SHORTSHOT_INLINE void cast_weights(std::uint32_t i, const Side (&sides)[4], const VoteUnit& unit) noexcept {
    simd::I32 weights[static_cast<std::size_t>(count)];
    weights[0] = Voting::template weight_of_cell<axis_count>(sides, unit);
    unroll<axis_count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      weights[k + 1] = Voting::weight_of_partner(k, sides, weights[0], unit);
    });
    this->template keep_weights<First>(i, weights);
  }

  SHORTSHOT_INLINE void cast_indices(std::uint32_t i, const ShortShare (&shares)[4]) noexcept {
    constexpr Axis radius = Part::template axes<1>[0], elevation = Part::template axes<1>[1],
                   azimuth = Part::template axes<1>[2];
    const simd::I16 cell = (times(shares[0].cell, radius.stride) + times(shares[1].cell, elevation.stride)) +
                           times(shares[2].cell, azimuth.stride);
    simd::I16 primary = times(cell, Part::values) + simd::like(cell, Begin);
    if constexpr (axis_count == 4) primary = primary + shares[3].cell;
    simd::store(this->index + i, primary);
    unroll<axis_count>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      simd::store(this->index + i + (k + 1) * ChunkSize, drop(shares[k].alone, primary + shares[k].step));
    });
  }
};

/// Room behind the end of all sums, for votes that go nowhere and for registers.
template <class... Parts>
inline constexpr int room_behind_sums = [] {
  int most = static_cast<int>(simd::lanes);
  const auto see = [&](const Axis(&axes)[4]) {
    for (const Axis& axis : axes) most = axis.stride >= most ? axis.stride + 1 : most;
  };
  (see(Parts::template axes<Parts::values>), ...);
  return most;
}();

/// Values of the sums of a descriptor with short votes; 0 if it has none: one lane, small code, other rules, a chunk of
/// less than two registers, more than 16 bits of indices.
template <std::uint32_t ChunkSize, class Voting, class... Parts>
constexpr int short_sums(Descriptor<Voting, Parts...>) noexcept {
  using D = Descriptor<Voting, Parts...>;
  constexpr bool may_be = simd::lanes > 1 && !small_code && D::is_plain && D::weight_cells == 0 && !is_soft<D>();
  if constexpr (may_be && VotesForPartners<Voting>::value && ChunkSize % (2 * simd::lanes) == 0) {
    constexpr int values = D::size + room_behind_sums<Parts...>;
    if (values <= 32768) return values;
  }
  return 0;
}

/// Sums of no vote; of the room behind them, the places where votes go.
template <class Voting, class... Parts>
SHORTSHOT_INLINE void clear_sums(Descriptor<Voting, Parts...>, float* sums) noexcept {
  using D = Descriptor<Voting, Parts...>;
  constexpr int lanes = static_cast<int>(simd::lanes);
  for (int k = 0; k < D::size; k += lanes) simd::store(sums + k, simd::all(0.0f));
  const auto clear_behind = [&](auto part) SHORTSHOT_INLINE_LAMBDA {
    using Part = decltype(part);
    unroll<4>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      sums[D::size + step_left_out(Part::template axes<Part::values>[k])] = 0.0f;
    });
  };
  sums[D::size] = 0.0f;
  (clear_behind(Parts{}), ...);
}

/// One chunk into the sums of all parts: what they have in common is worked out once.
template <class Voting, class... Parts, class Chunk, class First, class... Others>
SHORTSHOT_INLINE void accumulate_short_votes(Descriptor<Voting, Parts...>, const Chunk& chunk, VoteUnit unit,
                                             float* end, First&& first, Others&&... others) noexcept {
  constexpr bool one_grid = HaveOneGrid<Parts...>::value;
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; i += 2 * simd::lanes) {
    first.template cast<true>(chunk, i, unit);
    (others.template cast<!one_grid>(chunk, i, unit), ...);
  }
  scatter<Voting, Chunk::room, one_grid>(size, end, first, others...);
}

template <class Voting, class... Parts, std::size_t... I, class Chunk>
[[gnu::noinline]] inline void accumulate_all_short_votes(Descriptor<Voting, Parts...> descriptor,
                                                         std::index_sequence<I...>, const Chunk& chunk,
                                                         const VoteUnit& unit, float* sums) noexcept {
  using D = Descriptor<Voting, Parts...>;
  accumulate_short_votes(descriptor, chunk, unit, sums + D::size,
                         ShortVotes<Voting, Parts, D::offset(I) - D::size, Chunk::room>()...);
}

/// Bytes of a chunk, its votes and their sums.
template <std::uint32_t ChunkSize, class Voting, class... Parts>
constexpr std::size_t short_scratch_bytes(Descriptor<Voting, Parts...> descriptor) noexcept {
  using D = Descriptor<Voting, Parts...>;
  return sizeof(Chunk<typename D::Signals, ChunkSize>) + (sizeof(ShortVotes<Voting, Parts, 0, ChunkSize>) + ...) +
         sizeof(float) * static_cast<std::size_t>(short_sums<ChunkSize>(descriptor));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_SHORT_VOTES_HPP
