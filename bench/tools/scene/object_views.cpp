// Must be built with -ffp-contract=off: see the note on determinism in solids.hpp.
#include "tools/scene/object_views.hpp"

#include <array>

#include "tools/io/valid_points.hpp"
#include "tools/scene/objects.hpp"
#include "tools/scene/sensor.hpp"

namespace shortshot_bench {
namespace {

using namespace scene_detail;

constexpr std::array<Kind, 5> object_kinds{{Kind::box, Kind::can, Kind::ball, Kind::bowl, Kind::mug}};
constexpr std::array<const char*, 5> object_classes{{"box", "can", "ball", "bowl", "mug"}};

}  // namespace

std::string generated_class(std::size_t object) { return object_classes[object % object_classes.size()]; }
std::string generated_instance(std::size_t object) {
  return generated_class(object) + " " + std::to_string(1 + object / object_classes.size());
}

ObjectView make_object_view(std::size_t object, const ObjectViewOptions& options) {
  Random random(1000 + static_cast<std::uint32_t>(object));
  const Kind kind = object_kinds[object % object_kinds.size()];
  Scene scene;
  scene.solids.push_back(draw_object(random, kind));
  scene.solids[0].x_axis = direction_of(options.turn);
  if (kind == Kind::mug) add_mug_handle(Solid(scene.solids[0]), scene.solids);
  const Vec3 aim{0.0, 0.81, -0.5 - 0.3 * options.height};
  scene.forward = aim * (1.0 / norm(aim));
  scene.down = {0.0, scene.forward.z, -scene.forward.y};
  scene.eye = scene.forward * (options.height / scene.forward.z);
  scene.lamp = {-0.6, -0.5, 1.4};

  const Sensor sensor{options.seed, options.width, options.width * 3 / 4, 1.0f};
  ObjectView view;
  view.cloud = valid_points(record(scene, sensor));
  const Vec3 middle = Vec3{0.0, 0.0, 0.5 * scene.solids[0].size.z} - scene.eye;
  view.center = {static_cast<float>(middle.x), static_cast<float>(dot(middle, scene.down)),
                 static_cast<float>(dot(middle, scene.forward))};
  return view;
}

}  // namespace shortshot_bench
