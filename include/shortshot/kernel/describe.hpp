// shortshot/kernel/describe.hpp: the kernel. One gathered neighborhood and a frame in, one descriptor out.
//
// Neighbors go through in chunks, each chunk in passes over small arrays: locate (local spherical coordinates,
// to_spherical.hpp), the distances of colors, and then for each part shares among cells (vote_shares.hpp), votes and
// their addition (accumulate.hpp). Where there are lanes, the votes of most rules are worked out two registers at a
// time (short_votes.hpp), in place of vote_shares.hpp; where there is one, each is added as soon as it is known
// (single_votes.hpp). The rule, the arithmetic of cells and the addition are the same code. Votes are integers, and so
// are their sums (fixed_point.hpp).
#ifndef SHORTSHOT_KERNEL_DESCRIBE_HPP
#define SHORTSHOT_KERNEL_DESCRIBE_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "../base/fixed_point.hpp"
#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../descriptor/descriptor.hpp"
#include "../descriptor/source_set.hpp"
#include "../descriptor/voting.hpp"
#include "../frame/frame.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "accumulate.hpp"
#include "accumulate_means.hpp"
#include "finish.hpp"
#include "mean_color.hpp"
#include "short_votes.hpp"
#include "soft_cells.hpp"
#include "soft_votes.hpp"
#include "to_spherical.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The finest unit in which the votes of `n` neighbors can be added up, and no finer than positions are.
[[nodiscard]] inline VoteUnit vote_unit(std::uint32_t n, int position_bits, int weight_bits) noexcept {
  const int finest = fixed_point_exponent(n, weight_bits);
  const int bits = finest < position_bits ? finest : position_bits - 1;
  return {bits, std::int32_t{1} << bits};
}

/// For descriptors that are the same in all.
inline constexpr Frame any_frame{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};

/// The sources as the signals see them.
template <class D, class Sources, class Neighbors>
[[nodiscard]] SHORTSHOT_INLINE decltype(auto) seen_sources(const Sources& sources, const Neighbors& n,
                                                           Radius radius) noexcept {
  if constexpr (D::compares_with_mean) {
    return with_mean_color<typename D::LabRule>(sources, n, radius);
  } else {
    return (sources);
  }
}

/// A chunk into parts one by one, some of them with means.
template <class Voting, class... Parts, std::size_t... I, class Chunk>
inline void accumulate_each(Descriptor<Voting, Parts...>, std::index_sequence<I...>, const Chunk& chunk,
                            const VoteUnit& unit, [[maybe_unused]] float* weights, float* out) noexcept {
  using D = Descriptor<Voting, Parts...>;
  const auto accumulate_one = [&](auto part, float* votes, float* values) {
    using Part = decltype(part);
    if constexpr (Part::weight_cells > 0) {
      accumulate_means<Voting, Part>(chunk, unit, votes, values);
    } else {
      accumulate_all(Descriptor<Voting, Part>{}, std::make_index_sequence<1>{}, chunk, unit, values);
    }
  };
  (accumulate_one(Parts{}, weights + D::weight_offset(I), out + D::offset(I)), ...);
}

/// describe() for what was checked before; `out` is all zeros, unless votes have sums of their own. (Not inlined: its
/// chunk need not be on the stack while the frame is estimated.)
template <class D, std::uint32_t ChunkSize, class Neighbors, class Sources>
[[nodiscard, gnu::noinline]] inline Status describe_checked(const Neighbors& n, const Sources& sources,
                                                            const Frame& frame, Radius radius, float* out) noexcept {
  using Signals = typename D::Signals;
  constexpr auto parts = std::make_index_sequence<D::parts>{};
  if (!D::Cells::has_enough(n, radius)) return Status::too_few_neighbors;
  const VoteUnit unit = vote_unit(n.size, D::position_bits, D::Voting::weight_bits);
  const auto& seen = seen_sources<D>(sources, n, radius);
  const auto of_place = signals_of_place<Signals>(seen);
  float weights[static_cast<std::size_t>(D::weight_cells + 1)] = {};  // an array has one or more
  Chunk<Signals, ChunkSize> chunk;
  constexpr bool has_quads = is_soft<D>() && simd::lanes > 1;
  [[maybe_unused]] Quad quads[has_quads ? simd::lanes * static_cast<std::size_t>(quads_of<D>()) : 1];
  if constexpr (has_quads) std::memset(quads, 0, sizeof quads);
  constexpr bool has_short_votes = short_sums<ChunkSize>(D{}) > 0;
  [[maybe_unused]] float own_sums[static_cast<std::size_t>(short_sums<ChunkSize>(D{}) + 1)];
  if constexpr (has_short_votes) clear_sums(D{}, own_sums);
  for (std::uint32_t i = 0; i * ChunkSize < n.size; ++i) {
    locate<typename D::Cells, typename D::ShellBorders>(n, stretches_of_chunk<ChunkSize>(i, n.size), frame, radius,
                                                        of_place, chunk);
    measure_all_by_index(Signals{}, seen, chunk);
    if constexpr (has_quads) {
      add_soft_votes(D{}, parts, chunk, static_cast<float>(unit.one), quads);
    } else if constexpr (is_soft<D>()) {
      add_soft_points(D{}, parts, chunk, static_cast<float>(unit.one), weights, out);
    } else if constexpr (has_short_votes) {
      accumulate_all_short_votes(D{}, parts, chunk, unit, own_sums);
    } else if constexpr (D::is_plain) {
      accumulate_all(D{}, parts, chunk, unit, out);
    } else {
      accumulate_each(D{}, parts, chunk, unit, weights, out);
    }
  }
  if constexpr (has_quads) gather_all_quads(D{}, parts, quads, weights, out);
  return finish(D{}, parts, has_short_votes ? own_sums : out, out, weights);
}

