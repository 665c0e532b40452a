// Color and depth images from files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace shortshot_bench {

struct ColorImage {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint8_t> rgb;  // 3 per pixel, row by row
};

struct DepthImage {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint16_t> counts;  // 1 per pixel, row by row, as the file has it
};

/// JPEG or PNG; gray becomes r = g = b. Both throw InputError for what is no such image, and above 2^26 pixels, so that
/// a broken header cannot ask for all memory.
ColorImage read_color_image(const std::string& path);

/// PNG, 16 bits, one channel: any other would be scaled on reading, and is refused.
DepthImage read_depth_image(const std::string& path);

}  // namespace shortshot_bench
