// shortshot/sample.hpp: uniform key points, one per occupied voxel. Hosted only: allocates.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "cloud.hpp"
#include "config.hpp"
#include "math.hpp"
#include "rounded.hpp"
#include "status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {

/// One key point per voxel of `leaf` metres that holds a valid point: the point nearest to the voxel's centre (the one
/// with the smaller index if two are as near). Voxels lie on a grid through the origin.
/// `keypoints` receives indices into the cloud in ascending order. Statuses: empty_cloud (also if no point is valid),
/// bad_view, bad_leaf. O(n log n); allocates 24 bytes a point; the same result on every machine.
[[nodiscard]] inline Status sample_uniform(const CloudView& cloud, float leaf, std::vector<std::uint32_t>& keypoints) {
  keypoints.clear();
  const Status usable = check(cloud);
  if (usable != Status::ok) return usable;
  if (!math::is_finite(leaf) || !(leaf > 0.0f)) return Status::bad_leaf;

  // Voxel numbers stay floats: whole numbers, exact up to 2^24 voxels from the origin, as the coordinates are.
  struct Candidate {
    float voxel[3];
    float d2;  // to the voxel's centre, in voxels
    std::uint32_t index;
  };
  const auto key = [](const Candidate& c) { return std::tie(c.voxel[2], c.voxel[1], c.voxel[0], c.d2, c.index); };
  std::vector<Candidate> candidates;
  candidates.reserve(cloud.size);
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Point p = point(cloud, i);
    if (!is_finite(p)) continue;
    Candidate candidate{
        {std::floor(p.x / leaf), std::floor(p.y / leaf), std::floor(p.z / leaf)}, 0.0f, static_cast<std::uint32_t>(i)};
    const float dx = p.x / leaf - candidate.voxel[0] - 0.5f;
    const float dy = p.y / leaf - candidate.voxel[1] - 0.5f;
    const float dz = p.z / leaf - candidate.voxel[2] - 0.5f;
    candidate.d2 = (rounded(dx * dx) + rounded(dy * dy)) + rounded(dz * dz);
    candidates.push_back(candidate);
  }
  if (candidates.empty()) return Status::empty_cloud;

  std::sort(candidates.begin(), candidates.end(),
            [&](const Candidate& a, const Candidate& b) { return key(a) < key(b); });
  const auto same_voxel = [](const Candidate& a, const Candidate& b) {
    return a.voxel[0] == b.voxel[0] && a.voxel[1] == b.voxel[1] && a.voxel[2] == b.voxel[2];
  };
  const auto end = std::unique(candidates.begin(), candidates.end(), same_voxel);
  for (auto c = candidates.begin(); c != end; ++c) keypoints.push_back(c->index);
  std::sort(keypoints.begin(), keypoints.end());
  return Status::ok;
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
