// shortshot/accumulate.hpp: the kernel's second pass. A chunk of located neighbours is shared among the cells of each
// part, and their votes are added up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "color.hpp"
#include "color_source.hpp"
#include "config.hpp"
#include "descriptor.hpp"
#include "locate.hpp"
#include "simd.hpp"
#include "unroll.hpp"
#include "voting.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// Axes of a part: three of its grid, and the histogram's where it has one. The votes of a point for it.
template <class Part>
inline constexpr int axes_of = Part::has_histogram ? 4 : 3;
template <class Voting, class Part>
inline constexpr int votes_of = Voting::template votes<axes_of<Part>>;

/// The signal of Occupancy: none.
struct NoSignal {
  template <class Colors>
  explicit NoSignal(const Colors&) noexcept {}
};

/// The signal of NormalCosine, 0..1.
struct NormalSignal {
  template <class Colors>
  explicit NormalSignal(const Colors&) noexcept {}
  template <class Chunk>
  [[nodiscard]] simd::F32 operator()(const Chunk& chunk, std::uint32_t i) const noexcept {
    return simd::load(chunk.cosine(i)) * simd::all(0.5f) + simd::all(0.5f);
  }
};

/// The signal of ColorDistance: how far neighbours' colours are from the key point's.
template <class Colors>
struct ColorSignal {
  Colors colors;  // a copy: no store to the chunk can change it
  LabLanes reference;
  explicit ColorSignal(const Colors& source) noexcept : colors(source), reference(in_all_lanes(source.reference)) {}
  template <class Chunk>
  [[nodiscard]] simd::F32 operator()(const Chunk& chunk, std::uint32_t i) const noexcept {
    return color_distances(colors_at(colors, chunk.index + i), reference);
  }
};

template <class Part, class Colors>
using SignalOf = std::conditional_t<Part::Signal::needs_colors, ColorSignal<Colors>,
                                    std::conditional_t<Part::Signal::needs_normals, NormalSignal, NoSignal>>;

/// Shares of one register of neighbours along the axes of a grid.
struct GridShares {
  simd::I32 cell;  ///< of all three axes
  Share axes[3];   ///< their cells left out
};

/// The shares of a chunk's neighbours, from `i` on, in the grid of a part if every cell of it had `Values` values.
template <class Voting, class Part, int Values, class Chunk>
[[nodiscard, gnu::always_inline]] inline GridShares share_among_cells(const Chunk& chunk, std::uint32_t i,
                                                                      const VoteUnit& unit) noexcept {
  using simd::all;
  using R = typename Part::template RadialAxis<Values>;
  using E = typename Part::template ElevationAxis<Values>;
  using A = typename Part::template AzimuthAxis<Values>;
  using Cells = typename Part::Cells;
  const simd::F32 shells = Part::Scale::template position<R::cells>(simd::load(chunk.distance(i)), R::one);
  const simd::F32 elevation = Cells::elevation(simd::load(chunk.elevation(i)));
  const simd::F32 azimuth = simd::load(chunk.azimuth(i));
  const auto scaled = [](simd::F32 fraction, int cells, float one) {
    return Cells::position(fraction * all(static_cast<float>(cells) * one));
  };
  simd::I32 around = scaled(azimuth, A::cells, A::one);
  if constexpr (Cells::has_poles) around = invert(is_negative(bits_of(azimuth)), around);  // 0 to -1: nowhere
  GridShares shares{
      {},
      {Voting::template split<R>(Cells::position(shells), unit),
       Voting::template split<E>(scaled(elevation, E::cells, E::one), unit), Voting::template split<A>(around, unit)}};
  shares.cell = (shares.axes[0].cell + shares.axes[1].cell) + shares.axes[2].cell;
  return shares;
}

/// A share of `Factor` times as many values a cell.
template <int Factor>
[[nodiscard, gnu::always_inline]] inline Share widened(const Share& share) noexcept {
  return {simd::all_int(0), times<Factor>(share.step), share.twice_partner, share.alone};
}

/// Is vote `k` of a neighbour, to its partner along an axis of the grid, of the same weight for all parts on the grid?
template <class Voting>
constexpr bool is_shared(int k) noexcept {
  return Voting::partners_get_own_share && 1 <= k && k <= 3;
}

/// The integers that votes are added to live in the caller's output array, bit for bit, until they are normalised: no
/// second array is needed. memcpy is how C++ says that; compilers make one add of it.
inline void add_bits(float* value, std::int32_t weight) noexcept {
  std::int32_t sum = 0;
  std::memcpy(&sum, value, sizeof sum);
  sum += weight;
  std::memcpy(value, &sum, sizeof sum);
}

/// The votes of a chunk for the part that begins at value `Offset` of the descriptor, lane-wise: `count` arrays of
/// positions in the part, and as many of weights. Votes go through memory: taken out of registers lane by lane they
/// would cost twice as much.
template <class Voting, class PartType, int Offset, class Signal>
struct ChunkVotes {
  using Part = PartType;
  static constexpr int offset = Offset;
  static constexpr int count = votes_of<Voting, Part>;
  Signal signal;
  std::int32_t index[count * chunk_size];
  std::int32_t weight[count * chunk_size];

  template <class Colors>
  explicit ChunkVotes(const Colors& colors) noexcept : signal(colors) {}

