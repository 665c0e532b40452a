// Depth images as clouds.
#pragma once

#include "tools/input/image.hpp"
#include "tools/input/pinhole_camera.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

/// The pixels in camera coordinates (x right, y down, z forward, meters), organized; NaN where the depth is 0 or 65535
/// (no measurement) or beyond `max_depth` meters. `unit` meters are one count. No colors.
RgbdCloud back_project(const DepthImage& depth, const PinholeCamera& camera, double unit, double max_depth);

/// With the color image's colors, which must be as large as the cloud: it is taken for the same camera's. Throws
/// InputError, which names the depth image's file, for another size.
void add_colors(RgbdCloud& cloud, ColorImage color, const std::string& depth_path);

}  // namespace shortshot_bench
