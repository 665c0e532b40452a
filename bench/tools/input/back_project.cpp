#include "tools/input/back_project.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "tools/io/input_error.hpp"

namespace shortshot_bench {
namespace {

std::string size_text(std::size_t width, std::size_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

RgbdCloud back_project(const DepthImage& depth, const PinholeCamera& camera, double unit, double max_depth) {
  RgbdCloud cloud;
  cloud.width = depth.width;
  cloud.height = depth.height;
  cloud.xyz.assign(3 * depth.counts.size(), std::numeric_limits<float>::quiet_NaN());
  const double counts_in_a_meter = 1.0 / unit;  // divided by, millimeters become the nearest double
  for (std::size_t i = 0; i < depth.counts.size(); ++i) {
    const std::uint16_t raw = depth.counts[i];
    const double z = raw / counts_in_a_meter;
    if (raw == 0 || raw == 65535 || z > max_depth) continue;
    cloud.xyz[3 * i] =
        static_cast<float>((static_cast<double>(i % depth.width) - camera.center_x) * z / camera.focal_x);
    cloud.xyz[3 * i + 1] =
        static_cast<float>((static_cast<double>(i / depth.width) - camera.center_y) * z / camera.focal_y);
    cloud.xyz[3 * i + 2] = static_cast<float>(z);
  }
  return cloud;
}

void add_colors(RgbdCloud& cloud, ColorImage color, const std::string& depth_path) {
  if (cloud.width != color.width || cloud.height != color.height) {
    throw InputError::about(depth_path, "expected the color image's " + size_text(color.width, color.height) +
                                            " pixels, found " + size_text(cloud.width, cloud.height));
  }
  cloud.rgb = std::move(color.rgb);
}

}  // namespace shortshot_bench
