// Must be built with -ffp-contract=off: see the note on determinism in solids.hpp.
#include "tools/scene/tabletop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tools/scene/objects.hpp"
#include "tools/scene/sensor.hpp"
#include "tools/scene/solids.hpp"

namespace shortshot_bench {
namespace {

using namespace scene_detail;

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

Vec3 turned(const Vec3& v, const Vec3& x_axis) {
  return {x_axis.x * v.x - x_axis.y * v.y, x_axis.y * v.x + x_axis.x * v.y, v.z};
}

void turn_scene(double turn, Scene& scene) {
  const Vec3 x_axis = direction_of(turn);
  for (Solid& solid : scene.solids) {
    solid.base = turned(solid.base, x_axis);
    solid.x_axis = turned(solid.x_axis, x_axis);
  }
  scene.lamp = turned(scene.lamp, x_axis);
}

}  // namespace

RgbdCloud make_tabletop(const TabletopOptions& options) {
  Scene scene = make_scene(options.seed);
  if (options.turn == 0.0) return record(scene, {options.seed, options.width, options.height, options.noise_scale});
  turn_scene(options.turn, scene);
  return record(scene, {~options.seed, options.width, options.height, options.noise_scale});
}

}  // namespace shortshot_bench
