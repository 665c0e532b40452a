// shortshot/describe.hpp: the kernel. One gathered neighbourhood and a frame in, one descriptor out.
//
// Neighbours go through in chunks, each chunk in passes over small arrays: locate (local spherical coordinates), then
// per part: signal, votes, scatter. Votes are rounded to integers before they are added up (fixed_point.hpp).
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
#include "math.hpp"
#include "neighborhood.hpp"
#include "simd.hpp"
#include "status.hpp"
#include "unroll.hpp"
#include "voting.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// Neighbours per chunk. The arrays of a chunk are all the stack that the kernel uses beyond a few registers.
inline constexpr std::uint32_t chunk_size = 64;

/// A chunk of neighbours in the frame's spherical coordinates.
struct Chunk {
  std::uint32_t first;  ///< position in the neighbourhood
  std::uint32_t size;
  float distance[chunk_size];   ///< over the radius, 0..1
  float elevation[chunk_size];  ///< angle from +z over pi, 0..1
  float azimuth[chunk_size];    ///< angle from -x, counter-clockwise, in turns, 0..1
  float scale[chunk_size];      ///< fixed-point scale of its votes; 0 for neighbours that are not described
};

/// Closest squared distance that is described: the published code skips the key point and its copies by this bound.
inline constexpr float min_described_d2 = 1e-15f;

/// Local coordinates, each rounded as the published code rounds them: dot products x + z first, then y.
inline void locate(const Neighborhood& n, const Frame& frame, Radius radius, Chunk& chunk) noexcept {
  using simd::all;
  using simd::F32;
  const F32 inverse = all(1.0f / radius.value);
  const float splitter = math::length_splitter(radius.value);
  const F32 vote_scale = all(fixed_point_scale(n.size, 2));
  for (std::uint32_t i = 0; i < chunk.size; i += simd::lanes) {
    const std::uint32_t k = chunk.first + i;
    const Offsets v = load_offsets(n, k);
    const auto along = [&](const float(&axis)[3]) {
      return (v.dx * all(axis[0]) + v.dz * all(axis[2])) + v.dy * all(axis[1]);
    };
    const F32 x = along(frame.x);
    const F32 y = along(frame.y);
    const F32 z = along(frame.z);
    const F32 rho2 = x * x + y * y;
    // Neighbours beyond the radius (of a wider frame) have no vote, but must not leave the range of int either.
    simd::store(chunk.distance + i, simd::min(math::length(x, y, z, splitter) * inverse, all(2.0f)));
    simd::store(chunk.elevation + i, math::elevation(simd::sqrt(rho2), z));
    simd::store(chunk.azimuth + i, math::azimuth(x, y));
    simd::store(chunk.scale + i, keep((v.d2 > all(min_described_d2)) & (v.d2 < all(radius.squared)), vote_scale));
  }
}

/// Colour distances of a chunk's neighbours to the key point.
template <class Colors>
inline void measure_colors(const Neighborhood& n, const Colors& colors, const Chunk& chunk,
                           float (&signal)[chunk_size]) noexcept {
  float lightness[chunk_size];
  float green_red[chunk_size];
  float blue_yellow[chunk_size];
  for (std::uint32_t i = 0; i < chunk.size; ++i) {
    const Lab color = colors(n.index[chunk.first + i]);
    lightness[i] = color.L;
    green_red[i] = color.a;
    blue_yellow[i] = color.b;
  }
  for (std::uint32_t i = chunk.size; i % simd::lanes != 0; ++i) {  // the last register
    lightness[i] = green_red[i] = blue_yellow[i] = 0.0f;
  }
  const Lab& key = colors.reference;
  const LabLanes reference{simd::all(key.L), simd::all(key.a), simd::all(key.b)};
  for (std::uint32_t i = 0; i < chunk.size; i += simd::lanes) {
    const LabLanes color{simd::load(lightness + i), simd::load(green_red + i), simd::load(blue_yellow + i)};
    simd::store(signal + i, color_distances(color, reference));
  }
}

/// The votes of a chunk, lane-wise: `Count` arrays of positions in the part and fixed-point weights.
template <int Count>
struct ChunkVotes {
  std::int32_t index[Count][chunk_size];
  std::int32_t weight[Count][chunk_size];
};

/// Axes of a part: three of its grid, and the histogram's where it has one.
template <class Part>
inline constexpr int axes_of = Part::has_histogram ? 4 : 3;

