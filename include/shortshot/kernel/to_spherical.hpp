// shortshot/kernel/to_spherical.hpp: the kernel's first pass. A chunk of neighbors goes from offsets in the cloud's
// coordinates to spherical coordinates in the frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../search/neighborhood.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// A chunk of neighbors in the frame's spherical coordinates. Only those that are described: passes need no masks.
template <bool WithNormals, bool WithColors, std::uint32_t Room>
struct Chunk {
  static_assert(Room >= simd::lanes && Room <= 1024 && Room % simd::lanes == 0,
                "ChunkSize supports multiples of simd::lanes up to 1024: registers do not reach beyond its end");
  static constexpr std::uint32_t room = Room;
  static constexpr bool with_normals = WithNormals;
  static constexpr int normal_row = 3;
  static constexpr int color_row = WithNormals ? 4 : 3;
  std::uint32_t size;
  std::uint32_t index[Room];  ///< in the cloud
  float
      rows[(WithColors ? color_row + 1 : color_row) * Room];  // one array, so that one register holds the place in all

  /// From neighbor `i` on, all 0..1: row 0, the distance over the radius; 1, the angle from +z over pi; 2, the angle
  /// from -x, counter-clockwise, in turns, or below 0 where a convention with poles has none; and the signals of those
  /// parts that have one.
  [[nodiscard]] const float* row(int k, std::uint32_t i) const noexcept {
    return rows + i + static_cast<std::size_t>(k) * Room;
  }
};

/// Which neighbors with these squared distances are described? Not the key point and its copies; and those beyond the
/// radius are there for a wider frame.
template <class Cells>
[[nodiscard]] inline simd::Mask are_described(simd::F32 d2, Radius radius) noexcept {
  return (d2 > simd::all(Cells::copies_d2)) & (d2 < simd::all(radius.squared));
}

/// Which of these distances (over the radius) are as close to the border or the middle of a shell as their rounding?
/// All of both are multiples of 1 / `borders`.
[[nodiscard]] SHORTSHOT_INLINE simd::Mask near_border(simd::F32 distance, float borders) noexcept {
  const simd::F32 position = distance * simd::all(borders);
  const simd::F32 whole = simd::all(12582912.0f);  // 1.5 * 2^23: sums with it are rounded to whole numbers
  const simd::F32 nearest = (position + whole) - whole;
  return simd::all(1e-6f * borders) > simd::abs(position - nearest);
}

/// One register of coordinates in the frame, each rounded as the published code rounds it: x + z first, then y.
struct Local {
  simd::F32 x, y, z;
};

[[nodiscard]] SHORTSHOT_INLINE simd::F32 along(const float (&axis)[3], const PointLanes& v) noexcept {
  return (v.x * simd::all(axis[0]) + v.z * simd::all(axis[2])) + v.y * simd::all(axis[1]);
}

/// A frame in all lanes: a copy, which no store can change. (Small code does without: it takes the frame's own floats.)
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

/// Distances over the radius. Points of a regular grid lie exactly on the borders of shells, where one bit decides
/// which neighboring shell gets a vote: there, and only there, they are computed with more bits than a float has.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 relative_distance(const NeighborLanes& v, const Local& local, Radius radius,
                                                           float borders) noexcept {
  const simd::F32 inverse = simd::all(1.0f / radius.value);
  const simd::F32 distance = simd::sqrt(v.d2) * inverse;
  const simd::Mask near = near_border(distance, borders);
  if (any(near)) {
    const float splitter = math::length_splitter(radius.value);
    const simd::F32 exact = math::length(local.x, local.y, local.z, splitter) * inverse;
    // A frame that is not quite orthonormal must not move its neighbors from border to border.
    const simd::Mask same = simd::all(2e-6f) > simd::abs(exact - distance);
    return select(near & same, simd::min(exact, simd::all(1.0f)), distance);
  }
  return distance;
}

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
struct Located {
  simd::F32 distance, elevation, azimuth, normal;
  simd::Mask described;
};

