// Small clouds for golden vectors of descriptors with colors: the same bytes on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace shortshot_bench::make_golden {

struct Cloud {
  std::string name;
  std::string note;
  std::vector<float> points;
  std::vector<std::uint8_t> rgb;
  std::vector<std::int32_t> keypoints;
  std::vector<std::string> keypoint_kind;  // one per key point

  std::array<float, 3> point(std::size_t i) const { return {points[3 * i], points[3 * i + 1], points[3 * i + 2]}; }
};

inline constexpr float radius = 0.05f;                     // of all descriptors and frames, in meters
inline constexpr std::array<float, 3> camera = {0, 0, 0};  // to which frames are turned

// A textured relief; two walls that meet in an edge; noise of any color; and what leaves little to describe: one color,
// few neighbors.
std::vector<Cloud> make_clouds();

}  // namespace shortshot_bench::make_golden
