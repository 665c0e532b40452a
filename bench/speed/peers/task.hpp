// What everybody gets: the same points, key points and radius.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::peers {

/// Fixed, because PCL builds a tree in each call: the fewer key points, the worse it would look.
inline constexpr std::size_t max_keypoints = 1000;

/// Meters, of the normals of all points.
inline constexpr float normal_radius = 0.01f;

struct Task {
  std::string cloud;                     // the file's name without its folder
  RgbdCloud points;                      // with colors, and none without a position: a list
  RgbdCloud image;                       // the same as it was read: with NaN where nothing was measured
  float radius = 0.0f;                   // meters
  float leaf = 0.0f;                     // meters, of the voxels that key points are sampled in
  std::vector<std::uint32_t> sampled;    // one point of each voxel
  std::vector<std::uint32_t> keypoints;  // max_keypoints of these, evenly spread, or all if there are fewer
  double mean_neighbors = 0.0;           // of a key point, itself included
};

/// Throws std::runtime_error for a cloud that has no colors or no points, and for a radius or leaf that is no length.
Task make_task(const std::string& name, const RgbdCloud& cloud, float radius, float leaf);

}  // namespace shortshot_bench::peers
