// Views of single generated objects on a turntable, cut out of their images: what recognizers are trained with and
// tried on where there is no recording at hand. Five classes of three instances, each of its own shape, size and
// colors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "shortshot/cloud/cloud.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

inline constexpr std::size_t generated_objects = 15;

std::string generated_class(std::size_t object);
std::string generated_instance(std::size_t object);

struct ObjectViewOptions {
  double turn = 0.0;        // from 0 to 4, once around
  double height = 0.36;     // of the camera above the table, meters, which it sees at 35 to 40 degrees
  std::uint32_t seed = 1;   // of all noise
  std::size_t width = 320;  // of the image that the view is cut out of, pixels; 4 : 3
};

struct ObjectView {
  RgbdCloud cloud;          // measured points of the object alone, in the order of the image's pixels
  shortshot::Point center;  // the middle of the object, in the camera's frame
};

// The same bytes on every IEEE 754 platform.
ObjectView make_object_view(std::size_t object, const ObjectViewOptions& options);

}  // namespace shortshot_bench
