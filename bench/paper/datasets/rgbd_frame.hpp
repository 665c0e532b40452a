// Frames of a depth camera: a color image and a depth image of one size.
#pragma once

#include <string>
#include <vector>

#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::datasets {

/// A pinhole camera, in pixels; the pixel in the corner has its center at (0, 0).
struct Intrinsics {
  double focal_x = 0.0;
  double focal_y = 0.0;
  double center_x = 0.0;
  double center_y = 0.0;
};

/// From a text file with the rows fx 0 cx, 0 fy cy, 0 0 1. Throws InputError for any other matrix.
Intrinsics read_intrinsics(const std::string& path);

/// The images that read_frame() will read.
std::vector<std::string> files_of_frame(const std::string& frame);

/// The frame's pixels in camera coordinates (x right, y down, z forward, meters), organized; NaN where the depth is 0
/// or 65535 (no measurement) or beyond `max_depth` meters. Reads FRAME.depth.png (16 bits, millimeters) and
/// FRAME.color.jpg or, if there is none, FRAME.color.png. Both images are taken for the same camera's. Throws
/// InputError.
RgbdCloud read_frame(const std::string& frame, const Intrinsics& camera, double max_depth);

}  // namespace shortshot_bench::datasets
