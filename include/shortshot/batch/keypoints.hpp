// shortshot/batch/keypoints.hpp: uniform key points, one per occupied voxel. Hosted only: allocates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../base/math.hpp"
#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/keypoint.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../status.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A valid point of a cloud in its voxel. Voxel numbers stay floats: whole numbers, exact up to 2^24 voxels from the
/// origin, as the coordinates are.
struct VoxelMember {
  float voxel[3];
  float place[3];  // in the voxel, from its corner, in voxels
  float d2;        // to the voxel's center, in voxels
  std::uint32_t index;
};

[[nodiscard]] inline bool same_voxel(const VoxelMember& a, const VoxelMember& b) noexcept {
  return a.voxel[0] == b.voxel[0] && a.voxel[1] == b.voxel[1] && a.voxel[2] == b.voxel[2];
}

/// All valid points, voxel after voxel, in each the one nearest to its center first.
[[nodiscard]] inline Status sort_into_voxels(const CloudView& cloud, float leaf, std::vector<VoxelMember>& members) {
  const Status usable = validate(cloud);
  if (usable != Status::ok) return usable;
  if (!math::is_finite(leaf) || !(leaf > 0.0f)) return Status::bad_leaf;
  members.clear();
  members.reserve(cloud.size);
  for_each_valid(cloud, [&](std::size_t i, const Point& p) {
    VoxelMember member{{}, {}, 0.0f, static_cast<std::uint32_t>(i)};
    float from_center[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float position = coordinate(p, axis) / leaf;
      member.voxel[axis] = __builtin_floorf(position);
      member.place[axis] = math::is_finite(position) ? position - member.voxel[axis] : 0.0f;
      from_center[axis] = member.place[axis] - 0.5f;
    }
    member.d2 = (unfused(from_center[0] * from_center[0]) + unfused(from_center[1] * from_center[1])) +
                unfused(from_center[2] * from_center[2]);
    members.push_back(member);
  });
  if (members.empty()) return Status::empty_cloud;
  std::sort(members.begin(), members.end(), [](const VoxelMember& a, const VoxelMember& b) {
    for (std::size_t axis = 3; axis-- > 0;) {
      if (a.voxel[axis] != b.voxel[axis]) return a.voxel[axis] < b.voxel[axis];
    }
    return a.d2 != b.d2 ? a.d2 < b.d2 : a.index < b.index;
  });
  return Status::ok;
}

/// The centroid of one voxel's members, with the means of their colors and of their intensities (the finite ones).
[[nodiscard]] inline KeyPoint centroid_of(const CloudView& cloud, float leaf, const VoxelMember* first,
                                          const VoxelMember* end) noexcept {
  const auto count = static_cast<std::uint32_t>(end - first);
  float place[3] = {};
  std::uint64_t rgb[3] = {};
  float intensities = 0.0f;
  std::uint32_t echoes = 0;
  for (const VoxelMember* member = first; member != end; ++member) {
    for (std::size_t axis = 0; axis < 3; ++axis) place[axis] += member->place[axis];
    if (has_colors(cloud)) {
      const Rgb c = color(cloud, member->index);
      rgb[0] += c.r;
      rgb[1] += c.g;
      rgb[2] += c.b;
    }
    const float echo = has_intensities(cloud) ? intensity(cloud, member->index) : 0.0f;
    if (!math::is_finite(echo)) continue;
    intensities += echo;
    ++echoes;
  }
  const auto at = [&](std::size_t axis) {
    return (first->voxel[axis] + place[axis] / static_cast<float>(count)) * leaf;
  };
  const auto mean = [&](std::size_t c) { return static_cast<std::uint8_t>((rgb[c] + count / 2) / count); };
  KeyPoint key(Point{at(0), at(1), at(2)});
  if (has_colors(cloud)) key = KeyPoint(key.position, {mean(0), mean(1), mean(2)});
  key.has_intensity = has_intensities(cloud) && echoes > 0;
  if (key.has_intensity) key.intensity = intensities / static_cast<float>(echoes);
  return key;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// One key point per voxel of `leaf` meters that holds a valid point: the point nearest to the voxel's center (the one
/// with the smaller index if two are as near). Voxels lie on a grid through the origin.
/// `keypoints` receives indices into the cloud in ascending order. Statuses: empty_cloud (also if no point is valid),
/// bad_view, bad_leaf. O(n log n); allocates 32 bytes a point; the same result on every machine.
[[nodiscard]] inline Status sample_uniform(const CloudView& cloud, float leaf, std::vector<std::uint32_t>& keypoints) {
  keypoints.clear();
  std::vector<detail::VoxelMember> members;
  const Status status = detail::sort_into_voxels(cloud, leaf, members);
  if (status != Status::ok) return status;
  const auto end = std::unique(members.begin(), members.end(), detail::same_voxel);
  for (auto member = members.begin(); member != end; ++member) keypoints.push_back(member->index);
  std::sort(keypoints.begin(), keypoints.end());
  return Status::ok;
}

/// The same with the centroid, the mean color and the mean intensity (of what the cloud has) of each voxel's points:
/// less noise than any one of them has, which pays most where the key point's color is what color distances refer to.
/// Voxels by z, then y, then x.
[[nodiscard]] inline Status sample_centroids(const CloudView& cloud, float leaf, std::vector<KeyPoint>& keypoints) {
  keypoints.clear();
  std::vector<detail::VoxelMember> members;
  const Status status = detail::sort_into_voxels(cloud, leaf, members);
  if (status != Status::ok) return status;
  const detail::VoxelMember* const end = members.data() + members.size();
  for (const detail::VoxelMember* first = members.data(); first != end;) {
    const detail::VoxelMember* next = first + 1;
    while (next != end && detail::same_voxel(*first, *next)) ++next;
    const KeyPoint centroid = detail::centroid_of(cloud, leaf, first, next);
    // Beyond the reach of voxel numbers a point stands for itself.
    keypoints.push_back(is_finite(centroid.position) ? centroid : keypoint(cloud, first->index));
    first = next;
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
