// Must be built with -ffp-contract=off: see the note on determinism in solids.hpp.
#include "firmware/small_sensor/things.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/scene/objects.hpp"

namespace shortshot_bench::firmware {
namespace {

using scene_detail::kInfinity;
using scene_detail::Shape;
using scene_detail::Solid;

double first_of_ball(const Vec3& center, double radius, const Vec3& o, const Vec3& d) {
  const Vec3 from = o - center;
  const double b = dot(from, d), dd = dot(d, d);
  const double discriminant = b * b - dd * (dot(from, from) - radius * radius);
  if (discriminant < 0.0) return kInfinity;
  const double t = (-b - std::sqrt(discriminant)) / dd;
  return t > 0.0 ? t : kInfinity;
}

/// The first of the side and the balls at both ends; for rays from outside.
double first_of(const Capsule& c, const Vec3& o, const Vec3& d) {
  double first = std::min(first_of_ball(c.a, c.radius, o, d), first_of_ball(c.b, c.radius, o, d));
  const Vec3 axis = c.b - c.a, from = o - c.a;
  const double axis2 = dot(axis, axis), along_d = dot(axis, d), along_o = dot(axis, from);
  const double a = axis2 * dot(d, d) - along_d * along_d;
  const double b = axis2 * dot(from, d) - along_o * along_d;
  const double discriminant = b * b - a * (axis2 * (dot(from, from) - c.radius * c.radius) - along_o * along_o);
  if (a < 1e-15 || discriminant < 0.0) return first;
  const double t = (-b - std::sqrt(discriminant)) / a;
  const double along = along_o + t * along_d;
  if (t > 0.0 && along >= 0.0 && along <= axis2) first = std::min(first, t);
  return first;
}

/// A right hand with some fingers stretched out, the others bent towards the sensor; index, middle, ring and little
/// finger from the thumb's side on. Lengths in meters of a grown person's.
Thing draw_hand(Random& random, const std::array<bool, 4>& stretched, bool thumb_out) {
  constexpr std::array<double, 4> lengths{{0.072, 0.080, 0.074, 0.058}};
  const double spread = random.uniform(0.0, 0.02);
  Thing hand;
  const auto add = [&](Vec3 a, Vec3 b, double radius) { hand.capsules.push_back({a, b, radius}); };
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = 0.030 - 0.020 * static_cast<double>(i);
    const double length = lengths[i] * random.uniform(0.92, 1.08);
    const Vec3 knuckle{x, 0.0, 0.035};
    add({0.7 * x, 0.0, -0.045}, knuckle, 0.013);  // of the palm
    if (stretched[i]) {
      const double aside = spread * (i == 0 ? 1.0 : i == 1 ? -0.2 : i == 2 ? -0.7 : -1.4);
      add(knuckle, {x + aside, random.uniform(-0.01, 0.0), 0.035 + length}, 0.009);
    } else {
      const Vec3 joint{x, -0.035, 0.035};
      add(knuckle, joint, 0.010);
      add(joint, {x, -0.038, 0.035 - 0.4 * length}, 0.010);
    }
  }
  if (thumb_out) {
    add({0.030, -0.005, -0.030}, {0.068, -0.010, 0.015}, 0.012);
  } else {
    add({0.030, -0.015, -0.030}, {0.035, -0.040, -0.005}, 0.012);
    add({0.035, -0.040, -0.005}, {-0.005, -0.050, 0.010}, 0.011);
  }
  add({0.0, 0.0, -0.05}, {0.0, random.uniform(0.0, 0.03), -0.20}, 0.026);  // the arm
  const double scale = random.uniform(0.85, 1.1);
  const double side = random.bits() % 2 == 0 ? scale : -scale;  // left ones, too
  for (Capsule& c : hand.capsules) {
    c.radius = c.radius * scale;
    for (Vec3* const end : {&c.a, &c.b}) *end = {end->x * side, end->y * scale, end->z * scale};
  }
  return hand;
}

Thing draw_shape(Random& random, std::size_t shape) {
  Solid solid;
  solid.x_axis = random.horizontal_direction();
  const double r = random.uniform(0.030, 0.050);
  if (shape == 0) {  // ball
    solid.shape = Shape::sphere;
    solid.size = {r, r, 2.0 * r};
  } else if (shape == 1) {  // box
    solid.size.x = random.uniform(0.025, 0.045);
    solid.size.y = random.uniform(0.025, 0.045);
    solid.size.z = random.uniform(0.06, 0.11);
  } else if (shape == 2) {  // can
    solid.shape = Shape::cylinder;
    solid.size = {0.8 * r, 0.8 * r, random.uniform(0.08, 0.12)};
  } else {  // bowl
    solid.shape = Shape::sphere;
    solid.open = true;
    solid.size = {1.4 * r, 1.4 * r, 1.1 * r};
  }
  solid.base = {0.0, 0.0, -0.5 * solid.size.z};
  return {{solid}, {}};
}

}  // namespace

Thing draw_thing(Random& random, std::size_t thing_class) {
  switch (thing_class) {
    case 0: return draw_hand(random, {{true, true, true, true}}, true);
    case 1: return draw_hand(random, {{false, false, false, false}}, false);
    case 2: return draw_hand(random, {{true, false, false, false}}, false);
    case 3: return draw_hand(random, {{true, true, false, false}}, false);
    default: return draw_shape(random, thing_class - hand_count);
  }
}

double cast_ray(const Thing& thing, const Vec3& origin, const Vec3& direction) {
  double first = scene_detail::cast_ray(thing.solids, origin, direction).t;
  for (const Capsule& capsule : thing.capsules) first = std::min(first, first_of(capsule, origin, direction));
  return first;
}

}  // namespace shortshot_bench::firmware
