#include "view_of_cloud.hpp"

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

}  // namespace shortshot_bench
