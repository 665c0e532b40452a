#include "tools/depth_image/read_input.hpp"

#include <array>
#include <fstream>
#include <limits>

#include "tools/depth_image/back_project.hpp"
#include "tools/io/folder_name.hpp"
#include "tools/io/input_error.hpp"
#include "tools/io/read_cloud.hpp"
#include "tools/io/require_file.hpp"

namespace shortshot_bench {
namespace {

bool is_png(const std::string& path) {
  constexpr std::array<char, 4> signature{'\x89', 'P', 'N', 'G'};
  std::array<char, 4> begin{};
  std::ifstream file(path, std::ios::binary);
  return file.read(begin.data(), begin.size()) && begin == signature;
}

/// Where a color image follows a depth image; npos in the name of a file.
std::size_t comma_in(const std::string& input) { return is_file(input) ? std::string::npos : input.find(','); }

}  // namespace

std::string name_of_input(const std::string& input) { return folder_name(input.substr(0, comma_in(input))); }

RgbdCloud read_input(const std::string& input, const DepthCamera& camera) {
  const std::size_t comma = comma_in(input);
  const std::string depth = input.substr(0, comma);
  const bool has_color = comma != std::string::npos;
  if (!has_color && !is_png(depth)) return read_cloud(input);
  require_file(depth, "a depth image");
  if (camera.intrinsics.empty()) {
    throw InputError::about(depth, "a depth image needs --camera FX,FY,CX,CY, its intrinsics in pixels");
  }
  constexpr double everything = std::numeric_limits<double>::infinity();
  RgbdCloud cloud =
      back_project(read_depth_image(depth), parse_pinhole_camera(camera.intrinsics), camera.unit, everything);
  if (has_color) add_colors(cloud, read_color_image(input.substr(comma + 1)), depth);
  return cloud;
}

}  // namespace shortshot_bench
