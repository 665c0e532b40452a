#include "averaged_cloud.hpp"

#include <cstddef>
#include <vector>

#include "require_ok.hpp"
#include "shortshot/batch/keypoints.hpp"
#include "shortshot/cloud/read.hpp"
#include "shortshot/descriptor/axis.hpp"
#include "view_of_cloud.hpp"

namespace shortshot_bench {

RgbdCloud averaged(const RgbdCloud& cloud, float voxel) {
  std::vector<shortshot::KeyPoint> means;
  require(shortshot::sample_centroids(view_of_cloud(cloud), voxel, means));
  RgbdCloud result;
  for (const shortshot::KeyPoint& mean : means) {
    result.xyz.insert(result.xyz.end(), {mean.position.x, mean.position.y, mean.position.z});
    if (cloud.has_colors()) result.rgb.insert(result.rgb.end(), {mean.color.r, mean.color.g, mean.color.b});
  }
  result.width = result.size();
  result.height = 1;
  result.viewpoint = cloud.viewpoint;
  return result;
}

shortshot::Point mean_point(const shortshot::CloudView& cloud) {
  double sum[3] = {};
  double count = 0.0;
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const shortshot::Point p = shortshot::point(cloud, i);
    if (!shortshot::is_finite(p)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum[axis] += static_cast<double>(shortshot::extend::coordinate(p, axis));
    count += 1.0;
  }
  const auto mean = [&](int axis) { return static_cast<float>(sum[axis] / count); };
  return {mean(0), mean(1), mean(2)};
}

}  // namespace shortshot_bench
