// A seeded, ray-cast RGB-D view of a tabletop with Kinect-like noise, and the echoes of a time-of-flight camera: input
// for the demo, benchmarks and tests when there is no recording at hand.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

struct TabletopOptions {
  std::uint32_t seed = 1;  // draws the objects, their places, the camera pose and all noise
  std::size_t width = 640, height = 480;
  float noise_scale = 1.0f;  // scales the depth noise only; quantization, dropouts and color noise stay
  double turn = 0.0;         // of table, room and lamp around the place that the camera looks at: 0 to 4 is once around
};

// An organized cloud (row-major, width x height) in the camera frame: x right, y down, z forward, the camera
// at the origin, a pinhole with f = 525 * width / 640 and its center at ((width - 1) / 2, (height - 1) / 2).
// Pixels without a measurement have NaN coordinates and intensity 0 but still a color. Intensities are whole numbers
// from 0 to 65535, as such cameras give them: how much of its own light comes back. The scene depends on the seed
// alone, so two sizes show the same objects, and another turn another view of them, with noise of its own.
//
// The same options give the same bytes on every IEEE 754 platform: see the note at the top of
// solids.hpp.
RgbdCloud make_tabletop(const TabletopOptions& options = {});

}  // namespace shortshot_bench
