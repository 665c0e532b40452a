// Means of points: of those in each voxel, and of all.
#pragma once

#include "rgbd_cloud.hpp"
#include "shortshot/cloud/cloud.hpp"

namespace shortshot_bench {

/// One point in each voxel of this size, with the mean color; unorganized. Throws std::runtime_error if there is none.
RgbdCloud averaged(const RgbdCloud& cloud, float voxel);

/// The mean of all valid points, of which there must be one.
shortshot::Point mean_point(const shortshot::CloudView& cloud);

}  // namespace shortshot_bench
