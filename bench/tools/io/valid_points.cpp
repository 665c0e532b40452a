#include "tools/io/valid_points.hpp"

#include <cmath>

namespace shortshot_bench {

RgbdCloud valid_points(const RgbdCloud& cloud) {
  RgbdCloud valid;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float* p = cloud.xyz.data() + 3 * i;
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) continue;
    valid.xyz.insert(valid.xyz.end(), p, p + 3);
    valid.rgb.insert(valid.rgb.end(), cloud.rgb.data() + 3 * i, cloud.rgb.data() + 3 * (i + 1));
  }
  valid.width = valid.size();
  valid.height = 1;
  return valid;
}

}  // namespace shortshot_bench