template <class Voting, class Part>
inline void vote(const Chunk& chunk, const float (&signal)[chunk_size],
                 ChunkVotes<Voting::template votes<axes_of<Part>>>& out) noexcept {
  using simd::all;
  using Grid = typename Part::Grid;
  constexpr int axes = axes_of<Part>;
  constexpr int count = Voting::template votes<axes>;
  for (std::uint32_t i = 0; i < chunk.size; i += simd::lanes) {
    Share shares[axes];
    shares[0] = Voting::template split<typename Part::RadialAxis>(
        Part::Scale::template position<Grid::radial>(simd::load(chunk.distance + i)));
    shares[1] = Voting::template split<typename Part::ElevationAxis>(simd::load(chunk.elevation + i) *
                                                                     all(static_cast<float>(Grid::elevation)));
    shares[2] = Voting::template split<typename Part::AzimuthAxis>(simd::load(chunk.azimuth + i) *
                                                                   all(static_cast<float>(Grid::azimuth)));
    if constexpr (Part::has_histogram) {
      shares[3] = Voting::template split<typename Part::SignalAxis>(simd::load(signal + i) *
                                                                    all(static_cast<float>(Part::Signal::bins)));
    }
    const Votes<count> votes = Voting::combine(shares);
    const simd::F32 scale = simd::load(chunk.scale + i);
    unroll<count>([&](auto k) {
      simd::store(out.index[k] + i, truncate_to_int(votes.index[k]));
      simd::store(out.weight[k] + i, round_to_int(votes.weight[k] * scale));
    });
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

template <int Count>
inline void scatter(const ChunkVotes<Count>& votes, std::uint32_t size, float* part) noexcept {
  for (std::uint32_t i = 0; i < size; ++i) {
    unroll<Count>([&](auto k) { add_bits(part + votes.index[k][i], votes.weight[k][i]); });
  }
}

/// One chunk into one part.
template <class Voting, class Part, class Colors>
inline void accumulate(const Neighborhood& n, const Colors& colors, const Chunk& chunk, float* part) noexcept {
  ChunkVotes<Voting::template votes<axes_of<Part>>> votes;
  float signal[chunk_size];
  if constexpr (Part::Signal::needs_colors) measure_colors(n, colors, chunk, signal);
  vote<Voting, Part>(chunk, signal, votes);
  scatter(votes, chunk.size, part);
}

template <class Voting, class... Parts, class Colors>
inline void accumulate_all(Descriptor<Voting, Parts...>, const Neighborhood& n, const Colors& colors,
                           const Chunk& chunk, float* out) noexcept {
  using D = Descriptor<Voting, Parts...>;
  int part = 0;
  (accumulate<Voting, Parts>(n, colors, chunk, out + D::offset(part++)), ...);
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
/// `n`       neighbours of one key point, gathered with at least `radius` (farther ones are left out)
/// `colors`  a source of Lab by index (RgbColors, LabColors, your own like them), or NoColors if D needs none
/// `frame`   an orthonormal frame: estimate_frame(), or one you know
/// `out`     D::size floats: the parts of D in order, L2 norm 1
///
/// Source: paper, equations (4), (6) and (7), with cells, shares and roundings as in the published code (voting.hpp).
/// There is no minimum of neighbours but one. Statuses: bad_radius, bad_frame, missing_colors, too_many_neighbors (over
/// 2^24), too_few_neighbors (none but the key point and its copies); `out` is all zeros then, and never NaN. No
/// allocation; reentrant; 3 to 10 KB of stack. The result does not depend on the order of the neighbours.
template <class D, class Colors>
[[nodiscard]] inline Status describe(const Neighborhood& n, const Colors& colors, const Frame& frame, Radius radius,
                                     float* out) noexcept {
  std::memset(out, 0, D::size_bytes);
  static_assert(!D::needs_colors || !std::is_same<Colors, NoColors>::value,
                "D has a colour part: describe() supports RgbColors, LabColors or another source of Lab by index");
  static_assert(detail::has_rule_of<D, Colors>(nullptr), "describe() supports colours converted by D's own rule");
  Status status = check(radius);
  if (status == Status::ok) status = check(frame);
  if (status == Status::ok && D::needs_colors) status = colors.status();
  if (status == Status::ok && n.size > max_neighbors) status = Status::too_many_neighbors;
  if (status != Status::ok) return status;

  detail::Chunk chunk;
  for (chunk.first = 0; chunk.first < n.size; chunk.first += detail::chunk_size) {
    const std::uint32_t rest = n.size - chunk.first;
    chunk.size = rest < detail::chunk_size ? rest : detail::chunk_size;
    detail::locate(n, frame, radius, chunk);
    detail::accumulate_all(D{}, n, colors, chunk, out);
  }
  return detail::normalize<D::size>(out);
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
