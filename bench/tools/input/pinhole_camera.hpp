// What turns the pixels of a depth image into points.
#pragma once

#include <string>

namespace shortshot_bench {

/// In pixels; the pixel in the corner has its center at (0, 0).
struct PinholeCamera {
  double focal_x = 0.0;
  double focal_y = 0.0;
  double center_x = 0.0;
  double center_y = 0.0;
};

/// From a text file with the rows fx 0 cx, 0 fy cy, 0 0 1. Throws InputError for any other matrix.
PinholeCamera read_pinhole_camera(const std::string& path);

/// From "FX,FY,CX,CY", or a file as above. Throws InputError.
PinholeCamera parse_pinhole_camera(const std::string& text);

}  // namespace shortshot_bench
