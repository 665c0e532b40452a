// shortshot/describe.hpp: the kernel. One gathered neighbourhood and a frame in, one descriptor out.
//
// Neighbours go through in chunks, each chunk in passes over small arrays: locate (local spherical coordinates,
// locate.hpp), then for each part: vote (cells and weights, voting.hpp), and scatter. Votes are integers, and so are
// their sums (fixed_point.hpp).
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "color.hpp"
#include "color_source.hpp"
#include "config.hpp"
#include "descriptor.hpp"
#include "fixed_point.hpp"
#include "frame.hpp"
#include "locate.hpp"
#include "neighborhood.hpp"
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

/// Positions along an axis, fixed-point, from fractions of it.
template <class Axis>
[[nodiscard]] inline simd::I32 positions(simd::F32 fractions) noexcept {
  return truncate_to_int(fractions * simd::all(static_cast<float>(Axis::cells) * Axis::one));
}

/// The signal of Occupancy: none.
struct NoSignal {
  template <class Colors>
  explicit NoSignal(const Colors&) noexcept {}
};

/// The signal of ColorDistance: how far neighbours' colours are from the key point's.
template <class Colors>
struct ColorSignal {
  Colors colors;  // a copy: no store to the chunk can change it
  LabLanes reference;
  explicit ColorSignal(const Colors& source) noexcept : colors(source), reference(in_all_lanes(source.reference)) {}
  [[nodiscard]] simd::F32 operator()(const Chunk& chunk, std::uint32_t i) const noexcept {
    return color_distances(colors_at(colors, chunk.index + i), reference);
  }
};

/// The votes of one register of neighbours, from `i` on, for a part.
template <class Voting, class Part, class Signal>
[[nodiscard, gnu::always_inline]] inline auto vote(const Chunk& chunk, std::uint32_t i, const Signal& signal,
                                                   const VoteUnit& unit) noexcept {
  using R = typename Part::RadialAxis;
  using E = typename Part::ElevationAxis;
  using A = typename Part::AzimuthAxis;
  const simd::F32 shells = Part::Scale::template position<R::cells>(simd::load(chunk.distance(i)), R::one);
  const Share r = Voting::template split<R>(truncate_to_int(shells), unit);
  const Share e = Voting::template split<E>(positions<E>(simd::load(chunk.elevation(i))), unit);
  const Share a = Voting::template split<A>(positions<A>(simd::load(chunk.azimuth(i))), unit);
  if constexpr (Part::has_histogram) {
    using S = typename Part::SignalAxis;
    const Share s = Voting::template split<S>(positions<S>(signal(chunk, i)), unit);
    return Voting::template combine<R, E, A, S>({r, e, a, s}, unit);
  } else {
    return Voting::template combine<R, E, A>({r, e, a}, unit);
  }
}

/// The integers that votes are added to live in the caller's output array, bit for bit, until they are normalised: no
/// second array is needed. memcpy is how C++ says that; compilers make one add of it.
inline void add_bits(float* value, std::int32_t weight) noexcept {
  std::int32_t sum = 0;
  std::memcpy(&sum, value, sizeof sum);
  sum += weight;
  std::memcpy(value, &sum, sizeof sum);
}

/// The votes of a chunk, lane-wise: `Count` arrays of positions in the part, and as many of weights.
template <int Count>
struct ChunkVotes {
  std::int32_t index[Count * chunk_size];
  std::int32_t weight[Count * chunk_size];
};

/// Neighbours from the four stretches of a chunk are taken in turn.
template <int Count>
inline void scatter(const ChunkVotes<Count>& votes, std::uint32_t size, float* part) noexcept {
  const auto add = [&](std::uint32_t i) {
    unroll<Count>([&](auto k) { add_bits(part + votes.index[k * chunk_size + i], votes.weight[k * chunk_size + i]); });
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

/// One chunk into one part. Votes go through memory: taken out of registers lane by lane they would cost twice as much.
template <class Voting, class Part, class Colors>
inline void accumulate(const Chunk& chunk, const Colors& colors, VoteUnit unit, float* part) noexcept {
  using Signal = std::conditional_t<Part::Signal::needs_colors, ColorSignal<Colors>, NoSignal>;
  const Signal signal(colors);
  const std::uint32_t size = chunk.size;
  constexpr int count = votes_of<Voting, Part>;
  ChunkVotes<count> votes;
  for (std::uint32_t i = 0; i < size; i += simd::lanes) {
    const Votes<count> now = vote<Voting, Part>(chunk, i, signal, unit);
    std::int32_t* const index = votes.index + i;
    std::int32_t* const weight = votes.weight + i;
    unroll<count>([&](auto k) {
      simd::store(index + k * chunk_size, now.index[k]);
      simd::store(weight + k * chunk_size, now.weight[k]);
    });
  }
  scatter(votes, size, part);
}

template <class Voting, class... Parts, class Colors>
inline void accumulate_all(Descriptor<Voting, Parts...>, const Chunk& chunk, const Colors& colors, VoteUnit unit,
                           float* out) noexcept {
  using D = Descriptor<Voting, Parts...>;
  int part = 0;
  (accumulate<Voting, Parts>(chunk, colors, unit, out + D::offset(part++)), ...);
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

}  // namespace detail

/// Describe a gathered neighbourhood in a frame: the kernel of every descriptor.
///
/// `n`       neighbours of one key point, gathered with at least `radius` (farther ones are left out); if they do not
/// come
///           from a search, d2 must be that of dx, dy and dz, and the indices must be ones that `colors` has
/// `colors`  a source of Lab by index (RgbColors, LabColors, your own like them), or NoColors if D needs none
/// `frame`   an orthonormal frame: estimate_frame(), or one you know
/// `out`     D::size floats: the parts of D in order, L2 norm 1
///
/// Source: paper, equations (4), (6) and (7), with cells, shares and roundings as in the published code (voting.hpp).
/// There is no minimum of neighbours but one. Statuses: bad_radius, bad_frame, missing_colors, too_many_neighbors (over
/// 2^24), too_few_neighbors (none but the key point and its copies); `out` is all zeros then, and never NaN. No
/// allocation; reentrant; 2 to 17 KB of stack (5 for SCSH by the published rule). The result does not depend on the
/// order of the neighbours.
template <class D, class Colors>
[[nodiscard]] inline Status describe(const Neighborhood& n, const Colors& colors, const Frame& frame, Radius radius,
                                     float* out) noexcept {
  static_assert(!D::needs_colors || !std::is_same<Colors, NoColors>::value,
                "D has a colour part: describe() supports RgbColors, LabColors or another source of Lab by index");
  static_assert(detail::has_rule_of<D, Colors>(nullptr), "describe() supports colours converted by D's own rule");
  std::memset(out, 0, D::size_bytes);
  Status status = check(radius);
  if (status == Status::ok) status = check(frame);
  if (status == Status::ok && D::needs_colors) status = colors.status();
  if (status == Status::ok && n.size > max_neighbors) status = Status::too_many_neighbors;
  if (status != Status::ok) return status;

  const VoteUnit unit = detail::vote_unit<D::position_bits>(n.size);
  detail::Chunk chunk;
  for (std::uint32_t i = 0; i * detail::chunk_size < n.size; ++i) {
    detail::locate<D::shell_borders>(n, detail::stretches_of_chunk(i, n.size), frame, radius, chunk);
    detail::accumulate_all(D{}, chunk, colors, unit, out);
  }
  return detail::normalize<D::size>(out);
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
