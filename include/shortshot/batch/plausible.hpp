// shortshot/batch/plausible.hpp: what can be seen of numbers that cannot work, at next to no cost: a search over
// another cloud, and coordinates too large for float to hold the shape. Hosted only.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../base/math.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "growing_workspace.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Are up to eight of the neighbors where the cloud has them? The search says where they lie and which points they are:
/// one over another cloud, or over what was in this memory before, says it of other places. To the last bit, but for
/// compilers that compute in longer registers.
[[nodiscard]] inline bool is_of(const CloudView& cloud, const Point& center, const Neighborhood& n) noexcept {
  constexpr std::uint32_t most = 8;
  const std::uint32_t looked_at = n.size < most ? n.size : most;
  const auto agree = [](float a, float b) { return __builtin_fabsf(a - b) <= 1e-6f * __builtin_fabsf(a); };
  for (std::uint32_t k = 0; k < looked_at; ++k) {
    const auto i = static_cast<std::uint32_t>(std::uint64_t{n.size} * k / looked_at);
    if (n.index[i] >= cloud.size) return false;
    const Neighbor v = neighbor_from(center, point(cloud, n.index[i]), n.index[i]);
    if (!agree(n.dx[i], v.dx) || !agree(n.dy[i], v.dy) || !agree(n.dz[i], v.dz)) return false;
  }
  return true;
}

/// Does the search know the cloud's first valid point? For the case that it has found nothing anywhere.
template <class Search>
[[nodiscard]] bool finds_a_point(const CloudView& cloud, const Search& search, Radius radius,
                                 GrowingWorkspace& workspace) {
  Point p;
  Neighborhood n;
  if (next_valid(cloud, 0, p) == cloud.size) return true;
  return workspace.gather(search, p, radius, n) != Status::ok || (n.found > 0 && is_of(cloud, p, n));
}

/// How far apart floats lie at a point's largest coordinate.
[[nodiscard]] inline float float_spacing(const Point& p) noexcept {
  float largest = 0.0f;
  for (const float v : {p.x, p.y, p.z}) {
    if (__builtin_fabsf(v) > largest) largest = __builtin_fabsf(v);
  }
  return math::float_of(math::bits_of(largest) & 0x7F800000u) * 1.1920929e-7f;
}

/// Is what float can tell apart there more than a 64th of the radius? Measured on frames of a depth camera, R = 4 cm:
/// of coordinates rounded to a 1000th of R, one local frame in 100 turns; to a 100th, 1 in 17; to a 64th, 1 in 9; to a
/// 32nd, 1 in 5; to a 16th, 1 in 3, and half of all matches are lost, as by a millimeter of noise.
[[nodiscard]] inline bool is_coarse(const Point& p, Radius radius) noexcept {
  return float_spacing(p) > radius.value * (1.0f / 64.0f);
}

/// All valid points of a cloud: the first one that is not answers.
[[nodiscard]] inline bool all_are_coarse(const CloudView& cloud, Radius radius) noexcept {
  Point p;
  std::size_t i = next_valid(cloud, 0, p);
  const bool any = i < cloud.size;
  while (i < cloud.size && is_coarse(p, radius)) i = next_valid(cloud, i + 1, p);
  return i == cloud.size && any;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
