// How far the normals of a depth image by estimate_image_normals() are from the exact ones within the same radius.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

struct NormalErrors {
  static constexpr std::array<std::size_t, 4> pixels{2, 4, 8, 16};      // ends of ranges of distances, but the last one
  static constexpr std::array<float, 3> meters{0.8f, 1.2f, 1.6f};       // the same of depths
  std::vector<double> all;                                              // degrees, of points that have both normals
  std::array<std::vector<double>, pixels.size() + 1> by_edge_distance;  // of the pixel from the next edge
  std::array<std::vector<double>, meters.size() + 1> by_depth;          // of those whose window has no edge
  std::size_t exact = 0;                                                // points with an exact normal
  std::size_t missing = 0;                                              // those of them that have no other
};

// Adds an organized cloud's. Throws std::runtime_error, with a status's message, where one of the two has no normals.
void add_errors(const RgbdCloud& cloud, float radius, NormalErrors& errors);

// "median / 90 %" of each range in a row of a Markdown table; empty for ranges of fewer than 200 points.
std::string heading_of_errors();
std::string row_of_errors(const std::string& name, float radius, const NormalErrors& errors);

}  // namespace shortshot_bench
