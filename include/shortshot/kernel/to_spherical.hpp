// shortshot/kernel/to_spherical.hpp: the kernel's first pass. A chunk of neighbors goes from offsets in the cloud's
// coordinates to spherical coordinates in the frame.
#ifndef SHORTSHOT_KERNEL_TO_SPHERICAL_HPP
#define SHORTSHOT_KERNEL_TO_SPHERICAL_HPP

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../cloud/point_lanes.hpp"
#include "../config.hpp"
#include "../descriptor/exact_shells.hpp"
#include "../frame/frame.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "chunk.hpp"
#include "measure_signals.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A frame in all lanes, and a copy (see Collector). (Small code does without: it takes the frame's own floats.)
struct FrameLanes {
  simd::F32 x[3], y[3], z[3];
  explicit FrameLanes(const Frame& frame) noexcept {
    unroll<3>([&](auto k) {
      x[k] = simd::all(frame.x[k]);
      y[k] = simd::all(frame.y[k]);
      z[k] = simd::all(frame.z[k]);
    });
  }
};

/// The neighbors of one chunk: `count` stretches of the neighborhood, `stride` apart, of `length` each.
struct Stretches {
  std::uint32_t first;
  std::uint32_t stride;
  std::uint32_t count;
  std::uint32_t length;
};

/// Four stretches for each chunk that is full, where there are lanes. Neighbors that follow each other lie in the same
/// cells, where each addition would wait for the one before; a chunk from four places has others to add in between.
/// (Sums do not depend on the order.) The last chunk has what is left, in one stretch; and so has every chunk of a
/// small CPU, which waits for nothing.
inline constexpr std::uint32_t stretches_of_full_chunk = 4;

template <std::uint32_t ChunkSize>
[[nodiscard]] inline Stretches stretches_of_chunk(std::uint32_t chunk, std::uint32_t neighbors) noexcept {
  constexpr std::uint32_t length = ChunkSize / stretches_of_full_chunk;
  constexpr bool spread = simd::lanes > 1 && length > 0 && length % simd::lanes == 0;
  const std::uint32_t full_chunks = neighbors / ChunkSize;
  if (spread && chunk < full_chunks) return {chunk * length, full_chunks * length, stretches_of_full_chunk, length};
  const std::uint32_t left = neighbors - chunk * ChunkSize;
  return {chunk * ChunkSize, 0, 1, left < ChunkSize ? left : ChunkSize};
}

/// One register of neighbors as in the rows of a chunk, and which of them are described.
template <int Values>
struct Located {
  simd::F32 distance, elevation, azimuth;
  simd::F32 values[static_cast<std::size_t>(Values + (Values == 0 ? 1 : 0))];  // an array has one or more
  simd::Mask described;
};

template <class Cells, class Borders, int Values, class FrameAxes, class Signals>
[[nodiscard]] SHORTSHOT_INLINE Located<Values> locate_register(const NeighborLanes& v, const FrameAxes& frame,
                                                               Radius radius, const Signals& signals) noexcept {
  const PointLanes offset{v.dx, v.dy, v.dz};
  const PointLanes local{along(frame.x, offset), along(frame.y, offset), along(frame.z, offset)};
  Located<Values> located{};
  located.distance = distance_over_radius<Borders>(v.d2, local, radius);
  const simd::F32 from_axis = simd::sqrt(local.x * local.x + local.y * local.y);
  located.elevation = Cells::elevation(local, from_axis, radius);
  located.azimuth = Cells::azimuth(local, from_axis);
  located.described = Cells::are_described(v.d2, radius);
  if constexpr (Signals::count > 0) {
    std::uint32_t indices[simd::lanes];
    simd::store(indices, v.index);
    signals.measure(NeighborsAt<FrameAxes>{indices, offset, local, frame}, located.described, located.values);
  }
  return located;
}

/// One register of neighbors behind the first `size` of a chunk; `packing` leaves out those that are not described.
template <class Chunk, int Values, class Signals, class... Packing>
SHORTSHOT_INLINE void append(Chunk& chunk, std::uint32_t size, simd::I32 index, const Located<Values>& located,
                             const Signals& signals, const Packing&... packing) noexcept {
  simd::store(chunk.index + size, index, packing...);
  float* const row = chunk.rows + size;
  simd::store(row, located.distance, packing...);
  simd::store(row + Chunk::room, located.elevation, packing...);
  simd::store(row + 2 * std::size_t{Chunk::room}, located.azimuth, packing...);
  signals.append(chunk, size, located.values, packing...);
}

/// Neighbors into a chunk: from the cloud's coordinates to spherical ones in the frame. (Nothing here depends on the
/// descriptor but through the arguments: many of them share this.)
template <class Cells, class Borders, class Neighbors, class Signals, class Chunk>
[[gnu::noinline]] inline void locate(const Neighbors& all, const Stretches& stretches, const Frame& frame,
                                     Radius radius, const Signals& signals_of_place, Chunk& chunk) noexcept {
  constexpr int values = Signals::count > 0 ? Chunk::signals : 0;
  std::conditional_t<simd::lanes == 1, const Neighbors&, Collector<const Neighbors>> n = all;  // too few registers
  const Signals signals = signals_of_place;
  std::conditional_t<small_code, const Frame&, const FrameLanes> axes(frame);
  std::uint32_t size = 0;
  std::uint32_t i = stretches.first;  // one loop over all stretches: what it keeps in registers is loaded once
  std::uint32_t end = i + stretches.length;
  for (std::uint32_t left = stretches.count;;) {
    const NeighborLanes v = load_neighbors(n, i);
    const Located<values> now = locate_register<Cells, Borders, values>(v, axes, radius, signals);
    if (every(now.described)) {
      append(chunk, size, v.index, now, signals);
      size += static_cast<std::uint32_t>(simd::lanes);
    } else if constexpr (simd::lanes > 1) {
      const simd::Packing packing = simd::packing(now.described);
      append(chunk, size, v.index, now, signals, packing);
      size += packing.count;
    }
    i += simd::lanes;
    if (i >= end) {
      if (simd::lanes == 1 || --left == 0) break;  // where there is one lane, there is one stretch
      i = end + (stretches.stride - stretches.length);
      end += stretches.stride;
    }
  }
  chunk.size = size;
  // What passes read beyond the end must be points that exist, and numbers.
  for (; size % Chunk::step != 0; ++size) {
    chunk.index[size] = n.index[stretches.first];
    for (int k = 0; k < Chunk::rows_of_place + Chunk::signals; ++k)
      chunk.rows[size + std::size_t{Chunk::room} * static_cast<std::size_t>(k)] = 0.0f;
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_KERNEL_TO_SPHERICAL_HPP
