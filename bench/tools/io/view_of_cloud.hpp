// A cloud of the tools as the library sees it.
#pragma once

#include <cstddef>

#include "rgbd_cloud.hpp"
#include "shortshot/cloud/cloud.hpp"
#include "shortshot/frame/viewpoint.hpp"

namespace shortshot_bench {

/// The box around a cloud; low is above high if no point is finite.
struct Extent {
  float low[3], high[3];
};

/// Of the points that are finite.
Extent extent_of(const RgbdCloud& cloud);

/// Borrows the cloud, whose rows and columns it keeps.
shortshot::CloudView view_of_cloud(const RgbdCloud& cloud);

/// Towards the camera; of a whole object, away from the middle of its extent. Frames turned so are the same in a view
/// of an object and in the whole of it.
shortshot::Viewpoint camera_of_cloud(const RgbdCloud& cloud);

/// Whether the viewpoint lies within the cloud's extent: it is a room's, or the cloud is a whole object.
bool surrounds_its_viewpoint(const RgbdCloud& cloud);

/// Points that are finite.
std::size_t valid_points_of(const RgbdCloud& cloud);

}  // namespace shortshot_bench
