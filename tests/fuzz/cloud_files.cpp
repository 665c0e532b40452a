// PCD and PLY files, whatever is in them: a consistent cloud, or an error that names the file.
#include <exception>
#include <string>

#include "bytes.hpp"
#include "tools/io/input_error.hpp"
#include "tools/io/read_cloud.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using fuzz::require;
  try {
    const shortshot_bench::RgbdCloud cloud =
        shortshot_bench::read_cloud("input", std::string(reinterpret_cast<const char*>(data), size));
    require(cloud.xyz.size() == 3 * cloud.width * cloud.height, "three coordinates a point");
    require(cloud.rgb.empty() || cloud.rgb.size() == cloud.xyz.size(), "three color bytes a point, or none");
    require(cloud.intensity.empty() || cloud.intensity.size() == cloud.size(), "an intensity a point, or none");
    require(cloud.size() <= 100 * size, "points that the bytes hold");
  } catch (const shortshot_bench::InputError& error) {
    require(std::string(error.what()).rfind("input:", 0) == 0, "the message names the file");
  }
  return 0;
}