/// The first status that is not ok of those sources that D reads.
template <class... Kinds, class Sources>
[[nodiscard]] inline Status status_of(extend::SourceKinds<Kinds...>, const Sources& sources) noexcept {
  Status status = Status::ok;
  ((status = status == Status::ok ? source_of<Kinds>(sources).status() : status), ...);
  return status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Neighbors that go through the kernel together: of that length are all arrays that it has on the stack. A template
/// parameter of describe() and describe_at(), any multiple of simd::lanes: it changes speed and memory, no result.
inline constexpr std::uint32_t default_chunk_size = extend::simd::lanes == 1 ? 16 : 128;

/// Bytes of those arrays, and of the sums (of compact descriptors: quads) that the kernel keeps for itself where there
/// are lanes.
template <class D, std::uint32_t ChunkSize = default_chunk_size>
inline constexpr std::size_t chunk_bytes = [] {
  if constexpr (detail::is_soft<D>()) {
    return detail::soft_scratch_bytes<D, ChunkSize>();
  } else if constexpr (detail::short_sums<ChunkSize>(D{}) > 0) {
    return detail::short_scratch_bytes<ChunkSize>(D{});
  } else {
    return detail::scratch_bytes<ChunkSize>(D{});
  }
}();

/// Describe a gathered neighborhood in a frame: the kernel of every descriptor.
///
/// `n`        neighbors of one key point, gathered with at least `radius` (farther ones are left out); if they do not
///            come from a search, d2 must be that of dx, dy and dz, and the indices must be ones that the sources have
/// `sources`  what D's signals read, in any order: sources(LabColors{...}, CloudNormals(cloud)), a source alone, or
///            sources() if they read nothing. A neighbor for which one of them has no value is left out
/// `frame`    an orthonormal frame: estimate_frame(), or one you know. Not looked at unless D::needs_frame
/// `out`      D::size floats: the parts of D in order, L2 norm 1
///
/// Source: SSH and SCSH: paper, equations (4), (6) and (7), with cells, shares and roundings as in the published code.
/// SHOT and CSHOT: PCL 1.13's SHOTEstimation and SHOTColorEstimation. The rules are in conventions.hpp and voting.hpp.
/// Statuses: bad_radius, bad_frame, what the sources say (missing_colors, missing_normals, missing_intensities),
/// too_many_neighbors (over 2^24), too_few_neighbors (none to describe; for SHOT and CSHOT also fewer than five, the
/// key point and its copies included); `out` is all zeros then, and never NaN. No allocation; reentrant;
/// chunk_bytes<D, ChunkSize> of stack and half a kilobyte more. The result depends neither on the order of the
/// neighbors nor on ChunkSize: what is done for a neighbor depends on no other, and sums are integers.
template <class D, std::uint32_t ChunkSize = default_chunk_size, class Neighbors, class... Own>
[[nodiscard]] inline Status describe(const Neighbors& n, const extend::SourceSet<Own...>& sources, const Frame& frame,
                                     Radius radius, float* out) noexcept {
  constexpr bool has_all = detail::has_sources(typename D::Sources{}, static_cast<extend::SourceSet<Own...>*>(nullptr));
  static_assert(
      has_all,
      "describe() needs a source for each of D's signals: RgbColors or LabColors for ColorDistance, CloudNormals "
      "for NormalCosine, CloudIntensities for Intensity, and your own for your own");
  constexpr bool has_own_sums = detail::short_sums<ChunkSize>(D{}) > 0;
  if (!has_own_sums) std::memset(out, 0, D::size_bytes);
  Status status = validate(radius);
  if (status == Status::ok && D::needs_frame) status = validate(frame);
  if constexpr (has_all) {
    if (status == Status::ok) status = detail::status_of(typename D::Sources{}, sources);
    if (status == Status::ok && n.size > max_neighbors) status = Status::too_many_neighbors;
    const Frame& used = D::needs_frame ? frame : detail::any_frame;
    if (status == Status::ok) status = detail::describe_checked<D, ChunkSize>(n, sources, used, radius, out);
  }
  if (has_own_sums && status != Status::ok) std::memset(out, 0, D::size_bytes);
  return status;
}

/// The same with one source.
template <class D, std::uint32_t ChunkSize = default_chunk_size, class Neighbors, class Source>
[[nodiscard]] inline Status describe(const Neighbors& n, const Source& source, const Frame& frame, Radius radius,
                                     float* out) noexcept {
  return describe<D, ChunkSize>(n, sources(source), frame, radius, out);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_KERNEL_DESCRIBE_HPP
