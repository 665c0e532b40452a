// Must be built with -ffp-contract=off: see the note on determinism in solids.hpp.
#include "firmware/small_sensor/depth_sensor.hpp"

#include <cmath>

namespace shortshot_bench::firmware {
namespace {

constexpr int rays = 3;  // of a zone, along either axis
constexpr double noise_share = 0.01;
constexpr double missing_share = 0.02;
constexpr double farthest = 0.7;  // what is behind is none of the thing

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3 unit(const Vec3& v) { return v * (1.0 / norm(v)); }

}  // namespace

View draw_view(Random& random, std::size_t thing_class, double distance) {
  View view;
  view.thing = draw_thing(random, thing_class);
  const bool is_hand = thing_class < hand_count;
  const double aside = random.uniform(-0.35, 0.35);
  const double up = is_hand ? random.uniform(-0.35, 0.35) : random.uniform(0.27, 0.84);
  const double roll = random.uniform(-0.35, 0.35);
  view.forward = unit({aside, 1.0, -up});
  const Vec3 level = unit(cross(view.forward, {0.0, 0.0, 1.0}));
  view.right = unit(level + cross(view.forward, level) * roll);
  view.down = cross(view.forward, view.right);
  const double x = random.uniform(-0.1, 0.1) * distance;
  const double y = random.uniform(-0.1, 0.1) * distance;
  view.eye = view.forward * -distance + view.right * x + view.down * y;
  return view;
}

std::vector<std::uint16_t> measured(const DepthSensor& sensor, const View& view, Random& noise) {
  std::vector<std::uint16_t> depths;
  const double zone = 2.0 * sensor.half_width / static_cast<double>(sensor.width);
  const double from_x = -0.5 * zone * static_cast<double>(sensor.width);
  const double from_y = -0.5 * zone * static_cast<double>(sensor.height);
  for (std::size_t v = 0; v < sensor.height; ++v) {
    for (std::size_t u = 0; u < sensor.width; ++u) {
      double sum = 0.0;
      int hits = 0;
      for (int ray = 0; ray < rays * rays; ++ray) {
        const double x = from_x + zone * (static_cast<double>(u) + (ray % rays + 0.5) / rays);
        const double y = from_y + zone * (static_cast<double>(v) + (ray / rays + 0.5) / rays);
        const double depth = cast_ray(view.thing, view.eye, view.forward + view.right * x + view.down * y);
        if (!(depth < farthest)) continue;
        sum += depth;
        ++hits;
      }
      const double deviation = 1.0 + noise_share * noise.normal();
      const bool is_missing = noise.uniform() < missing_share || 3 * hits < rays * rays;
      const double millimeters = is_missing ? 0.0 : std::floor(1000.0 * sum / hits * deviation + 0.5);
      depths.push_back(static_cast<std::uint16_t>(millimeters));
    }
  }
  return depths;
}

}  // namespace shortshot_bench::firmware
