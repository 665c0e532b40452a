#include "tools/input/read_input.hpp"

#include <array>
#include <fstream>
#include <limits>

#include "tools/input/back_project.hpp"
#include "tools/io/folder_name.hpp"
#include "tools/io/input_error.hpp"
#include "tools/io/read_cloud.hpp"
#include "tools/io/repeated_points.hpp"
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

RgbdCloud read_images(const std::string& input, std::size_t comma, const InputOptions& options) {
  const std::string depth = input.substr(0, comma);
  require_file(depth, "a depth image");
  if (options.intrinsics.empty()) {
    throw InputError::about(depth, "a depth image needs --camera FX,FY,CX,CY, its intrinsics in pixels");
  }
  constexpr double everything = std::numeric_limits<double>::infinity();
  RgbdCloud cloud =
      back_project(read_depth_image(depth), parse_pinhole_camera(options.intrinsics), options.unit, everything);
  if (comma != std::string::npos) add_colors(cloud, read_color_image(input.substr(comma + 1)), depth);
  return cloud;
}

}  // namespace

std::string name_of_input(const std::string& input) { return folder_name(input.substr(0, comma_in(input))); }

RgbdCloud read_input(const std::string& input, const InputOptions& options) {
  const std::size_t comma = comma_in(input);
  const bool is_image = comma != std::string::npos || is_png(input);
  RgbdCloud cloud = is_image ? read_images(input, comma, options) : read_cloud(input);
  if (options.drop_zeros) drop_zeros(cloud);
  return cloud;
}

}  // namespace shortshot_bench
