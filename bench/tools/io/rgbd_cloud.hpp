// A point cloud as the tools use it: positions, and colors and intensities when the sensor gave them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace shortshot_bench {

struct RgbdCloud {
  std::vector<float> xyz;                   // 3 per point: x y z in meters; NaN = no measurement
  std::vector<std::uint8_t> rgb;            // 3 per point: r g b; empty = the cloud has no color
  std::vector<float> intensity;             // 1 per point, in the sensor's unit; empty = the cloud has none
  std::size_t width = 0;                    // points in a row, or all points of an unorganized cloud
  std::size_t height = 0;                   // rows; above 1 = organized like the camera image, row by row
  std::array<float, 3> viewpoint{0, 0, 0};  // the camera's position, meters

  std::size_t size() const { return xyz.size() / 3; }
  bool has_colors() const { return !rgb.empty(); }
  bool has_intensities() const { return !intensity.empty(); }
  bool is_organized() const { return height > 1; }
};

}  // namespace shortshot_bench
