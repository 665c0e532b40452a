#include "tools/input/read_input.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>

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

/// Where a color image follows a depth image, whose name may have commas, too; npos in the name of a file.
std::size_t comma_in(const std::string& input) {
  const std::size_t first = is_file(input) ? std::string::npos : input.find(',');
  for (std::size_t comma = first; comma != std::string::npos; comma = input.find(',', comma + 1)) {
    if (is_file(input.substr(0, comma))) return comma;
  }
  return first;
}

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

void print_notes(const RgbdCloud& cloud) {
  for (const std::string& note : cloud.notes) std::printf("note: %s\n", note.c_str());
}

std::string name_of_input(const std::string& input) { return folder_name(input.substr(0, comma_in(input))); }

void keep_input(const std::string& input, const std::string& output) {
  const std::size_t comma = comma_in(input);
  const std::string color = comma == std::string::npos ? input : input.substr(comma + 1);
  for (const std::string& file : {input.substr(0, comma), color}) {
    std::error_code not_there;
    if (std::filesystem::equivalent(file, output, not_there)) {
      throw InputError::about(output, "writing this file would destroy what is read");
    }
  }
}

RgbdCloud read_input(const std::string& input, const InputOptions& options) {
  const std::size_t comma = comma_in(input);
  const bool is_image = comma != std::string::npos || is_png(input);
  RgbdCloud cloud = is_image ? read_images(input, comma, options) : read_cloud(input);
  if (options.drop_zeros) drop_zeros(cloud);
  return cloud;
}

}  // namespace shortshot_bench
