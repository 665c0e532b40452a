// A small depth image of a bumpy wall, as an organized cloud.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fixtures.hpp"

namespace unit {

inline constexpr std::size_t image_width = 64;
inline constexpr std::size_t image_height = 48;

struct Camera {
  float focal = 60.0f;
  float center_u = 31.5f;
  float center_v = 23.5f;
  float lateral_noise = 0.0f;  // meters
};

inline TestCloud pinhole_image(std::uint32_t seed, const Camera& camera) {
  Random random(seed);
  TestCloud cloud;
  for (std::size_t v = 0; v < image_height; ++v) {
    for (std::size_t u = 0; u < image_width; ++u) {
      const float sx = (static_cast<float>(u) - camera.center_u) / camera.focal;
      const float sy = (static_cast<float>(v) - camera.center_v) / camera.focal;
      const float bump = (u / 9 + v / 7) % 3 == 0 ? -0.15f : 0.0f;
      const float z = 1.0f + 0.3f * sx * sx - 0.2f * sx * sy + bump + random.between(-0.01f, 0.01f);
      const float dx = random.between(-camera.lateral_noise, camera.lateral_noise);
      const float dy = random.between(-camera.lateral_noise, camera.lateral_noise);
      cloud.add(sx * z + dx, sy * z + dy, z, {random.byte(), random.byte(), static_cast<std::uint8_t>(4 * u)});
    }
  }
  return cloud;
}

}  // namespace unit
