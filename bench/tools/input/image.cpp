#include "tools/input/image.hpp"

#include <memory>

#include "tools/io/require_file.hpp"

#define STB_IMAGE_IMPLEMENTATION  // here and nowhere else
#include <stb/stb_image.h>

namespace shortshot_bench {
namespace {

struct Header {
  int width = 0;
  int height = 0;
  int channels = 0;

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

struct FreeImage {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

InputError broken(const std::string& path, const std::string& what) {
  return InputError::about(path, "expected " + what + ", found: " + stbi_failure_reason());
}

Header read_header(const std::string& path, const std::string& what) {
  constexpr std::size_t most_pixels = std::size_t{1} << 26;
  require_file(path, what);
  Header header;
  if (stbi_info(path.c_str(), &header.width, &header.height, &header.channels) == 0) throw broken(path, what);
  if (header.pixels() > most_pixels) {
    throw InputError::about(path, "expected at most 2^26 pixels, found " + std::to_string(header.pixels()));
  }
  return header;
}

}  // namespace

ColorImage read_color_image(const std::string& path) {
  const std::string what = "a color image";
  Header header = read_header(path, what);
  const std::unique_ptr<stbi_uc, FreeImage> pixels(
      stbi_load(path.c_str(), &header.width, &header.height, &header.channels, 3));
  if (pixels == nullptr) throw broken(path, what);
  return {static_cast<std::size_t>(header.width), static_cast<std::size_t>(header.height),
          std::vector<std::uint8_t>(pixels.get(), pixels.get() + 3 * header.pixels())};
}

DepthImage read_depth_image(const std::string& path) {
  const std::string what = "a depth image";
  Header header = read_header(path, what);
  if (header.channels != 1 || stbi_is_16_bit(path.c_str()) == 0) {
    throw InputError::about(path, "expected a depth image of one channel of 16 bits, found another image");
  }
  const std::unique_ptr<stbi_us, FreeImage> pixels(
      stbi_load_16(path.c_str(), &header.width, &header.height, &header.channels, 1));
  if (pixels == nullptr) throw broken(path, what);
  return {static_cast<std::size_t>(header.width), static_cast<std::size_t>(header.height),
          std::vector<std::uint16_t>(pixels.get(), pixels.get() + header.pixels())};
}

}  // namespace shortshot_bench
