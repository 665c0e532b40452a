// Must be built with -ffp-contract=off: see the note on determinism in solids.hpp.
#include "tools/scene/objects.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace shortshot_bench {
namespace scene_detail {

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

}  // namespace scene_detail
}  // namespace shortshot_bench
