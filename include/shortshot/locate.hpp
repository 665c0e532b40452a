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
template <bool WithNormals>
struct Chunk {
  std::uint32_t size;
  std::uint32_t index[chunk_size];                        ///< in the cloud
  float coordinates[(WithNormals ? 4 : 3) * chunk_size];  // one array, so that one register holds the place in all

  /// From neighbour `i` on: the distance over the radius, 0..1; the angle from +z over pi, 0..1; and the angle from -x,
  /// counter-clockwise, in turns, 0..1, or below 0 where a convention with poles has none.
  [[nodiscard]] const float* distance(std::uint32_t i) const noexcept { return coordinates + i; }
  [[nodiscard]] const float* elevation(std::uint32_t i) const noexcept { return coordinates + i + chunk_size; }
  [[nodiscard]] const float* azimuth(std::uint32_t i) const noexcept {
    return coordinates + i + 2 * std::size_t{chunk_size};
  }
  /// The normal's component along z, -1..1.
  [[nodiscard]] const float* cosine(std::uint32_t i) const noexcept {
    static_assert(WithNormals, "there is one only where a part asks for normals");
    return coordinates + i + 3 * std::size_t{chunk_size};
  }
};

/// Which neighbours with these squared distances are described? Not the key point and its copies; and those beyond the
/// radius are there for a wider frame.
template <class Cells>
[[nodiscard]] inline simd::Mask are_described(simd::F32 d2, Radius radius) noexcept {
  return (d2 > simd::all(Cells::copies_d2)) & (d2 < simd::all(radius.squared));
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
  [[nodiscard]] simd::F32 along(const PointLanes& v) const noexcept { return (v.x * x + v.z * z) + v.y * y; }
};

struct FrameLanes {
  AxisLanes x, y, z;
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

/// One register of neighbours in the coordinates of a chunk, and which of them are described.
struct Located {
  simd::F32 distance, elevation, azimuth, cosine;
  simd::Mask described;
};

template <class D, class Normals>
[[nodiscard, gnu::always_inline]] inline Located locate_register(const Offsets& v, simd::I32 index,
                                                                 const FrameLanes& frame, Radius radius,
                                                                 const Normals& normals) noexcept {
  using simd::all;
  const Local local{frame.x.along(v), frame.y.along(v), frame.z.along(v)};
  Located located{};
  located.distance = relative_distance<D::shell_borders>(v, local, radius);
  const simd::F32 from_axis = simd::sqrt(local.x * local.x + local.y * local.y);
  located.elevation = math::elevation(from_axis, local.z);
  located.azimuth = math::azimuth(local.x, local.y);
  located.described = are_described<typename D::Cells>(v.d2, radius);
  if constexpr (D::Cells::has_poles) {
    located.azimuth = select(from_axis > all(0.0f), located.azimuth, all(-1.0f));
  }
  if constexpr (D::needs_normals) {
    std::uint32_t indices[simd::lanes];
    simd::store(indices, index);
    const simd::F32 cosine = frame.z.along(normals(indices));
    located.described = located.described & (all(3e38f) > simd::abs(cosine));  // false for NaN
    located.cosine = simd::max(simd::min(cosine, all(1.0f)), all(-1.0f));
  }
  return located;
}

/// Neighbours into a chunk.
template <class D, class Normals>
[[gnu::noinline]] inline void locate(const Neighborhood& all, const Stretches& stretches, const Frame& frame,
                                     Radius radius, const Normals& normals, Chunk<D::needs_normals>& chunk) noexcept {
  const Neighborhood n = all;  // a local: no store to the chunk can change its pointers
  const FrameLanes axes{AxisLanes(frame.x), AxisLanes(frame.y), AxisLanes(frame.z)};
  std::uint32_t size = 0;
  for (std::uint32_t k = 0; k < stretches.count; ++k) {
    const std::uint32_t first = stretches.first + k * stretches.stride;
    const std::uint32_t end = first + stretches.length;
    for (std::uint32_t i = first; i < end; i += simd::lanes) {
      const Offsets v = load_offsets(n, i);
      const simd::I32 index = load_indices(n, i);
      const Located now = locate_register<D>(v, index, axes, radius, normals);
      const auto append = [&](const auto&... packing) {
        simd::store(chunk.index + size, index, packing...);
        float* const coordinates = chunk.coordinates + size;
        simd::store(coordinates, now.distance, packing...);
        simd::store(coordinates + chunk_size, now.elevation, packing...);
        simd::store(coordinates + 2 * std::size_t{chunk_size}, now.azimuth, packing...);
        if constexpr (D::needs_normals) {
          simd::store(coordinates + 3 * std::size_t{chunk_size}, now.cosine, packing...);
        }
      };
      if (every(now.described)) {
        append();
        size += static_cast<std::uint32_t>(simd::lanes);
      } else {
        const simd::Packing packing = simd::packing(now.described);
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
