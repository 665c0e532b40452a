// shortshot/batch/mark_neighbors.hpp: which points of a cloud lie near its key points. Hosted only: allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../cloud/cloud.hpp"
#include "../cloud/keypoint.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../search/search.hpp"
#include "../status.hpp"
#include "extractor.hpp"
#include "growing_workspace.hpp"
#include "plausible.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Marks the points within `radius` of a key point: `marks` has one number for each point of the cloud, 1 there, else
/// 0. The normals of these are all that SHOT and CSHOT of that radius need: estimate_normals() and
/// ImageNormalEstimator::estimate() take such marks. It pays where key points are so few that their neighborhoods leave
/// most of the cloud out.
///
/// `search`     any search over this cloud
/// `keypoints`  as extract() takes them: indices or KeyPoints. Those that cannot be described mark nothing
///
/// Statuses: empty_cloud, bad_view (also: the search is over a cloud of another size), bad_radius, what the search's
/// build() returned, or other_cloud (as in extract()); `marks` is empty then. Allocates the marks (none, if they fit
/// already) and about 30 bytes for each neighbor of the largest neighborhood; one thread.
template <class Search, class Key>
[[nodiscard]] Status mark_neighbors(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                                    Radius radius, std::vector<std::uint8_t>& marks) {
  marks.clear();
  Status status = detail::validate_search(cloud, search);
  if (status == Status::ok) status = validate(radius);
  if (status != Status::ok) return status;
  marks.assign(cloud.size, 0);
  detail::GrowingWorkspace workspace;
  workspace.reserve(1024);
  for (std::size_t row = 0; row < keypoints.size(); ++row) {
    KeyPoint key{};
    Neighborhood n;
    if (!detail::keypoint_at(cloud, keypoints, row, key) || !is_finite(key.position)) continue;
    if (workspace.gather(search, key.position, radius, n) != Status::ok) continue;
    if (!detail::is_of(cloud, key.position, n)) {
      marks.clear();
      return Status::other_cloud;
    }
    for (std::uint32_t i = 0; i < n.size; ++i) marks[n.index[i]] = 1;
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
