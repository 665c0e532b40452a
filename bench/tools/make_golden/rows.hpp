// What an oracle, in double precision and apart from the library, makes of a cloud's key points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "clouds.hpp"

namespace shortshot_bench::make_golden {

// One frame and one neighbor count per key point. Where there are too few neighbors for a frame, the axes.
struct Frames {
  std::vector<float> axes;  // nine floats each: x, y, z
  std::vector<std::int32_t> neighbors;
};
Frames make_frames(const Cloud& cloud);

// One of the compact descriptors: a row per key point. NaN, and zeros, where there is nobody to describe.
struct Rows {
  std::string name;
  std::size_t size;                   // values of a row
  std::vector<double> values;         //
  std::vector<std::uint8_t> nibbles;  // (size + 1) / 2 bytes a row
};
std::vector<Rows> make_rows(const Cloud& cloud, const std::vector<float>& frames);

}  // namespace shortshot_bench::make_golden
