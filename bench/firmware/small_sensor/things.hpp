// Things that are held in front of a small depth sensor: hands, and simple shapes. Each is drawn anew: no two of a
// class are alike.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/scene/random.hpp"
#include "tools/scene/solids.hpp"

namespace shortshot_bench::firmware {

/// All points within a radius of a line from a to b.
struct Capsule {
  Vec3 a;
  Vec3 b;
  double radius;
};

/// In a frame of its own, meters: x right, y away from the sensor, z up; about the origin. Hands show their palm.
struct Thing {
  std::vector<scene_detail::Solid> solids;
  std::vector<Capsule> capsules;
};

inline constexpr const char* thing_classes[] = {"flat hand", "fist", "pointing", "two fingers",
                                                "ball",      "box",  "can",      "bowl"};
inline constexpr std::size_t thing_class_count = sizeof thing_classes / sizeof thing_classes[0];
inline constexpr std::size_t hand_count = 4;  // the first ones

/// The same on every IEEE 754 platform, as all of tools/scene.
Thing draw_thing(Random& random, std::size_t thing_class);

/// How far a ray goes to the first surface, in lengths of its direction; kInfinity if it meets none.
double cast_ray(const Thing& thing, const Vec3& origin, const Vec3& direction);

}  // namespace shortshot_bench::firmware
