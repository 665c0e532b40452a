// Ray-cast building blocks of generated scenes: solids with analytic intersections, procedural textures.
// Only what is in this folder needs them.
//
// Determinism: equal options must give equal bytes on every compiler and optimization level. Hence
// - no libm besides sqrt, floor and fabs, which IEEE 754 makes exact or correctly rounded: directions come
//   from normalized random vectors, angles around an axis from a rational stand-in;
// - random draws only in full expressions of their own or in braces, whose order of evaluation is fixed;
// - whatever includes this must be built with -ffp-contract=off and without -ffast-math: a fused multiply-add
//   rounds once where two operations round twice.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "tools/scene/random.hpp"

namespace shortshot_bench {
namespace scene_detail {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// --- Solids. World frame: x right, y away from the camera, z up; the table top is z = 0. ---

enum class Shape { box, cylinder, sphere };
enum class Pattern { plain, stripes, bands, checker, label, segments, wood };

struct Solid {
  Shape shape = Shape::box;
  Pattern pattern = Pattern::plain;
  Vec3 base{0.0, 0.0, 0.0};    // center of the bottom; the local frame has its origin here
  Vec3 x_axis{1.0, 0.0, 0.0};  // local x in the world; horizontal, local z stays vertical
  Vec3 size{0.0, 0.0, 0.0};    // box: half width, half length, height; else radius, radius, height
  bool open = false;           // cylinder without a lid, sphere cut off at its height
  std::array<Vec3, 3> colors{};
  double period = 0.03;
  std::uint32_t texture_seed = 0;
};

inline Vec3 rotate_to_local(const Solid& s, const Vec3& v) {
  return {s.x_axis.x * v.x + s.x_axis.y * v.y, s.x_axis.x * v.y - s.x_axis.y * v.x, v.z};
}
inline Vec3 rotate_to_world(const Solid& s, const Vec3& v) {
  return {s.x_axis.x * v.x - s.x_axis.y * v.y, s.x_axis.y * v.x + s.x_axis.x * v.y, v.z};
}

struct Hit {
  double t = kInfinity;
  Vec3 normal{0.0, 0.0, 0.0};
  const Solid* solid = nullptr;
};

inline void keep_nearer(Hit& hit, double t, const Vec3& normal) {
  if (t > 0.0 && t < hit.t) {
    hit.t = t;
    hit.normal = normal;
  }
}

inline Hit intersect_box(const Solid& s, const Vec3& o, const Vec3& d) {
  const std::array<double, 3> origin{{o.x, o.y, o.z}}, dir{{d.x, d.y, d.z}};
  const std::array<double, 3> low{{-s.size.x, -s.size.y, 0.0}}, high{{s.size.x, s.size.y, s.size.z}};
  double t_enter = -kInfinity, t_leave = kInfinity;
  std::array<double, 3> normal{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double inverse = 1.0 / (std::fabs(dir[i]) < 1e-12 ? 1e-12 : dir[i]);
    const double t0 = (low[i] - origin[i]) * inverse, t1 = (high[i] - origin[i]) * inverse;
    if (std::min(t0, t1) > t_enter) {
      t_enter = std::min(t0, t1);
      normal = {};
      normal[i] = t0 < t1 ? -1.0 : 1.0;
    }
    t_leave = std::min(t_leave, std::max(t0, t1));
  }
  Hit hit;
  if (t_enter <= t_leave) keep_nearer(hit, t_enter, {normal[0], normal[1], normal[2]});
  return hit;
}

inline Hit intersect_cylinder(const Solid& s, const Vec3& o, const Vec3& d) {
  Hit hit;
  const double r = s.size.x, a = d.x * d.x + d.y * d.y, b = o.x * d.x + o.y * d.y;
  const double discriminant = b * b - a * (o.x * o.x + o.y * o.y - r * r);
  if (discriminant < 0.0) return hit;  // misses even the infinite cylinder, hence the caps too
  for (const double sign : {-1.0, 1.0}) {
    const double t = (sign * std::sqrt(discriminant) - b) / std::max(a, 1e-12);
    const Vec3 p = o + d * t;
    if (p.z >= 0.0 && p.z <= s.size.z) keep_nearer(hit, t, {p.x / r, p.y / r, 0.0});
  }
  const double cap = s.open ? 0.004 : s.size.z;  // an open one shows its bottom, just above the table
  const double t = (cap - o.z) / (std::fabs(d.z) < 1e-12 ? 1e-12 : d.z);
  const Vec3 p = o + d * t;
  if (p.x * p.x + p.y * p.y <= r * r) keep_nearer(hit, t, {0.0, 0.0, 1.0});
  return hit;
}

inline Hit intersect_sphere(const Solid& s, const Vec3& o, const Vec3& d) {
  Hit hit;
  const double r = s.size.x;
  const Vec3 center{0.0, 0.0, r};
  const double a = dot(d, d), b = dot(o - center, d);
  const double discriminant = b * b - a * (dot(o - center, o - center) - r * r);
  if (discriminant < 0.0) return hit;
  for (const double sign : {-1.0, 1.0}) {
    const double t = (sign * std::sqrt(discriminant) - b) / a;
    const Vec3 p = o + d * t;
    if (!s.open || p.z <= s.size.z) keep_nearer(hit, t, (p - center) * (1.0 / r));
  }
  return hit;
}

// The nearest hit of the ray; its normal is in the local frame of the solid.
inline Hit cast_ray(const std::vector<Solid>& solids, const Vec3& origin, const Vec3& direction) {
  Hit best;
  for (const Solid& s : solids) {
    const Vec3 o = rotate_to_local(s, origin - s.base), d = rotate_to_local(s, direction);
    Hit hit = s.shape == Shape::box        ? intersect_box(s, o, d)
              : s.shape == Shape::cylinder ? intersect_cylinder(s, o, d)
                                           : intersect_sphere(s, o, d);
    hit.solid = &s;
    if (hit.t < best.t) best = hit;
  }
  return best;
}

// --- Procedural textures ---

inline double lattice_value(double x, double y, std::uint32_t seed) {  // in [0, 1), constant on unit cells
  std::uint32_t h = seed + 0x9e3779b9u * static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(x)));
  h = (h ^ (h >> 15)) * 0x85ebca6bu;
  h += 0xc2b2ae35u * static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(y)));
  h = (h ^ (h >> 13)) * 0x27d4eb2fu;
  return static_cast<double>(h ^ (h >> 16)) * 0x1p-32;
}

