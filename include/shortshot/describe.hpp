// shortshot/describe.hpp: the kernel. One gathered neighbourhood and a frame in, one descriptor out.
//
// Neighbours go through in chunks, each chunk in passes over small arrays: locate (local spherical coordinates,
// locate.hpp), then for each part: vote (cells and weights, voting.hpp), and scatter. Votes are integers, and so are
// their sums (fixed_point.hpp).
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "color.hpp"
#include "color_source.hpp"
#include "config.hpp"
#include "descriptor.hpp"
#include "fixed_point.hpp"
#include "frame.hpp"
#include "locate.hpp"
#include "neighborhood.hpp"
#include "normal_source.hpp"
#include "simd.hpp"
#include "status.hpp"
#include "unroll.hpp"
#include "voting.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// The finest unit in which the votes of `n` neighbours (each of weight 4 at most) can be added up, and no finer than
/// positions are.
template <int PositionBits>
[[nodiscard]] inline VoteUnit vote_unit(std::uint32_t n) noexcept {
  const int finest = fixed_point_exponent(n, 2);
  const int bits = finest < PositionBits ? finest : PositionBits - 1;
  return {bits, std::int32_t{1} << bits};
}

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

/// The integers that votes are added to live in the caller's output array, bit for bit, until they are normalised: no
/// second array is needed. memcpy is how C++ says that; compilers make one add of it.
inline void add_bits(float* value, std::int32_t weight) noexcept {
  std::int32_t sum = 0;
  std::memcpy(&sum, value, sizeof sum);
  sum += weight;
  std::memcpy(value, &sum, sizeof sum);
}

/// The votes of a chunk for one part, lane-wise: `count` arrays of positions in the part, and as many of weights. Votes
/// go through memory: taken out of registers lane by lane they would cost twice as much.
template <class Voting, class PartType, class Signal>
struct ChunkVotes {
  using Part = PartType;
  static constexpr int count = votes_of<Voting, Part>;
  float* values;  ///< the part's place in the descriptor
  Signal signal;
  std::int32_t index[count * chunk_size];
  std::int32_t weight[count * chunk_size];

  template <class Colors>
  ChunkVotes(float* part, const Colors& colors) noexcept : values(part), signal(colors) {}

  /// The votes of one register of neighbours, from `i` on, whose shares are those in the part's grid if every cell had
  /// `Values` values.
  template <int Values, class Chunk>
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
      store(i, Voting::template combine<R, E, A, S>({r, e, a, s}, unit));
    } else {
      store(i, Voting::template combine<R, E, A>({r, e, a}, unit));
    }
  }

 private:
  [[gnu::always_inline]] void store(std::uint32_t i, const Votes<count>& votes) noexcept {
    unroll<count>([&](auto k) {
      simd::store(index + i + k * chunk_size, votes.index[k]);
      simd::store(weight + i + k * chunk_size, votes.weight[k]);
    });
  }
};

/// Neighbours from the four stretches of a chunk are taken in turn.
template <class Votes>
inline void scatter(const Votes& votes, std::uint32_t size) noexcept {
  float* const part = votes.values;
  const auto add = [&](std::uint32_t i) {
    unroll<Votes::count>(
        [&](auto k) { add_bits(part + votes.index[k * chunk_size + i], votes.weight[k * chunk_size + i]); });
  };
  constexpr std::uint32_t quarter = chunk_size / 4;  // a stretch of a full chunk; any other split would do
  static_assert(stretches_of_full_chunk == 4, "what is written out below");
  std::uint32_t i = 0;
  if (size >= 3 * quarter) {
    for (; i < size - 3 * quarter; ++i) unroll<4>([&](auto k) { add(i + k * quarter); });
  }
  for (; i < quarter; ++i) {
    for (std::uint32_t k = i; k < size; k += quarter) add(k);
  }
}

/// The greatest common divisor.
constexpr int common_divisor(int a, int b) noexcept { return b == 0 ? a : common_divisor(b, a % b); }

/// One chunk into parts that have one grid: points are shared among its cells once for all of them.
template <class Voting, class Chunk, class First, class... Others>
inline void accumulate(const Chunk& chunk, VoteUnit unit, First&& first, Others&&... others) noexcept {
  using Part = typename std::decay_t<First>::Part;
  constexpr int values = [] {
    int divisor = Part::values;
    ((divisor = common_divisor(divisor, std::decay_t<Others>::Part::values)), ...);
    return divisor;
  }();
  const std::uint32_t size = chunk.size;
  for (std::uint32_t i = 0; i < size; i += simd::lanes) {
    const GridShares shares = share_among_cells<Voting, Part, values>(chunk, i, unit);
    first.template cast<values>(chunk, i, shares, unit);
    (others.template cast<values>(chunk, i, shares, unit), ...);
  }
  scatter(first, size);
  (scatter(others, size), ...);
}

template <class Voting, class... Parts, std::size_t... I, class Chunk, class Colors>
inline void accumulate_all(Descriptor<Voting, Parts...>, std::index_sequence<I...>, const Chunk& chunk,
                           const Colors& colors, VoteUnit unit, float* out) noexcept {
  using D = Descriptor<Voting, Parts...>;
  if constexpr (HaveOneGrid<Parts...>::value) {
    accumulate<Voting>(chunk, unit, ChunkVotes<Voting, Parts, SignalOf<Parts, Colors>>(out + D::offset(I), colors)...);
  } else {
    const auto accumulate_part = [&](auto part, float* place) {
      using Part = decltype(part);
      accumulate<Voting>(chunk, unit, ChunkVotes<Voting, Part, SignalOf<Part, Colors>>(place, colors));
    };
    (accumulate_part(Parts{}, out + D::offset(I)), ...);
  }
}

