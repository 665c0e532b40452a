// Must be built with -ffp-contract=off: see the note on determinism in tabletop_solids.hpp.
#include "tools/scene/tabletop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tools/scene/tabletop_solids.hpp"

namespace shortshot_bench {
namespace {

using namespace tabletop_detail;

constexpr double kMaxDepth = 3.0;
constexpr double kMinCosIncidence = 0.2;
constexpr double kDropoutShare = 0.01;
constexpr double kColorSigma = 4.0;       // of 255
constexpr double kEchoSpread = 0.1;       // of its size, to either side
constexpr double kEchoAtOneMeter = 40.0;  // of a color of brightness 1 (of 255)

struct Scene {
  std::vector<Solid> solids;
  Vec3 eye{}, down{}, forward{};  // the camera; its x axis is the world's, so that table rows have one depth
  Vec3 lamp{};
};

// --- The room ---

Solid make_box(const Vec3& base, const Vec3& size, Pattern pattern, double period) {
  Solid box;
  box.pattern = pattern;
  box.base = base;
  box.size = size;
  box.period = period;
  return box;
}

void add_room(Random& random, Scene& scene) {
  Solid table = make_box({0.0, -0.05, -0.03}, {0.8, 0.57, 0.03}, Pattern::wood, 1.0);
  table.colors = {{{198.0, 150.0, 98.0}, {128.0, 82.0, 44.0}, {}}};
  // The wall ends to the right: what is seen past it lies beyond the range of the sensor.
  Solid wall = make_box({-1.2, 1.1, -0.75}, {1.75, 0.05, 2.5}, Pattern::stripes, 0.12);
  wall.colors = {{{176.0, 184.0, 190.0}, {150.0, 163.0, 178.0}, {}}};
  Solid floor = make_box({0.0, 0.0, -0.8}, {8.0, 8.0, 0.05}, Pattern::checker, 0.25);
  floor.colors = {{{120.0, 116.0, 110.0}, {88.0, 84.0, 82.0}, {}}};
  Solid picture = make_box({random.uniform(-0.5, 0.0), 1.04, -0.1}, {0.22, 0.01, 0.24}, Pattern::label, 0.04);
  for (Vec3& color : picture.colors) color = random.vivid_color();
  for (Solid* solid : {&table, &wall, &floor, &picture}) {
    solid->texture_seed = random.bits();
    scene.solids.push_back(*solid);
  }
}

void place_camera_and_lamp(Random& random, Scene& scene) {
  const double height = random.uniform(0.57, 0.63);
  const Vec3 aim{0.0, random.uniform(0.80, 0.84), -0.574};  // about 35 degrees down
  scene.forward = aim * (1.0 / norm(aim));
  scene.down = {0.0, scene.forward.z, -scene.forward.y};
  scene.eye = scene.forward * (height / scene.forward.z);  // the optical axis meets the table at the origin
  scene.lamp = {random.uniform(-0.9, -0.3), random.uniform(-0.8, -0.3), random.uniform(1.2, 1.6)};
}

// --- The objects ---

enum class Kind { box, can, ball, bowl, mug };

Solid draw_object(Random& random, Kind kind) {
  Solid s;
  s.x_axis = random.horizontal_direction();
  s.texture_seed = random.bits();
  s.period = random.uniform(0.012, 0.03);
  for (Vec3& color : s.colors) color = random.vivid_color();
  if (kind == Kind::box) {
    constexpr std::array<Pattern, 4> kPatterns{{Pattern::label, Pattern::stripes, Pattern::checker, Pattern::label}};
    s.pattern = kPatterns[random.bits() % kPatterns.size()];
    s.colors[1] = mix(s.colors[1], {255.0, 255.0, 245.0}, 0.7);
    s.size = {random.uniform(0.03, 0.08), random.uniform(0.025, 0.06), random.uniform(0.05, 0.20)};
    return s;
  }
  const double unit = random.uniform();
  if (kind == Kind::can || kind == Kind::mug) {
    const double radius = 0.032 + 0.013 * unit;
    s.shape = Shape::cylinder;
    s.pattern = random.bits() % 2 == 0 ? Pattern::bands : Pattern::label;
    s.size = {radius, radius, kind == Kind::mug ? 0.095 : random.uniform(0.08, 0.16)};
    s.open = kind == Kind::mug;
    if (!s.open) s.colors[2] = {190.0, 190.0, 195.0};  // the metal lid
  } else {
    const double radius = kind == Kind::bowl ? 0.09 + 0.02 * unit : 0.03 + 0.025 * unit;
    s.shape = Shape::sphere;
    s.pattern = kind == Kind::bowl ? Pattern::bands : Pattern::segments;
    s.open = kind == Kind::bowl;
    s.size = {radius, radius, s.open ? 0.7 * radius : 2.0 * radius};
  }
  return s;
}

double footprint_radius(const Solid& s, Kind kind) {
  if (kind == Kind::box) return std::sqrt(s.size.x * s.size.x + s.size.y * s.size.y);
  return kind == Kind::mug ? s.size.x + 0.035 : s.size.x;
}

void add_mug_handle(const Solid& mug, std::vector<Solid>& solids) {
  const double r = mug.size.x, height = mug.size.z;
  const std::array<std::array<double, 4>, 3> bars{// along the mug's x axis: center, half width; bottom, height
                                                  {{{r + 0.012, 0.014, 0.2 * height, 0.009}},
                                                   {{r + 0.012, 0.014, 0.8 * height, 0.009}},
                                                   {{r + 0.026, 0.005, 0.2 * height, 0.6 * height + 0.009}}}};
  for (const std::array<double, 4>& bar : bars) {
    Solid s = mug;
    s.shape = Shape::box;
    s.pattern = Pattern::plain;
    s.base = mug.base + mug.x_axis * bar[0] + Vec3{0.0, 0.0, bar[2]};
    s.size = {bar[1], 0.006, bar[3]};
    solids.push_back(s);
  }
}

void add_objects(Random& random, Scene& scene) {
  struct Footprint {
    Vec3 center;
    double radius;
  };
  std::vector<Footprint> taken;
  constexpr std::array<Kind, 3> kExtra{{Kind::box, Kind::can, Kind::ball}};
  std::vector<Kind> kinds{Kind::bowl, Kind::mug, Kind::box,  Kind::box, Kind::box,
                          Kind::can,  Kind::can, Kind::ball, Kind::ball};
  for (int i = 0; i < 3; ++i) kinds.push_back(kExtra[random.bits() % kExtra.size()]);
  for (const Kind kind : kinds) {
    Solid s = draw_object(random, kind);
    const double radius = footprint_radius(s, kind);
    for (int attempt = 0; attempt < 300; ++attempt) {  // an object that finds no room is left out
      s.base.y = random.uniform(-0.34, 0.40);
      const double half_width = 0.45 + 0.35 * s.base.y;  // what the camera sees narrows towards it
      s.base.x = random.uniform(-half_width, half_width);
      const bool free = std::none_of(taken.begin(), taken.end(), [&](const Footprint& other) {
        return norm(s.base - other.center) < radius + other.radius + 0.01;
      });
      if (!free) continue;
      taken.push_back({s.base, radius});
      scene.solids.push_back(s);
      if (kind == Kind::mug) add_mug_handle(s, scene.solids);
      break;
    }
  }
}

Scene make_scene(std::uint32_t seed) {
  Random random(seed);
  Scene scene;
  place_camera_and_lamp(random, scene);
  add_room(random, scene);
  add_objects(random, scene);
  return scene;
}

// --- The sensor ---

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

RgbdCloud make_tabletop(const TabletopOptions& options) {
  const Scene scene = make_scene(options.seed);
  // A stream of its own, so that the noise does not depend on how many draws the scene took.
  Random noise(options.seed ^ 0x5bd1e995u);
  Random echo_noise(options.seed ^ 0x1b873593u);  // and another one: points and colors are as they were without echoes
  const double scale = static_cast<double>(options.width) / 640.0;
  const double focal_px = 525.0 * scale, disparity_scale = 575.0 * 0.075 * scale;
  const double center_u = 0.5 * (static_cast<double>(options.width) - 1.0);
  const double center_v = 0.5 * (static_cast<double>(options.height) - 1.0);

  RgbdCloud cloud;
  cloud.width = options.width;
  cloud.height = options.height;
  cloud.xyz.reserve(3 * options.width * options.height);
  cloud.rgb.reserve(3 * options.width * options.height);
  cloud.intensity.reserve(options.width * options.height);
  for (std::size_t v = 0; v < options.height; ++v) {
    const double y = (static_cast<double>(v) - center_v) / focal_px;
    for (std::size_t u = 0; u < options.width; ++u) {
      const double x = (static_cast<double>(u) - center_u) / focal_px;
      const Vec3 ray = scene.forward + scene.down * y + Vec3{x, 0.0, 0.0};
      const Hit hit = cast_ray(scene.solids, scene.eye, ray);
      const double z = measured_depth(noise, ray, hit, static_cast<double>(options.noise_scale), disparity_scale);
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

}  // namespace shortshot_bench
