// shortshot/locate.hpp: the kernel's first pass. A chunk of neighbours goes from offsets in the cloud's coordinates to
// spherical coordinates in the frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "config.hpp"
#include "frame.hpp"
#include "math.hpp"
#include "neighborhood.hpp"
#include "simd.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// Neighbours per chunk: of this length are all arrays that the kernel has on the stack.
inline constexpr std::uint32_t chunk_size = 64;
static_assert(chunk_size % simd::lanes == 0, "registers do not reach beyond the end of a chunk");

/// A chunk of neighbours in the frame's spherical coordinates. Only those that are described: passes need no masks.
struct Chunk {
  std::uint32_t size;
  std::uint32_t index[chunk_size];    ///< in the cloud
  float coordinates[3 * chunk_size];  // one array, so that one register holds the place in all

  /// From neighbour `i` on: the distance over the radius, 0..1; the angle from +z over pi, 0..1; and the angle from -x,
  /// counter-clockwise, in turns, 0..1.
  [[nodiscard]] const float* distance(std::uint32_t i) const noexcept { return coordinates + i; }
  [[nodiscard]] const float* elevation(std::uint32_t i) const noexcept { return coordinates + i + chunk_size; }
  [[nodiscard]] const float* azimuth(std::uint32_t i) const noexcept {
    return coordinates + i + 2 * std::size_t{chunk_size};
  }
};

/// Closest squared distance that is described: the published code skips the key point and its copies by this bound.
inline constexpr float min_described_d2 = 1e-15f;

/// Which neighbours with these squared distances are described? Those beyond the radius are there for a wider frame.
[[nodiscard]] inline simd::Mask are_described(simd::F32 d2, Radius radius) noexcept {
  return (d2 > simd::all(min_described_d2)) & (d2 < simd::all(radius.squared));
}

/// Which of these distances (over the radius) are as close to the border or the middle of a shell as their rounding?
/// All of both are multiples of 1 / `Borders`.
template <int Borders>
[[nodiscard]] inline simd::Mask near_border(simd::F32 distance) noexcept {
  const simd::F32 position = distance * simd::all(static_cast<float>(Borders));
  const simd::F32 nearest = to_float(round_to_int(position));
  return simd::all(1e-6f * static_cast<float>(Borders)) > simd::abs(position - nearest);
}

/// One register of coordinates in the frame, each rounded as the published code rounds it: x + z first, then y.
struct Local {
  simd::F32 x, y, z;
};

/// An axis of a frame in all lanes.
struct AxisLanes {
  simd::F32 x, y, z;
  explicit AxisLanes(const float (&axis)[3]) noexcept
      : x(simd::all(axis[0])), y(simd::all(axis[1])), z(simd::all(axis[2])) {}
  [[nodiscard]] simd::F32 along(const Offsets& v) const noexcept { return (v.dx * x + v.dz * z) + v.dy * y; }
};

/// Distances over the radius. Points of a regular grid lie exactly on the borders of shells, where one bit decides
/// which neighbouring shell gets a vote: there, and only there, they are computed with more bits than a float has.
template <int Borders>
[[nodiscard, gnu::always_inline]] inline simd::F32 relative_distance(const Offsets& v, const Local& local,
                                                                     Radius radius) noexcept {
  const simd::F32 inverse = simd::all(1.0f / radius.value);
  const simd::F32 distance = simd::sqrt(v.d2) * inverse;
  if constexpr (Borders > 1) {
    const simd::Mask near = near_border<Borders>(distance);
    if (any(near)) {
      const float splitter = math::length_splitter(radius.value);
      const simd::F32 exact = math::length(local.x, local.y, local.z, splitter) * inverse;
      // A frame that is not quite orthonormal must not move its neighbours from border to border.
      const simd::Mask same = simd::all(2e-6f) > simd::abs(exact - distance);
      return select(near & same, simd::min(exact, simd::all(1.0f)), distance);
    }
  }
  return distance;
}

/// The neighbours of one chunk: four stretches of the neighbourhood, `stride` apart, of a quarter chunk each.
/// Neighbours that follow each other lie in the same cells, where each addition would wait for the one before; a chunk
/// from four places has others to add in between. (Sums do not depend on the order.) The last chunk has what is left,
/// in one stretch.
inline constexpr std::uint32_t stretches_of_full_chunk = 4;

struct Stretches {
  std::uint32_t first;
  std::uint32_t stride;
  std::uint32_t count;
  std::uint32_t length;
};

[[nodiscard]] inline Stretches stretches_of_chunk(std::uint32_t chunk, std::uint32_t neighbors) noexcept {
  constexpr std::uint32_t length = chunk_size / stretches_of_full_chunk;
  const std::uint32_t full_chunks = neighbors / chunk_size;
  if (chunk < full_chunks) return {chunk * length, full_chunks * length, stretches_of_full_chunk, length};
  return {chunk * chunk_size, 0, 1, neighbors - chunk * chunk_size};
}

/// Neighbours into a chunk.
template <int Borders>
inline void locate(const Neighborhood& all, const Stretches& stretches, const Frame& frame, Radius radius,
                   Chunk& chunk) noexcept {
  const Neighborhood n = all;  // a local: no store to the chunk can change its pointers
  const AxisLanes x_axis(frame.x);
  const AxisLanes y_axis(frame.y);
  const AxisLanes z_axis(frame.z);
  std::uint32_t size = 0;
  for (std::uint32_t k = 0; k < stretches.count; ++k) {
    const std::uint32_t first = stretches.first + k * stretches.stride;
    const std::uint32_t end = first + stretches.length;
    for (std::uint32_t i = first; i < end; i += simd::lanes) {
      const Offsets v = load_offsets(n, i);
      const simd::I32 index = load_indices(n, i);
      const Local local{x_axis.along(v), y_axis.along(v), z_axis.along(v)};
      const simd::F32 distance = relative_distance<Borders>(v, local, radius);
      const simd::F32 elevation = math::elevation(simd::sqrt(local.x * local.x + local.y * local.y), local.z);
      const simd::F32 azimuth = math::azimuth(local.x, local.y);
      const auto append = [&](const auto&... packing) {
        simd::store(chunk.index + size, index, packing...);
        float* const coordinates = chunk.coordinates + size;
        simd::store(coordinates, distance, packing...);
        simd::store(coordinates + chunk_size, elevation, packing...);
        simd::store(coordinates + 2 * std::size_t{chunk_size}, azimuth, packing...);
      };
      const simd::Mask described = are_described(v.d2, radius);
      if (every(described)) {
        append();
        size += static_cast<std::uint32_t>(simd::lanes);
      } else {
        const simd::Packing packing = simd::packing(described);
        append(packing);
        size += packing.count;
      }
    }
  }
  chunk.size = size;
  // What passes read beyond the end must be colours that exist.
  for (; size % simd::lanes != 0; ++size) chunk.index[size] = n.index[stretches.first];
}

}  // namespace detail
}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
