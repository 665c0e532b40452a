// shortshot/cloud/voxel_lanes.hpp: in which voxel a point is, a register of points at a time.
#ifndef SHORTSHOT_CLOUD_VOXEL_LANES_HPP
#define SHORTSHOT_CLOUD_VOXEL_LANES_HPP

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "cloud.hpp"
#include "point_lanes.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Points in their voxels, which lie on a grid through the origin. Voxel numbers stay floats: whole numbers, exact up
/// to 2^24 voxels from the origin, as the coordinates are; infinite beyond float's range, where all points share one.
struct VoxelLanes {
  simd::F32 number[3];  ///< never -0
  simd::F32 place[3];   ///< in the voxel, from its corner, in voxels
  simd::F32 d2;         ///< to the voxel's center, in voxels
};

[[nodiscard]] inline simd::F32 floor_of(simd::F32 position) noexcept {
  if (every(simd::all(4194304.0f) > simd::abs(position))) {  // 2^22
    const simd::F32 whole = simd::to_whole(position);
    return whole - keep(whole > position, simd::all(1.0f));
  }
  return simd::map([](float a) { return __builtin_floorf(a); }, position) + simd::all(0.0f);
}

[[nodiscard]] inline VoxelLanes voxels_of(const PointLanes& points, float leaf) noexcept {
  VoxelLanes voxels;
  const simd::F32 coordinates[3] = {points.x, points.y, points.z};
  simd::F32 squares[3];
  unroll<3>([&](auto axis) {
    const simd::F32 position = coordinates[axis] / simd::all(leaf);
    voxels.number[axis] = floor_of(position);
    const simd::Mask finite = simd::all(HUGE_VALF) > simd::abs(position);
    voxels.place[axis] = keep(finite, position) - keep(finite, voxels.number[axis]);
    const simd::F32 from_center = voxels.place[axis] - simd::all(0.5f);
    squares[axis] = from_center * from_center;
  });
  voxels.d2 = (squares[0] + squares[1]) + squares[2];
  return voxels;
}

/// Points that are placed at once.
inline constexpr std::size_t voxel_block = 256;

/// Points [begin, begin + voxel_block) of a cloud, as far as there are any: their voxels' numbers, and the squared
/// distances to the voxels' centers, -1 for what is no point. Returns how many that are.
inline std::size_t place_in_voxels(const CloudView& cloud, float leaf, std::size_t begin,
                                   float (&number)[3][voxel_block], float (&d2)[voxel_block]) noexcept {
  static_assert(voxel_block % simd::lanes == 0, "whole registers");
  const std::size_t left = cloud.size - begin;
  const std::size_t size = left < voxel_block ? left : voxel_block;
  const Float3Channel channel = cloud.points;
  for (std::size_t i = 0; i < size; i += simd::lanes) {
    const ValidLanes read = read_valid(channel, begin + i, size - i);
    simd::store(d2 + i, simd::all(-1.0f));
    if (!any(read.valid)) continue;
    const VoxelLanes voxels = voxels_of(read.points, leaf);
    unroll<3>([&](auto axis) { simd::store(number[axis] + i, voxels.number[axis]); });
    simd::store(d2 + i, select(read.valid, voxels.d2, simd::all(-1.0f)));
  }
  return size;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_CLOUD_VOXEL_LANES_HPP
