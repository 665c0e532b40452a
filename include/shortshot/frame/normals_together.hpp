// shortshot/frame/normals_together.hpp: the normals of a group of points among the same candidates.
#ifndef SHORTSHOT_FRAME_NORMALS_TOGETHER_HPP
#define SHORTSHOT_FRAME_NORMALS_TOGETHER_HPP

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../base/simd.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/point_lanes.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "candidate_chunk.hpp"
#include "normal.hpp"
#include "viewpoint.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Points side by side, at most 16, whole registers of them.
struct PlaceGroup {
  static constexpr std::size_t most = 16;
  const float* x;
  const float* y;
  const float* z;
  std::size_t count;
};

/// Their normals, three components each; zeros for those that need to be looked at alone. `candidates`, gathered within
/// `wide`, has all their neighbors within `radius`.
inline void normals_together(const CloudView& cloud, const Neighborhood& candidates, Radius wide, Radius radius,
                             const Viewpoint& viewpoint, const PlaceGroup& group, float* normals) noexcept {
  const MomentScale scale = moment_scale(candidates.size, wide.value);
  Moments shares[PlaceGroup::most] = {};
  CandidateChunk chunk;
  for (std::uint32_t i = 0; i < candidates.size; i += CandidateChunk::most) {
    chunk.fill(cloud, candidates, i, scale);
    for (std::size_t k = 0; k < group.count; ++k) {
      chunk.add_neighbors({group.x[k], group.y[k], group.z[k]}, radius, shares[k]);
    }
  }
  for (std::size_t k = 0; k < group.count; k += simd::lanes) {
    const Moments moments = totals(shares + k);
    const PointLanes places{simd::load(group.x + k), simd::load(group.y + k), simd::load(group.z + k)};
    const PointLanes towards = directions(viewpoint, places);
    SurfaceNormal found[simd::lanes];
    store(found, keep(is_fine(moments, scale), normals_of(moments, scale, towards)));
    std::memcpy(normals + 3 * k, found, sizeof found);
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_FRAME_NORMALS_TOGETHER_HPP
