// A camera like a Kinect in front of solids: what it measures, with its noise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/io/rgbd_cloud.hpp"
#include "tools/scene/random.hpp"
#include "tools/scene/solids.hpp"

namespace shortshot_bench {
namespace scene_detail {

struct Scene {
  std::vector<Solid> solids;
  Vec3 eye{}, down{}, forward{};  // the camera; its x axis is the world's, so that table rows have one depth
  Vec3 lamp{};
};

struct Sensor {
  std::uint32_t seed;  // of all noise
  std::size_t width, height;
  float noise_scale;  // of the depth; quantization, dropouts and color noise stay
};

// An image of a pinhole camera, row by row: see make_tabletop(). The same scene and sensor give the same bytes on every
// IEEE 754 platform: see the note at the top of solids.hpp.
RgbdCloud record(const Scene& scene, const Sensor& sensor);

}  // namespace scene_detail
}  // namespace shortshot_bench
