#include "paper/datasets/rgbd_frame.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "paper/datasets/image.hpp"
#include "paper/datasets/matrix_file.hpp"
#include "tools/io/input_error.hpp"
#include "tools/labels/dataset_files.hpp"

namespace shortshot_bench::datasets {
namespace {

std::string color_path(const std::string& frame) {
  const std::string jpeg = frame + ".color.jpg";
  return is_file(jpeg) ? jpeg : frame + ".color.png";
}

std::string size_text(std::size_t width, std::size_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

Intrinsics read_intrinsics(const std::string& path) {
  const std::vector<double> m = read_matrix(path, 3, 3, "a camera matrix");
  if (!(m[0] > 0.0 && m[4] > 0.0)) throw InputError::about(path, "expected focal lengths above 0");
  const std::vector<double> expected{m[0], 0.0, m[2], 0.0, m[4], m[5], 0.0, 0.0, 1.0};
  if (m != expected) throw InputError::about(path, "expected the rows fx 0 cx, 0 fy cy, 0 0 1");
  return {m[0], m[4], m[2], m[5]};
}

std::vector<std::string> files_of_frame(const std::string& frame) { return {frame + ".depth.png", color_path(frame)}; }

RgbdCloud read_frame(const std::string& frame, const Intrinsics& camera, double max_depth) {
  constexpr std::array<std::uint16_t, 2> no_measurement{0, 65535};
  const std::vector<std::string> files = files_of_frame(frame);
  const std::string& depth_path = files[0];
  const DepthImage depth = read_depth_image(depth_path);
  ColorImage color = read_color_image(files[1]);
  if (depth.width != color.width || depth.height != color.height) {
    throw InputError::about(depth_path, "expected the color image's " + size_text(color.width, color.height) +
                                            " pixels, found " + size_text(depth.width, depth.height));
  }
  RgbdCloud cloud;
  cloud.width = depth.width;
  cloud.height = depth.height;
  cloud.rgb = std::move(color.rgb);
  cloud.xyz.assign(cloud.rgb.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < depth.depth_mm.size(); ++i) {
    const std::uint16_t raw = depth.depth_mm[i];
    const double z = raw / 1000.0;
    if (raw == no_measurement[0] || raw == no_measurement[1] || z > max_depth) continue;
    cloud.xyz[3 * i] =
        static_cast<float>((static_cast<double>(i % depth.width) - camera.center_x) * z / camera.focal_x);
    cloud.xyz[3 * i + 1] =
        static_cast<float>((static_cast<double>(i / depth.width) - camera.center_y) * z / camera.focal_y);
    cloud.xyz[3 * i + 2] = static_cast<float>(z);
  }
  return cloud;
}

}  // namespace shortshot_bench::datasets