  /// The votes of one register of neighbours, from `i` on, whose shares are those in the part's grid if every cell had
  /// `Values` values. Weights that the `First` part on the grid has as well are kept there only.
  template <int Values, bool First, class Chunk>
  [[gnu::always_inline]] void cast(const Chunk& chunk, std::uint32_t i, const GridShares& grid,
                                   const VoteUnit& unit) noexcept {
    using R = typename Part::template RadialAxis<>;
    using E = typename Part::template ElevationAxis<>;
    using A = typename Part::template AzimuthAxis<>;
    constexpr int factor = Part::values / Values;
    Share r = widened<factor>(grid.axes[0]);
    r.cell = times<factor>(grid.cell);
    const Share e = widened<factor>(grid.axes[1]);
    const Share a = widened<factor>(grid.axes[2]);
    if constexpr (Part::has_histogram) {
      using S = typename Part::SignalAxis;
      const simd::I32 position = Part::Cells::template bin_position<S>(signal(chunk, i));
      const Share s = Voting::template split<S>(position, unit);
      store<First>(i, Voting::template combine<R, E, A, S>({r, e, a, s}, unit));
    } else {
      store<First>(i, Voting::template combine<R, E, A>({r, e, a}, unit));
    }
  }

 private:
  template <bool First>
  [[gnu::always_inline]] void store(std::uint32_t i, const Votes<count>& votes) noexcept {
    unroll<count>([&](auto k) {
      simd::store(index + i + k * chunk_size, votes.index[k]);
      if constexpr (First || !is_shared<Voting>(k)) simd::store(weight + i + k * chunk_size, votes.weight[k]);
    });
  }
};

/// The largest number of votes that a neighbour has for any of these parts.
template <class First, class... Others>
inline constexpr int votes_of_most = [] {
  int most = First::count;
  ((most = Others::count > most ? Others::count : most), ...);
  return most;
}();

/// Vote `K` of neighbour `i` of a chunk, of the weight that `source` has.
template <int K, class Votes, class Source>
[[gnu::always_inline]] inline void add_vote(float* out, const Votes& votes, const Source& source,
                                            std::uint32_t i) noexcept {
  constexpr std::uint32_t first = K * chunk_size;
  if constexpr (K < Votes::count) {
    add_bits(out + Votes::offset + votes.index[first + i], source.weight[first + i]);
  }
}

/// All votes of neighbour `i` of a chunk, for all parts on one grid.
template <class Voting, class First, class... Others>
[[gnu::always_inline]] inline void add_votes(std::uint32_t i, float* out, const First& first,
                                             const Others&... others) noexcept {
  unroll<votes_of_most<First, Others...>>([&](auto k) {
    add_vote<k>(out, first, first, i);
    if constexpr (is_shared<Voting>(k)) {
      (add_vote<k>(out, others, first, i), ...);
    } else {
      (add_vote<k>(out, others, others, i), ...);
    }
  });
}

/// The votes of a chunk for all parts on one grid. Neighbours from its four stretches are taken in turn.
template <class Voting, class... Votes>
inline void scatter(std::uint32_t size, float* out, const Votes&... votes) noexcept {
  constexpr std::uint32_t quarter = chunk_size / 4;  // a stretch of a full chunk; any other split would do
  static_assert(stretches_of_full_chunk == 4, "what is written out below");
  std::uint32_t i = 0;
  if (size >= 3 * quarter) {
    for (; i < size - 3 * quarter; ++i) unroll<4>([&](auto k) { add_votes<Voting>(i + k * quarter, out, votes...); });
  }
  for (; i < quarter; ++i) {
    for (std::uint32_t k = i; k < size; k += quarter) add_votes<Voting>(k, out, votes...);
  }
}

/// The greatest common divisor.
constexpr int common_divisor(int a, int b) noexcept { return b == 0 ? a : common_divisor(b, a % b); }

/// One chunk into parts that have one grid: points are shared among its cells once for all of them.
template <class Voting, class Chunk, class First, class... Others>
inline void accumulate(const Chunk& chunk, VoteUnit unit, float* out, First&& first, Others&&... others) noexcept {
  using Part = typename std::decay_t<First>::Part;
  constexpr int values = [] {
    int divisor = Part::values;
    ((divisor = common_divisor(divisor, std::decay_t<Others>::Part::values)), ...);
    return divisor;
  }();
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; i += simd::lanes) {
    const GridShares shares = share_among_cells<Voting, Part, values>(chunk, i, unit);
    first.template cast<values, true>(chunk, i, shares, unit);
    (others.template cast<values, false>(chunk, i, shares, unit), ...);
  }
  scatter<Voting>(size, out, first, others...);
}

template <class Voting, class... Parts, std::size_t... I, class Chunk, class Colors>
inline void accumulate_all(Descriptor<Voting, Parts...>, std::index_sequence<I...>, const Chunk& chunk,
                           const Colors& colors, VoteUnit unit, float* out) noexcept {
  using D = Descriptor<Voting, Parts...>;
  if constexpr (HaveOneGrid<Parts...>::value) {
    accumulate<Voting>(chunk, unit, out, ChunkVotes<Voting, Parts, D::offset(I), SignalOf<Parts, Colors>>(colors)...);
  } else {
    const auto accumulate_part = [&](auto part, float* values) {
      using Part = decltype(part);
      accumulate<Voting>(chunk, unit, values, ChunkVotes<Voting, Part, 0, SignalOf<Part, Colors>>(colors));
    };
    (accumulate_part(Parts{}, out + D::offset(I)), ...);
  }
}

}  // namespace detail
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
