// shortshot/recognition/l2_distance.hpp: the distance of two rows of floats, with the same bits on every machine.
#pragma once

#include <cstddef>

#include "../base/simd.hpp"
#include "../config.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The sum of (a[i] - b[i])^2 for two rows of `size` floats. In eight sums, whatever the number of lanes, for the same
/// bits on every machine: sum k has values k, k + 8, ...; then ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)). 0 for a size
/// of 0. No allocation, no error, reentrant; NaN and infinity go through.
[[nodiscard]] inline float squared_l2_distance(const float* a, const float* b, std::size_t size) noexcept {
  namespace simd = extend::simd;
  constexpr std::size_t width = 8;
  static_assert(width % simd::lanes == 0, "whole registers");
  simd::F32 lanes[width / simd::lanes] = {};
  const auto add = [&lanes](const float* x, const float* y) {
    for (std::size_t k = 0; k < width; k += simd::lanes) {
      const simd::F32 difference = simd::load(x + k) - simd::load(y + k);
      lanes[k / simd::lanes] = lanes[k / simd::lanes] + difference * difference;
    }
  };
  const std::size_t whole = size - size % width;
  for (std::size_t i = 0; i < whole; i += width) add(a + i, b + i);
  float rest[2][width] = {};
  for (std::size_t i = whole; i < size; ++i) {
    rest[0][i - whole] = a[i];
    rest[1][i - whole] = b[i];
  }
  add(rest[0], rest[1]);
  float sums[width];
  for (std::size_t k = 0; k < width; k += simd::lanes) simd::store(sums + k, lanes[k / simd::lanes]);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

/// The L2 distance, which is Match::distance for rows of floats: the root of it, exactly rounded.
[[nodiscard]] inline float l2_distance(const float* a, const float* b, std::size_t size) noexcept {
  return extend::simd::sqrt(squared_l2_distance(a, b, size));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
