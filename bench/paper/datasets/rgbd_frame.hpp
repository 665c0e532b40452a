// Frames of a depth camera: a color image and a depth image of one size.
#pragma once

#include <string>
#include <vector>

#include "tools/input/pinhole_camera.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::datasets {

/// The images that read_frame() will read.
std::vector<std::string> files_of_frame(const std::string& frame);

/// The frame's pixels in camera coordinates (x right, y down, z forward, meters), organized; NaN where the depth is 0
/// or 65535 (no measurement) or beyond `max_depth` meters. Reads FRAME.depth.png (16 bits, millimeters) and
/// FRAME.color.jpg or, if there is none, FRAME.color.png. Both images are taken for the same camera's. Throws
/// InputError.
RgbdCloud read_frame(const std::string& frame, const PinholeCamera& camera, double max_depth);

}  // namespace shortshot_bench::datasets