/// Integers to floats of L2 norm 1. Squares are added up in eight places, whatever the number of lanes: the same order,
/// and so the same bits, from all.
template <int Size>
[[nodiscard]] inline Status normalize(float* values) noexcept {
  constexpr int lanes = static_cast<int>(simd::lanes);
  simd::F32 squares[8 / lanes] = {};
  const auto convert_eight = [&](float* eight) {
    unroll<8 / lanes>([&](auto i) {
      const simd::F32 value = to_float(bits_of(simd::load(eight + i * lanes)));
      simd::store(eight + i * lanes, value);
      squares[i] = squares[i] + value * value;
    });
  };
  constexpr int whole = Size / 8 * 8;
  for (int i = 0; i < whole; i += 8) convert_eight(values + i);
  float rest[8] = {};
  std::memcpy(rest, values + whole, (Size - whole) * sizeof(float));
  convert_eight(rest);

  float s[8];
  unroll<8 / lanes>([&](auto i) { simd::store(s + i * lanes, squares[i]); });
  const float squared_norm = ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
  if (!(squared_norm > 0.0f)) return Status::too_few_neighbors;
  const float inverse = 1.0f / simd::root(squared_norm);
  for (int i = 0; i < whole; i += lanes) simd::store(values + i, simd::load(values + i) * simd::all(inverse));
  for (int i = whole; i < Size; ++i) values[i] = rest[i - whole] * inverse;
  return Status::ok;
}

/// How many of the neighbours lie within the radius, the key point and its copies included?
[[nodiscard]] inline std::uint32_t count_within(const Neighborhood& n, Radius radius) noexcept {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < n.size; ++i) count += n.d2[i] < radius.squared ? 1u : 0u;
  return count;
}

}  // namespace detail

/// Describe a gathered neighbourhood in a frame: the kernel of every descriptor.
///
/// `n`        neighbours of one key point, gathered with at least `radius` (farther ones are left out); if they do not
/// come
///            from a search, d2 must be that of dx, dy and dz, and the indices must be ones that `colors` and `normals`
///            have
/// `colors`   a source of Lab by index (RgbColors, LabColors, your own like them), or NoColors if D needs none
/// `normals`  CloudNormals, or NoNormals if D needs none; a neighbour whose normal is not finite is left out
/// `frame`    an orthonormal frame: estimate_frame(), or one you know
/// `out`      D::size floats: the parts of D in order, L2 norm 1
///
/// Source: SSH and SCSH: paper, equations (4), (6) and (7), with cells, shares and roundings as in the published code.
/// SHOT and CSHOT: PCL 1.13's SHOTEstimation and SHOTColorEstimation. The rules are in cells.hpp and voting.hpp.
/// Statuses: bad_radius, bad_frame, missing_colors, missing_normals, too_many_neighbors (over 2^24), too_few_neighbors
/// (none to describe; for SHOT and CSHOT also fewer than five, the key point and its copies included); `out` is all
/// zeros then, and never NaN. No allocation; reentrant; 2 to 17 KB of stack (5 for SCSH by the published rule, 7 for
/// CSHOT). The result does not depend on the order of the neighbours.
template <class D, class Colors, class Normals>
[[nodiscard]] inline Status describe(const Neighborhood& n, const Colors& colors, const Normals& normals,
                                     const Frame& frame, Radius radius, float* out) noexcept {
  static_assert(!D::needs_colors || !std::is_same<Colors, NoColors>::value,
                "D has a colour part: describe() supports RgbColors, LabColors or another source of Lab by index");
  static_assert(!D::needs_normals || !std::is_same<Normals, NoNormals>::value,
                "D has a part of normals: describe() supports CloudNormals or another source of normals by index");
  static_assert(detail::has_rule_of<D, Colors>(nullptr), "describe() supports colours converted by D's own rule");
  std::memset(out, 0, D::size_bytes);
  Status status = check(radius);
  if (status == Status::ok) status = check(frame);
  if (status == Status::ok && D::needs_colors) status = colors.status();
  if (status == Status::ok && D::needs_normals) status = normals.status();
  if (status == Status::ok && n.size > max_neighbors) status = Status::too_many_neighbors;
  if (status != Status::ok) return status;

  const VoteUnit unit = detail::vote_unit<D::position_bits>(n.size);
  detail::Chunk<D::needs_normals> chunk;
  std::uint32_t described = 0;
  for (std::uint32_t i = 0; i * detail::chunk_size < n.size; ++i) {
    detail::locate<D>(n, detail::stretches_of_chunk(i, n.size), frame, radius, normals, chunk);
    detail::accumulate_all(D{}, std::make_index_sequence<D::parts>{}, chunk, colors, unit, out);
    described += chunk.size;
  }
  constexpr std::uint32_t fewest = D::Cells::min_neighbors;
  if (fewest > 0 && described < fewest && detail::count_within(n, radius) < fewest) {
    std::memset(out, 0, D::size_bytes);
    return Status::too_few_neighbors;
  }
  return detail::normalize<D::size>(out);
}

/// The same for descriptors without normals.
template <class D, class Colors>
[[nodiscard]] inline Status describe(const Neighborhood& n, const Colors& colors, const Frame& frame, Radius radius,
                                     float* out) noexcept {
  return describe<D>(n, colors, NoNormals{}, frame, radius, out);
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
