#include "view_of_cloud.hpp"

#include "shortshot/cloud/read.hpp"

namespace shortshot_bench {

shortshot::CloudView view_of_cloud(const RgbdCloud& cloud) {
  shortshot::CloudView view = cloud.has_colors()
                                  ? shortshot::view_xyz_rgb(cloud.xyz.data(), cloud.rgb.data(), cloud.size())
                                  : shortshot::view_xyz(cloud.xyz.data(), cloud.size());
  if (cloud.has_intensities()) view = shortshot::with_intensities(view, cloud.intensity.data());
  return shortshot::organized(view, cloud.width, cloud.height);
}

shortshot::Viewpoint camera_of_cloud(const RgbdCloud& cloud) {
  return shortshot::Viewpoint::towards({cloud.viewpoint[0], cloud.viewpoint[1], cloud.viewpoint[2]});
}

std::size_t valid_points_of(const RgbdCloud& cloud) {
  const shortshot::CloudView view = view_of_cloud(cloud);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < view.size; ++i) valid += shortshot::is_finite(shortshot::point(view, i)) ? 1 : 0;
  return valid;
}

}  // namespace shortshot_bench
