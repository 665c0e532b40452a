#include "paper/datasets/rgbd_frame.hpp"

#include <string>
#include <vector>

#include "tools/input/back_project.hpp"
#include "tools/io/require_file.hpp"

namespace shortshot_bench::datasets {
namespace {

std::string color_path(const std::string& frame) {
  const std::string jpeg = frame + ".color.jpg";
  return is_file(jpeg) ? jpeg : frame + ".color.png";
}

}  // namespace

std::vector<std::string> files_of_frame(const std::string& frame) { return {frame + ".depth.png", color_path(frame)}; }

RgbdCloud read_frame(const std::string& frame, const PinholeCamera& camera, double max_depth) {
  constexpr double millimeter = 0.001;
  const std::vector<std::string> files = files_of_frame(frame);
  RgbdCloud cloud = back_project(read_depth_image(files[0]), camera, millimeter, max_depth);
  add_colors(cloud, read_color_image(files[1]), files[0]);
  return cloud;
}

}  // namespace shortshot_bench::datasets
