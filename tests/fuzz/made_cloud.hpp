// A cloud made of the fuzzer's bytes: lattices, copies, camera images, and coordinates at the ends of float's range.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "bytes.hpp"

namespace fuzz {

struct MadeCloud {
  std::vector<float> xyz;
  std::vector<std::uint8_t> rgb;
  std::size_t width = 0;   // width * height points
  std::size_t height = 0;  // 1: no image
  float radius = 0.0f;

  [[nodiscard]] std::size_t size() const { return xyz.size() / 3; }
};

/// One point of four bytes, where the last is the color as well, or says that the point is a strange one.
inline void add_point(MadeCloud& cloud, Bytes& from, float scale, const float (&middle)[3]) {
  const float offset[3] = {static_cast<float>(from.small()), static_cast<float>(from.small()),
                           static_cast<float>(from.small())};
  const std::uint8_t color = from.byte();
  float p[3];
  for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = middle[axis] + scale * offset[axis];
  switch (color) {
    case 0xFF: p[0] = p[1] = p[2] = std::numeric_limits<float>::quiet_NaN(); break;
    case 0xFE:
      for (float& coordinate : p) coordinate = from.real();
      break;
    case 0xFD:
      if (!cloud.xyz.empty()) p[0] = cloud.xyz[0], p[1] = cloud.xyz[1], p[2] = cloud.xyz[2];
      break;
    case 0xFC: p[from.below(3)] = from.real(); break;
    default: break;
  }
  cloud.xyz.insert(cloud.xyz.end(), p, p + 3);
  cloud.rgb.insert(cloud.rgb.end(),
                   {color, static_cast<std::uint8_t>(7 * color), static_cast<std::uint8_t>(255 - color)});
}

/// At most `most` points.
inline MadeCloud made_cloud(Bytes& from, std::size_t most) {
  constexpr float scales[] = {1e-3f, 1e-3f, 1e-2f, 1.0f, 1e3f, 1e-19f, 1e-22f, 1e16f, 1e18f, 1e36f, 1e-41f};
  MadeCloud cloud;
  const float scale = scales[from.below(sizeof scales / sizeof scales[0])];
  const std::uint8_t reach = from.byte();
  cloud.radius = reach == 255 ? from.real() : scale * static_cast<float>(1 + reach) / 4.0f;
  const std::size_t columns = 1 + from.below(16);
  const bool is_image = from.byte() % 2 == 1;  // of a camera at the origin, which looks along z
  const float depth = 200.0f * scale;
  while (from.left() > 0 && cloud.size() < most) {
    const auto u = static_cast<float>(cloud.size() % columns) - static_cast<float>(columns / 2);
    const auto v = static_cast<float>(cloud.size() / columns);
    const float pixel[3] = {0.05f * depth * u, 0.05f * depth * v, depth};
    const float origin[3] = {};
    add_point(cloud, from, is_image ? 0.1f * scale : scale, is_image ? pixel : origin);
  }
  const bool has_rows = is_image && cloud.size() % columns == 0;
  cloud.width = has_rows ? columns : cloud.size();
  cloud.height = has_rows ? cloud.size() / columns : 1;
  return cloud;
}

}  // namespace fuzz
