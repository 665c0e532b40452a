// A point cloud as the tools use it: positions, and colors, intensities and normals when the file or sensor gave them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace shortshot_bench {

struct RgbdCloud {
  std::vector<float> xyz;                   // 3 per point: x y z in meters, from the origin; NaN = no measurement
  std::vector<std::uint8_t> rgb;            // 3 per point: r g b; empty = the cloud has no color
  std::vector<float> intensity;             // 1 per point, in the sensor's unit; empty = the cloud has none
  std::vector<float> normals;               // 3 per point, of length 1; NaN = that point has none; empty = no point has
  std::size_t width = 0;                    // points in a row, or all points of an unorganized cloud
  std::size_t height = 0;                   // rows; above 1 = organized like the camera image, row by row
  std::array<float, 3> viewpoint{0, 0, 0};  // the camera's position, meters, from the origin
  bool is_whole = false;  // shows an object from all sides, as no camera sees it: the viewpoint means nothing
  std::array<double, 3> origin{0, 0, 0};  // what a reader subtracted where floats are too coarse for the file's numbers
  std::vector<std::string> notes;         // one sentence each, for people: what was read how, and what was not used

  std::size_t size() const { return xyz.size() / 3; }
  bool has_colors() const { return !rgb.empty(); }
  bool has_intensities() const { return !intensity.empty(); }
  bool has_normals() const { return !normals.empty(); }
  bool is_organized() const { return height > 1; }
  bool is_shifted() const { return origin[0] != 0 || origin[1] != 0 || origin[2] != 0; }
};

}  // namespace shortshot_bench
