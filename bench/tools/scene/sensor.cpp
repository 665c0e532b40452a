// Must be built with -ffp-contract=off: see the note on determinism in solids.hpp.
#include "tools/scene/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tools/scene/random.hpp"

namespace shortshot_bench {
namespace scene_detail {
namespace {

constexpr double kMaxDepth = 3.0;
constexpr double kMinCosIncidence = 0.2;
constexpr double kDropoutShare = 0.01;
constexpr double kColorSigma = 4.0;       // of 255
constexpr double kEchoSpread = 0.1;       // of its size, to either side
constexpr double kEchoAtOneMeter = 40.0;  // of a color of brightness 1 (of 255)

Vec3 shaded_color(const Scene& scene, const Vec3& ray, const Hit& hit) {
  if (hit.solid == nullptr) return {42.0, 40.0, 46.0};
  const Vec3 point = scene.eye + ray * hit.t;
  const Vec3 in_solid = rotate_to_local(*hit.solid, point - hit.solid->base);
  Vec3 normal = rotate_to_world(*hit.solid, hit.normal);
  if (dot(normal, ray) > 0.0) normal = normal * -1.0;  // the inside of a bowl
  const Vec3 to_lamp = scene.lamp - point;
  double light = std::max(0.0, dot(normal, to_lamp)) / norm(to_lamp);
  const Vec3 start = point + normal * 1e-4;  // off the surface, lest it shade itself
  if (light > 0.0 && cast_ray(scene.solids, start, scene.lamp - start).t < 1.0) light *= 0.3;
  return surface_color(*hit.solid, in_solid, hit.normal) * (0.35 + 0.7 * light);
}

// The measured depth, NaN if there is none. The number of random draws must not depend on the scene.
double measured_depth(Random& random, const Vec3& ray, const Hit& hit, double noise_scale, double disparity_scale) {
  constexpr double kNoMeasurement = std::numeric_limits<double>::quiet_NaN();
  const double deviation = noise_scale * random.normal();
  const bool dropped = random.uniform() < kDropoutShare;
  if (dropped || hit.solid == nullptr) return kNoMeasurement;
  const Vec3 normal = rotate_to_world(*hit.solid, hit.normal);
  if (std::fabs(dot(normal, ray)) < kMinCosIncidence * norm(ray)) return kNoMeasurement;
  const double z = hit.t;  // rays have unit depth
  const double noisy = z + deviation * (0.0012 + 0.0019 * (z - 0.4) * (z - 0.4));
  const double steps = std::floor(8.0 * disparity_scale / noisy + 0.5);  // of 1/8 pixel of disparity
  const double quantized = 8.0 * disparity_scale / steps;
  return steps >= 1.0 && quantized <= kMaxDepth ? quantized : kNoMeasurement;
}

std::uint8_t noisy_channel(Random& random, double value) {
  const double noisy = std::floor(value + kColorSigma * random.normal() + 0.5);
  return static_cast<std::uint8_t>(std::min(255.0, std::max(0.0, noisy)));
}

// The camera's own light as it comes back: less from dark and from slanted surfaces, and with the square of their
// distance; the lamp is filtered out. 0 where nothing was measured.
float measured_echo(Random& random, const Scene& scene, const Vec3& ray, const Hit& hit, bool measured) {
  const double speckle = random.uniform(1.0 - kEchoSpread, 1.0 + kEchoSpread);
  if (!measured) return 0.0f;
  const Vec3 to_point = ray * hit.t;
  const Vec3 in_solid = rotate_to_local(*hit.solid, scene.eye + to_point - hit.solid->base);
  const Vec3 albedo = surface_color(*hit.solid, in_solid, hit.normal);
  const double brightness = 0.25 * albedo.x + 0.5 * albedo.y + 0.25 * albedo.z;
  const double incidence = std::fabs(dot(rotate_to_world(*hit.solid, hit.normal), ray)) / norm(ray);
  const double echo = kEchoAtOneMeter * brightness * incidence / dot(to_point, to_point);
  return static_cast<float>(std::min(65535.0, std::floor(echo * speckle + 0.5)));
}

}  // namespace

RgbdCloud record(const Scene& scene, const Sensor& sensor) {
  // A stream of its own, so that the noise does not depend on how many draws the scene took.
  Random noise(sensor.seed ^ 0x5bd1e995u);
  Random echo_noise(sensor.seed ^ 0x1b873593u);  // and another one: points and colors are as they were without echoes
  const double scale = static_cast<double>(sensor.width) / 640.0;
  const double focal_px = 525.0 * scale, disparity_scale = 575.0 * 0.075 * scale;
  const double center_u = 0.5 * (static_cast<double>(sensor.width) - 1.0);
  const double center_v = 0.5 * (static_cast<double>(sensor.height) - 1.0);

  RgbdCloud cloud;
  cloud.width = sensor.width;
  cloud.height = sensor.height;
  cloud.xyz.reserve(3 * sensor.width * sensor.height);
  cloud.rgb.reserve(3 * sensor.width * sensor.height);
  cloud.intensity.reserve(sensor.width * sensor.height);
  for (std::size_t v = 0; v < sensor.height; ++v) {
    const double y = (static_cast<double>(v) - center_v) / focal_px;
    for (std::size_t u = 0; u < sensor.width; ++u) {
      const double x = (static_cast<double>(u) - center_u) / focal_px;
      const Vec3 ray = scene.forward + scene.down * y + Vec3{x, 0.0, 0.0};
      const Hit hit = cast_ray(scene.solids, scene.eye, ray);
      const double z = measured_depth(noise, ray, hit, static_cast<double>(sensor.noise_scale), disparity_scale);
      // A NaN of its own, since the sign of a computed one differs between processors.
      for (const double coordinate : {z * x, z * y, z})
        cloud.xyz.push_back(z > 0.0 ? static_cast<float>(coordinate) : std::numeric_limits<float>::quiet_NaN());
      const Vec3 color = shaded_color(scene, ray, hit);
      for (const double channel : {color.x, color.y, color.z}) cloud.rgb.push_back(noisy_channel(noise, channel));
      cloud.intensity.push_back(measured_echo(echo_noise, scene, ray, hit, z > 0.0));
    }
  }
  return cloud;
}

}  // namespace scene_detail
}  // namespace shortshot_bench
