// shortshot/color/lab_lanes.hpp: sRGB bytes -> CIELAB, a register of colors at a time, by a table of roots.
#ifndef SHORTSHOT_COLOR_LAB_LANES_HPP
#define SHORTSHOT_COLOR_LAB_LANES_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "lab.hpp"
#include "srgb.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// CIELAB of linear RGB, as lab_by() gives it; roots[step] is a root.
template <class Rule>
[[nodiscard, gnu::always_inline]] inline LabLanes lab_of(const simd::F32 (&linear)[3], const float* roots) noexcept {
  simd::F32 f[3];
  unroll<3>([&](auto ratio) __attribute__((always_inline)) {
    const float(&row)[3] = xyz_of_rgb[ratio];
    const simd::F32 sum = linear[0] * simd::all(row[0]) + linear[1] * simd::all(row[1]) + linear[2] * simd::all(row[2]);
    std::int32_t steps[simd::lanes];
    simd::store(steps, truncate_to_int(sum / simd::all(white_xyz[ratio]) * simd::all(4000.0f)));
    f[ratio] = simd::from_lanes([&](int k) { return roots[steps[k]]; });
  });
  LabLanes lab{simd::all(116.0f) * f[1] - simd::all(16.0f), simd::all(500.0f) * (f[0] - f[1]),
               simd::all(200.0f) * (f[1] - f[2])};
  if constexpr (Rule::leaves_gamut) {
    lab.a = simd::max(simd::min(lab.a, simd::all(120.0f)), simd::all(-120.0f));
    lab.b = simd::max(simd::min(lab.b, simd::all(120.0f)), simd::all(-120.0f));
  }
  return lab;
}

/// Colors [begin, end) of a cloud; `lab` is a Lab for each of its points, as floats.
template <class Rule>
inline void convert_range_by(const float* roots, const CloudView& cloud, std::size_t begin, std::size_t end,
                             float* lab) noexcept {
  const std::size_t stride = cloud.colors.stride_bytes;
  const std::size_t first = begin * stride;
  const unsigned char* r = cloud.colors.r + first;
  const unsigned char* g = cloud.colors.g + first;
  const unsigned char* b = cloud.colors.b + first;
  lab += 3 * begin;
  std::size_t i = begin;
  for (; i + simd::lanes <= end; i += simd::lanes) {
    const auto linear = [stride](const unsigned char*& at) __attribute__((always_inline)) {
      const unsigned char* byte = at;
      float values[simd::lanes];
      unroll<static_cast<int>(simd::lanes)>([&](auto k) __attribute__((always_inline)) {
        values[k] = linear_of_srgb(*byte);
        byte += stride;
      });
      at = byte;
      return simd::load(values);
    };
    const simd::F32 rgb[3] = {linear(r), linear(g), linear(b)};
    const LabLanes colors = lab_of<Rule>(rgb, roots);
    float of[3][simd::lanes];
    simd::store(of[0], colors.L);
    simd::store(of[1], colors.a);
    simd::store(of[2], colors.b);
    unroll<static_cast<int>(simd::lanes)>([&](auto k) __attribute__((always_inline)) {
      lab[3 * k] = of[0][k];
      lab[3 * k + 1] = of[1][k];
      lab[3 * k + 2] = of[2][k];
    });
    lab += 3 * simd::lanes;
  }
  for (; i < end; ++i, lab += 3) {
    Lab color;
    lab_by<Rule>([roots](int step) { return roots[step]; }, extend::read(cloud.colors, i), color);
    lab[0] = color.L;
    lab[1] = color.a;
    lab[2] = color.b;
  }
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_COLOR_LAB_LANES_HPP
