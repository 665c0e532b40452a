#include "tradeoff/paint.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "paper/configuration.hpp"
#include "tools/io/view_of_cloud.hpp"
#include "tools/scene/random.hpp"

namespace shortshot_bench::tradeoff {
namespace {

constexpr float normal_radius = 0.01f;
constexpr double from_everywhere = 0.3;
constexpr double noise = 4.0;

/// The cosine of the angle between the normal and the way to the lamp; 0 on the far side, and without a normal.
double cosine(const shortshot::Point& at, const shortshot::SurfaceNormal& normal, const shortshot::Point& lamp) {
  const double to_lamp[3] = {double{lamp.x} - double{at.x}, double{lamp.y} - double{at.y},
                             double{lamp.z} - double{at.z}};
  const double length = std::hypot(to_lamp[0], to_lamp[1], to_lamp[2]);
  const double dot = to_lamp[0] * double{normal.x} + to_lamp[1] * double{normal.y} + to_lamp[2] * double{normal.z};
  return std::isfinite(dot) && length > 0.0 ? std::max(0.0, dot / length) : 0.0;
}

}  // namespace

RgbdCloud painted(RgbdCloud cloud, const Paint& paint) {
  cloud.rgb.resize(3 * cloud.size());
  const shortshot::CloudView view = view_of_cloud(cloud);
  const shortshot::GridSearch search(view, normal_radius);
  std::vector<shortshot::SurfaceNormal> normals;
  require(shortshot::estimate_normals(view, search, normal_radius, camera_of_cloud(cloud), normals));
  Random random(paint.seed);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double light =
        from_everywhere + (1.0 - from_everywhere) * cosine(shortshot::point(view, i), normals[i], paint.lamp);
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = paint.rgb[k] * light + noise * random.normal();
      cloud.rgb[3 * i + k] = static_cast<std::uint8_t>(std::clamp(std::round(value), 0.0, 255.0));
    }
  }
  return cloud;
}

}  // namespace shortshot_bench::tradeoff
