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

template <class Voting, class Part>
inline constexpr int votes_of = Voting::template votes<Part::axis_count>;

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
    return simd::load(chunk.coordinate(3, i)) * simd::all(0.5f) + simd::all(0.5f);
  }
};

/// The signal of ColorDistance: how far neighbours' colours are from the key point's.
template <class Colors>
struct ColorSignal {
  std::conditional_t<simd::lanes == 1, const Colors&, Colors> colors;  // in lanes a copy, which no store can change
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

/// The share along axis `k` of a part's grid of what lies at a chunk's coordinate `k`.
template <class Voting, class Part>
[[nodiscard]] SHORTSHOT_INLINE Share share_along_axis(const Axis& axis, int k, simd::F32 coordinate,
                                                      const VoteUnit& unit) noexcept {
  using Cells = typename Part::Cells;
  const simd::F32 along = k == 1 ? Cells::elevation(coordinate) : coordinate;
  const simd::F32 cells = k == 0 ? Part::Scale::position(axis, along) : along * simd::all(axis.length());
  simd::I32 position = Cells::position(cells);
  if (Cells::has_poles && k == 2) position = invert(is_negative(bits_of(coordinate)), position);  // 0 to -1: nowhere
  return Voting::split(axis, position, unit);
}

/// One register of a chunk's neighbours in the frame's spherical coordinates.
struct Coordinates {
  simd::F32 of[3];
};

template <class Chunk>
[[nodiscard]] SHORTSHOT_INLINE Coordinates coordinates_at(const Chunk& chunk, std::uint32_t i) noexcept {
  return {{simd::load(chunk.coordinate(0, i)), simd::load(chunk.coordinate(1, i)), simd::load(chunk.coordinate(2, i))}};
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
    shares.axes[k] = share_along_axis<Voting, Part>(Part::template axes<Values>[k], k, at.of[k], unit);
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

/// All votes for a part of one register of a chunk's neighbours, from `i` on, whose shares in the grid are known.
template <class Voting, class Part, class Signal, class Chunk>
[[nodiscard]] SHORTSHOT_INLINE Votes<votes_of<Voting, Part>> votes_at(const Chunk& chunk, std::uint32_t i,
                                                                      PointShares&& shares, const Signal& signal,
                                                                      const VoteUnit& unit) noexcept {
  if constexpr (Part::has_histogram) {
    constexpr const Axis& axis = Part::template axes<Part::values>[3];
    shares.axes[3] = Voting::split(axis, Part::Cells::bin_position(axis, signal(chunk, i)), unit);
  }
  return Voting::template combine<Part::axis_count>(Part::template axes<Part::values>, shares.axes, unit);
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
template <class Voting, class PartType, int Offset, class Signal, std::uint32_t ChunkSize>
struct ChunkVotes {
  using Part = PartType;
  static constexpr int offset = Offset;
  static constexpr int count = votes_of<Voting, Part>;
  Signal signal;
  std::int32_t index[count * ChunkSize];
  std::int32_t weight[count * ChunkSize];

  template <class Colors>
  explicit ChunkVotes(const Colors& colors) noexcept : signal(colors) {}

  /// The votes of one register of neighbours, from `i` on. Weights that the `First` part on the grid has as well are
  /// kept there only.
  template <bool First, class Chunk>
  SHORTSHOT_INLINE void cast(const Chunk& chunk, std::uint32_t i, PointShares&& shares, const VoteUnit& unit) noexcept {
    const Votes<count> votes = votes_at<Voting, Part>(chunk, i, std::move(shares), signal, unit);
    unroll<count>([&](auto k) {
      simd::store(index + i + k * ChunkSize, votes.index[k]);
      if constexpr (First || !is_shared<Voting>(k)) simd::store(weight + i + k * ChunkSize, votes.weight[k]);
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
template <int K, std::uint32_t ChunkSize, class Votes, class Source>
SHORTSHOT_INLINE void add_vote(float* out, const Votes& votes, const Source& source, std::uint32_t i) noexcept {
  constexpr std::uint32_t first = K * ChunkSize;
  if constexpr (K < Votes::count) {
    add_bits(out + Votes::offset + votes.index[first + i], source.weight[first + i]);
  }
}

/// All votes of neighbour `i` of a chunk, for all parts on one grid.
template <class Voting, std::uint32_t ChunkSize, class First, class... Others>
SHORTSHOT_INLINE void add_votes(std::uint32_t i, float* out, const First& first, const Others&... others) noexcept {
  unroll<votes_of_most<First, Others...>>([&](auto k) {
    add_vote<k, ChunkSize>(out, first, first, i);
    if constexpr (is_shared<Voting>(k)) {
      (add_vote<k, ChunkSize>(out, others, first, i), ...);
    } else {
      (add_vote<k, ChunkSize>(out, others, others, i), ...);
    }
  });
}

/// The votes of a chunk for all parts on one grid. Neighbours from its four stretches are taken in turn.
template <class Voting, std::uint32_t ChunkSize, class... Votes>
inline void scatter(std::uint32_t size, float* out, const Votes&... votes) noexcept {
  constexpr std::uint32_t quarter = ChunkSize / 4;  // a stretch of a full chunk; any other split would do
  static_assert(stretches_of_full_chunk == 4, "what is written out below");
  std::uint32_t i = 0;
  if (size >= 3 * quarter) {
    for (; i < size - 3 * quarter; ++i) {
      unroll<4>([&](auto k) { add_votes<Voting, ChunkSize>(i + k * quarter, out, votes...); });
    }
  }
  for (; i < quarter; ++i) {
    for (std::uint32_t k = i; k < size; k += quarter) add_votes<Voting, ChunkSize>(k, out, votes...);
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
    PointShares shares = grid_shares<Voting, Part, values>(coordinates_at(chunk, i), unit);
    if constexpr (sizeof...(Others) == 0) {
      first.template cast<true>(chunk, i, std::move(shares), unit);
    } else {
      first.template cast<true>(chunk, i, widened<Part::values / values>(shares), unit);
      (others.template cast<false>(chunk, i, widened<std::decay_t<Others>::Part::values / values>(shares), unit), ...);
    }
  }
  scatter<Voting, Chunk::room>(size, out, first, others...);
}

/// The votes of neighbour `i` of a chunk for one part, added at once: there is one lane only.
template <class Voting, class Part, class Signal, class Chunk>
SHORTSHOT_INLINE void add_point(const Chunk& chunk, std::uint32_t i, const Coordinates& at, const Signal& signal,
                                const VoteUnit& unit, float* values) noexcept {
  constexpr int count = votes_of<Voting, Part>;
  const Votes<count> votes =
      votes_at<Voting, Part>(chunk, i, grid_shares<Voting, Part, Part::values>(at, unit), signal, unit);
  each<count>([&](auto k) {
    std::int32_t place = 0;
    std::int32_t weight = 0;
    simd::store(&place, votes.index[k]);
    simd::store(&weight, votes.weight[k]);
    add_bits(values + place, weight);
  });
}

/// All parts in one loop: what they have in common is worked out once.
template <class Voting, class... Parts, std::size_t... I, class Chunk, class... Signals>
inline void add_points(Descriptor<Voting, Parts...>, std::index_sequence<I...>, const Chunk& chunk,
                       const VoteUnit& unit, float* out, const Signals&... signals) noexcept {
  using D = Descriptor<Voting, Parts...>;
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; ++i) {
    const Coordinates at = coordinates_at(chunk, i);
    (add_point<Voting, Parts>(chunk, i, at, signals, unit, out + D::offset(I)), ...);
  }
}

template <class Voting, class... Parts, std::size_t... I, class Chunk, class Colors>
inline void accumulate_all(Descriptor<Voting, Parts...> descriptor, std::index_sequence<I...> parts, const Chunk& chunk,
                           const Colors& colors, const VoteUnit& unit, float* out) noexcept {
  using D = Descriptor<Voting, Parts...>;
  if constexpr (simd::lanes == 1) {
    add_points(descriptor, parts, chunk, unit, out, SignalOf<Parts, Colors>(colors)...);
  } else if constexpr (HaveOneGrid<Parts...>::value) {
    accumulate<Voting>(chunk, unit, out,
                       ChunkVotes<Voting, Parts, D::offset(I), SignalOf<Parts, Colors>, Chunk::room>(colors)...);
  } else {
    const auto accumulate_part = [&](auto part, float* values) {
      using Part = decltype(part);
      accumulate<Voting>(chunk, unit, values, ChunkVotes<Voting, Part, 0, SignalOf<Part, Colors>, Chunk::room>(colors));
    };
    (accumulate_part(Parts{}, out + D::offset(I)), ...);
  }
}

/// Bytes of a chunk and its votes, those of parts on one grid at the same time.
template <std::uint32_t ChunkSize, class Voting, class... Parts>
constexpr std::size_t scratch_bytes(Descriptor<Voting, Parts...>) noexcept {
  using D = Descriptor<Voting, Parts...>;
  constexpr std::size_t votes[] = {sizeof(ChunkVotes<Voting, Parts, 0, NoSignal, ChunkSize>)...};
  std::size_t most = 0;
  for (const std::size_t bytes : votes)
    most = HaveOneGrid<Parts...>::value ? most + bytes : most < bytes ? bytes : most;
  return sizeof(Chunk<D::needs_normals, ChunkSize>) + (simd::lanes == 1 ? 0 : most);
}

}  // namespace detail
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
