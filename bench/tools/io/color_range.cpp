#include "color_range.hpp"

#include <algorithm>
#include <cmath>

namespace shortshot_bench {

double full_brightness(const ScalarType& type, double largest) {
  if (type.size_bytes == 1) return 255;
  if (type.kind == ScalarKind::floating && largest <= 2 * 1.0) return 1;
  for (const double full : {255.0, 65535.0}) {
    if (largest <= 2 * full) return full;
  }
  return 0;
}

std::uint8_t to_color_byte(double value, double full) {
  value *= 255 / full;
  if (!(value > 0)) return 0;  // NaN too
  return static_cast<std::uint8_t>(std::lround(std::min(value, 255.0)));
}

}  // namespace shortshot_bench
