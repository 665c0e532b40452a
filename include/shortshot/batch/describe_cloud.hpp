// shortshot/batch/describe_cloud.hpp: a whole cloud in one call: key points, search, frames, descriptors. Hosted only:
// allocates, starts threads.
#pragma once

#include <vector>

#include "../base/math.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/keypoint.hpp"
#include "../config.hpp"
#include "../frame/viewpoint.hpp"
#include "../kernel/support.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "extractor.hpp"
#include "features.hpp"
#include "grid_search.hpp"
#include "keep_best_frames.hpp"
#include "keypoints.hpp"
#include "suggest.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// How describe_cloud() describes. Defaults for objects on a table, seen by a depth camera at one meter: they are not
/// taken from the cloud, so that two clouds are described alike. A radius of 0 asks for what suggest() says of this
/// one.
struct CloudOptions {
  float radius = 0.04f;       ///< of the support, in the cloud's unit: meters; 0: suggested
  float leaf = 0.0f;          ///< one key point in each occupied voxel of that size, its points' centroid; 0: half the
                              ///< radius
  float frame_radius = 0.0f;  ///< of the local reference frame; 0: the support's
  float best_frames = 1.0f;   ///< above 0, at most 1: share of the key points that is kept, those with surest frames
  Viewpoint viewpoint;        ///< turns the frames' z; Viewpoint::towards({0, 0, 0}): a camera at the origin
  unsigned threads = 1;       ///< that share the work
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What the options say of supports of this radius.
[[nodiscard]] inline Support support_of(const CloudOptions& options, float radius) noexcept {
  Support support = radius;
  if (options.frame_radius != 0.0f) support.frame_radius = Radius(options.frame_radius);
  support.viewpoint = options.viewpoint;
  return support;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Describes a whole cloud: key points by sample_centroids(), neighbors by a GridSearch, rows by an Extractor. `out`
/// has the key points, too.
///
/// Statuses: empty_cloud, bad_view, bad_leaf, bad_radius, bad_viewpoint, missing_colors, missing_normals (for SHOT and
/// CSHOT: estimate_normals() first), missing_intensities, coarse_coordinates, bad_option (best_frames); `out` is empty,
/// or all its rows have that status. Each row has a status of its own. Allocates what those three do, anew in every
/// call; for cloud after cloud take them one by one.
template <class D>
[[nodiscard]] Status describe_cloud(const CloudView& cloud, const CloudOptions& options, Features<D>& out) {
  detail::clear_rows(out, 0, Status::ok);
  float radius = options.radius;
  if (radius == 0.0f) {
    const Suggestion suggested = suggest(cloud, options.viewpoint);
    if (suggested.status != Status::ok) return suggested.status;
    radius = suggested.radius;
  }
  const Support support = detail::support_of(options, radius);
  std::vector<KeyPoint> keypoints;
  Status status = validate(support.radius);
  const float leaf = options.leaf == 0.0f ? 0.5f * radius : options.leaf;
  if (status == Status::ok) status = sample_centroids(cloud, leaf, keypoints);
  if (status != Status::ok) return status;
  const GridSearch search(cloud, radius);
  status = Extractor<D>().extract(cloud, search, keypoints, support, out, options.threads);
  return status == Status::ok ? keep_best_frames(out, options.best_frames) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
