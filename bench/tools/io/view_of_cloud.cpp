#include "view_of_cloud.hpp"

#include <algorithm>
#include <limits>

#include "shortshot/cloud/read.hpp"

namespace shortshot_bench {
shortshot::CloudView view_of_cloud(const RgbdCloud& cloud) {
  shortshot::CloudView view = cloud.has_colors()
                                  ? shortshot::view_xyz_rgb(cloud.xyz.data(), cloud.rgb.data(), cloud.size())
                                  : shortshot::view_xyz(cloud.xyz.data(), cloud.size());
  if (cloud.has_intensities()) view = shortshot::with_intensities(view, cloud.intensity.data());
  return shortshot::organized(view, cloud.width, cloud.height);
}

Extent extent_of(const RgbdCloud& cloud) {
  constexpr float most = std::numeric_limits<float>::max();
  Extent extent{{most, most, most}, {-most, -most, -most}};
  const shortshot::CloudView view = view_of_cloud(cloud);
  for (std::size_t i = 0; i < view.size; ++i) {
    if (!shortshot::is_finite(shortshot::point(view, i))) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent.low[axis] = std::min(extent.low[axis], cloud.xyz[3 * i + axis]);
      extent.high[axis] = std::max(extent.high[axis], cloud.xyz[3 * i + axis]);
    }
  }
  return extent;
}

shortshot::Viewpoint camera_of_cloud(const RgbdCloud& cloud) {
  const auto& camera = cloud.viewpoint;
  if (!cloud.is_whole) return shortshot::Viewpoint::towards({camera[0], camera[1], camera[2]});
  const Extent extent = extent_of(cloud);
  const auto middle = [&](int axis) { return 0.5f * extent.low[axis] + 0.5f * extent.high[axis]; };
  return shortshot::Viewpoint::away_from({middle(0), middle(1), middle(2)});
}

bool surrounds_its_viewpoint(const RgbdCloud& cloud) {
  const Extent extent = extent_of(cloud);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float at = cloud.viewpoint[axis];
    if (!(extent.low[axis] < at && at < extent.high[axis])) return false;
  }
  return true;
}

std::size_t valid_points_of(const RgbdCloud& cloud) {
  const shortshot::CloudView view = view_of_cloud(cloud);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < view.size; ++i) valid += shortshot::is_finite(shortshot::point(view, i)) ? 1 : 0;
  return valid;
}

}  // namespace shortshot_bench
