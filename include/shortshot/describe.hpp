// shortshot/describe.hpp: the kernel. One gathered neighbourhood and a frame in, one descriptor out.
//
// Neighbours go through in chunks, each chunk in passes over small arrays: locate (local spherical coordinates,
// locate.hpp), then for each part: vote and scatter (accumulate.hpp). Votes are integers, and so are their sums
// (fixed_point.hpp).
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "accumulate.hpp"
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

/// The finest unit in which the votes of `n` neighbours can be added up, and no finer than positions are.
template <int PositionBits, int WeightBits = 2>
[[nodiscard]] inline VoteUnit vote_unit(std::uint32_t n) noexcept {
  const int finest = fixed_point_exponent(n, WeightBits);
  const int bits = finest < PositionBits ? finest : PositionBits - 1;
  return {bits, std::int32_t{1} << bits};
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
/// `n`        neighbours of one key point, gathered with at least `radius` (farther ones are left out); if they do not
///            come from a search, d2 must be that of dx, dy and dz, and the indices must be ones that `colors` and
///            `normals` have
/// `colors`   a source of Lab by index (RgbColors, LabColors, your own like them), or NoColors if D needs none
/// `normals`  CloudNormals, or NoNormals; not looked at if D needs none; a neighbour whose normal is not finite is left
/// out `frame`    an orthonormal frame: estimate_frame(), or one you know `out`      D::size floats: the parts of D in
/// order, L2 norm 1
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

  const VoteUnit unit = detail::vote_unit<D::position_bits, D::Voting::weight_bits>(n.size);
  detail::Chunk<D::needs_normals> chunk;
  std::uint32_t described = 0;
  for (std::uint32_t i = 0; i * detail::chunk_size < n.size; ++i) {
    detail::locate<D>(n, detail::stretches_of_chunk(i, n.size), frame, radius, normals, chunk);
    detail::accumulate_all(D{}, std::make_index_sequence<D::parts>{}, chunk, colors, unit, out);
    described += chunk.size;
  }
  constexpr std::uint32_t fewest = D::Cells::min_neighbors;
  if (fewest > 0 && described < fewest && count_within(n, radius) < fewest) {
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