inline double smooth_noise(double x, double y, std::uint32_t seed) {
  const double wx = x - std::floor(x), wy = y - std::floor(y);
  const double a = lattice_value(x, y, seed), b = lattice_value(x + 1.0, y, seed);
  const double c = lattice_value(x, y + 1.0, seed), d = lattice_value(x + 1.0, y + 1.0, seed);
  return (a * (1.0 - wx) + b * wx) * (1.0 - wy) + (c * (1.0 - wx) + d * wx) * wy;
}

inline bool is_odd(double x) { return std::floor(x) - 2.0 * std::floor(0.5 * x) > 0.5; }

// Grows from 0 to 4 once around the z axis, like an angle would, with a division instead of atan2.
inline double turn_around_z(const Vec3& p) {
  const double ratio = p.y / std::max(std::fabs(p.x) + std::fabs(p.y), 1e-12);
  return p.x < 0.0 ? 2.0 - ratio : (ratio < 0.0 ? 4.0 + ratio : ratio);
}

// A horizontal direction, as turn_around_z() counts: along a square, without an angle's sine.
inline Vec3 direction_of(double turn) {
  const double whole = std::floor(turn);
  const double part = turn - whole;
  Vec3 v{1.0 - part, part, 0.0};
  for (int quarter = static_cast<int>(whole) % 4; quarter > 0; --quarter) v = {-v.y, v.x, 0.0};
  return v * (1.0 / norm(v));
}

// Where on a solid a point lies: u along and v up its face, in meters, 0 in the middle of the face.
struct FacePoint {
  double u, v, half_u, half_v;
  bool on_top;
};

inline FacePoint face_point(const Solid& s, const Vec3& p, const Vec3& n) {
  const double half_height = 0.5 * s.size.z, v = p.z - half_height;
  if (s.shape == Shape::box && std::fabs(n.x) > 0.5) return {p.y, v, s.size.y, half_height, false};
  if (s.shape == Shape::box && std::fabs(n.y) > 0.5) return {p.x, v, s.size.x, half_height, false};
  if (s.shape == Shape::box || (s.shape == Shape::cylinder && std::fabs(n.z) > 0.5))
    return {p.x, p.y, s.size.x, s.size.y, true};
  return {(turn_around_z(p) - 2.0) * 1.57 * s.size.x, v, 2.2 * s.size.x, half_height, false};
}

inline Vec3 wood_color(const Solid& s, double u, double v) {
  const double plank = std::floor(v / 0.13);
  const double shift = 50.0 * lattice_value(plank, 0.0, s.texture_seed);
  const double rings = 40.0 * v + 6.0 * smooth_noise(3.0 * u + shift, 9.0 * v, s.texture_seed);
  const double ring = std::fabs(rings - std::floor(rings) - 0.5) * 2.0;
  const double grain = smooth_noise(25.0 * u + shift, 350.0 * v, s.texture_seed + 1);
  const bool gap = v - 0.13 * plank < 0.003;
  const double tone = 0.85 + 0.3 * lattice_value(plank, 1.0, s.texture_seed);
  return mix(s.colors[0], s.colors[1], 0.6 * ring + 0.4 * grain) * (gap ? 0.4 : tone);
}

// A patch with lines of print-like blocks under a title bar.
inline Vec3 label_color(const Solid& s, const FacePoint& q) {
  if (std::fabs(q.u) > 0.75 * q.half_u || std::fabs(q.v) > 0.7 * q.half_v) return s.colors[0];
  if (q.v > 0.3 * q.half_v) return s.colors[2];
  const bool print = is_odd(q.v / 0.007) && lattice_value(q.u / 0.005, q.v / 0.014, s.texture_seed) < 0.6;
  return print ? s.colors[2] * 0.35 : s.colors[1];
}

inline Vec3 surface_color(const Solid& s, const Vec3& p, const Vec3& n) {
  const FacePoint q = face_point(s, p, n);
  const double u = q.u / s.period, v = q.v / s.period;
  std::size_t index = 0;
  if (s.shape == Shape::cylinder && q.on_top) return s.colors[2];  // a lid
  switch (s.pattern) {
    case Pattern::label: return label_color(s, q);
    case Pattern::wood: return wood_color(s, q.u, q.v);
    case Pattern::stripes: index = is_odd(q.on_top ? u : u + 0.7 * v) ? 1 : 0; break;
    case Pattern::bands: index = is_odd(v) ? 1 : 0; break;
    case Pattern::checker: index = is_odd(u) != is_odd(v) ? 1 : 0; break;
    case Pattern::segments: index = is_odd(turn_around_z(p)) != (q.v > 0.0) ? 1 : 0; break;
    case Pattern::plain: break;
  }
  return s.colors[index] * (0.88 + 0.24 * smooth_noise(q.u / 0.008, q.v / 0.008, s.texture_seed));
}

}  // namespace scene_detail
}  // namespace shortshot_bench
