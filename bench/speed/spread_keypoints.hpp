// Which of the sampled points are described where their number is fixed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shortshot_bench {

/// Keeps `count` of them, evenly spread and in their order, or all if there are not more.
inline void keep_spread(std::vector<std::uint32_t>& keypoints, std::size_t count) {
  const std::size_t all = keypoints.size();
  if (all <= count) return;
  for (std::size_t k = 0; k < count; ++k) keypoints[k] = keypoints[(2 * k + 1) * all / (2 * count)];
  keypoints.resize(count);
}

}  // namespace shortshot_bench
