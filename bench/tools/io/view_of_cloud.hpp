// A cloud of the tools as the library sees it.
#pragma once

#include <cstddef>

#include "rgbd_cloud.hpp"
#include "shortshot/cloud/cloud.hpp"
#include "shortshot/frame/viewpoint.hpp"

namespace shortshot_bench {

/// Borrows the cloud, whose rows and columns it keeps.
shortshot::CloudView view_of_cloud(const RgbdCloud& cloud);

/// Where the camera was.
shortshot::Viewpoint camera_of_cloud(const RgbdCloud& cloud);

/// Points that are finite.
std::size_t valid_points_of(const RgbdCloud& cloud);

}  // namespace shortshot_bench