template <class Cells, bool ExactShells, bool WithNormals, class FrameAxes, class Normals>
[[nodiscard]] SHORTSHOT_INLINE Located locate_register(const NeighborLanes& v, const FrameAxes& frame, Radius radius,
                                                       float borders, const Normals& normals) noexcept {
  using simd::all;
  const PointLanes offset{v.dx, v.dy, v.dz};
  const Local local{along(frame.x, offset), along(frame.y, offset), along(frame.z, offset)};
  Located located{};
  if constexpr (ExactShells) {
    located.distance = relative_distance(v, local, radius, borders);
  } else {
    located.distance = simd::sqrt(v.d2) * all(1.0f / radius.value);
  }
  const simd::F32 from_axis = simd::sqrt(local.x * local.x + local.y * local.y);
  located.elevation = math::elevation(from_axis, local.z);
  located.azimuth = math::azimuth(local.x, local.y);
  located.described = are_described<Cells>(v.d2, radius);
  if constexpr (Cells::has_poles) {
    located.azimuth = select(from_axis > all(0.0f), located.azimuth, all(-1.0f));
  }
  if constexpr (WithNormals) {
    std::uint32_t indices[simd::lanes];
    simd::store(indices, v.index);
    const simd::F32 cosine = along(frame.z, normals(indices));
    located.described = located.described & (all(3e38f) > simd::abs(cosine));  // false for NaN
    located.normal = simd::max(simd::min(cosine, all(1.0f)), all(-1.0f)) * all(0.5f) + all(0.5f);
  }
  return located;
}

/// One register of neighbors behind the first `size` of a chunk; `packing` leaves out those that are not described.
template <class Chunk, class... Packing>
SHORTSHOT_INLINE void append(Chunk& chunk, std::uint32_t size, simd::I32 index, const Located& located,
                             const Packing&... packing) noexcept {
  simd::store(chunk.index + size, index, packing...);
  float* const row = chunk.rows + size;
  simd::store(row, located.distance, packing...);
  simd::store(row + Chunk::room, located.elevation, packing...);
  simd::store(row + 2 * std::size_t{Chunk::room}, located.azimuth, packing...);
  if constexpr (Chunk::with_normals) {
    simd::store(row + Chunk::normal_row * std::size_t{Chunk::room}, located.normal, packing...);
  }
}

/// Neighbors into a chunk. (Nothing here depends on the descriptor but through the arguments: many of them share
/// this.)
template <class Cells, bool ExactShells, class Neighbors, class Normals, class Chunk>
[[gnu::noinline]] inline void locate(const Neighbors& all, const Stretches& stretches, const Frame& frame,
                                     Radius radius, float borders, const Normals& normals, Chunk& chunk) noexcept {
  Collector<const Neighbors> n = all;  // no store can change a local
  std::conditional_t<small_code, const Frame&, const FrameLanes> axes(frame);
  std::uint32_t size = 0;
  for (std::uint32_t k = 0; k < stretches.count; ++k) {
    const std::uint32_t first = stretches.first + k * stretches.stride;
    const std::uint32_t end = first + stretches.length;
    for (std::uint32_t i = first; i < end; i += simd::lanes) {
      const NeighborLanes v = load_neighbors(n, i);
      const Located now = locate_register<Cells, ExactShells, Chunk::with_normals>(v, axes, radius, borders, normals);
      if (every(now.described)) {
        append(chunk, size, v.index, now);
        size += static_cast<std::uint32_t>(simd::lanes);
      } else if constexpr (simd::lanes > 1) {
        const simd::Packing packing = simd::packing(now.described);
        append(chunk, size, v.index, now, packing);
        size += packing.count;
      }
    }
  }
  chunk.size = size;
  // What passes read beyond the end must be colors that exist.
  for (; size % simd::lanes != 0; ++size) chunk.index[size] = n.index[stretches.first];
}

}  // namespace detail
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
