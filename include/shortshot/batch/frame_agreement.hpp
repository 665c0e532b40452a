// shortshot/batch/frame_agreement.hpp: how well local frames repeat, from one cloud alone. Hosted only: allocates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/keypoint.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../frame/viewpoint.hpp"
#include "../kernel/support.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "grid_search.hpp"
#include "growing_workspace.hpp"
#include "keypoints.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The even or the odd points of a cloud: x y z.
[[nodiscard]] inline std::vector<float> half_of(const CloudView& cloud, std::size_t first) {
  std::vector<float> xyz;
  xyz.reserve(3 * (cloud.size / 2 + 1));
  for (std::size_t i = first; i < cloud.size; i += 2) {
    const Point p = point(cloud, i);
    for (const float v : {p.x, p.y, p.z}) xyz.push_back(v);
  }
  return xyz;
}

/// Axes less than 20 degrees apart.
[[nodiscard]] inline bool agree(const Frame& a, const Frame& b) noexcept {
  const auto cosine = [](const float(&u)[3], const float(&v)[3]) {
    return (unfused(u[0] * v[0]) + unfused(u[1] * v[1])) + unfused(u[2] * v[2]);
  };
  return cosine(a.x, b.x) > 0.94f && cosine(a.y, b.y) > 0.94f && cosine(a.z, b.z) > 0.94f;
}

/// Frames from one half of a cloud.
class HalfCloudFrames {  // stays where it is: the search views its coordinates
 public:
  HalfCloudFrames(const CloudView& cloud, std::size_t first, const Support& support)
      : xyz_(half_of(cloud, first)),
        search_(view_xyz(xyz_.data(), xyz_.size() / 3), support.radius.value),
        support_(support) {}

  [[nodiscard]] Status estimate(const Point& at, Frame& frame) {
    Neighborhood n;
    const Status status = workspace_.gather(search_, at, support_.frame_radius, n);
    return status == Status::ok ? estimate_frame(n, support_.frame_radius, frame, support_.viewpoint) : status;
  }

 private:
  std::vector<float> xyz_;
  GridSearch search_;
  Support support_;
  GrowingWorkspace workspace_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Share of the key points whose local frames from the even and from the odd points of the cloud have axes less than 20
/// degrees apart; negative if there are none to compare. Of up to 200 key points, one in a voxel of `leaf` meters.
/// Allocates both halves and a GridSearch over each.
[[nodiscard]] inline float frame_agreement(const CloudView& cloud, float radius, float leaf,
                                           const Viewpoint& viewpoint = {}) {
  constexpr std::size_t most = 200;
  std::vector<KeyPoint> keypoints;
  Support support = radius;
  support.viewpoint = viewpoint;
  if (validate(support.radius) != Status::ok || sample_centroids(cloud, leaf, keypoints) != Status::ok) return -1.0f;
  detail::HalfCloudFrames even(cloud, 0, support);
  detail::HalfCloudFrames odd(cloud, 1, support);
  std::size_t both = 0;
  std::size_t alike = 0;
  const std::size_t count = std::min(most, keypoints.size());
  for (std::size_t k = 0; k < count; ++k) {
    const Point at = keypoints[k * keypoints.size() / count].position;
    Frame a;
    Frame b;
    if (even.estimate(at, a) != Status::ok || odd.estimate(at, b) != Status::ok) continue;
    ++both;
    alike += detail::agree(a, b) ? 1u : 0u;
  }
  return both == 0 ? -1.0f : static_cast<float>(alike) / static_cast<float>(both);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
