// shortshot/frame/normal.hpp: the surface normal of a gathered neighborhood.
#ifndef SHORTSHOT_FRAME_NORMAL_HPP
#define SHORTSHOT_FRAME_NORMAL_HPP

#include <cstddef>
#include <cstdint>

#include "../base/fixed_point.hpp"
#include "../base/simd.hpp"
#include "../base/symmetric_eigen.hpp"
#include "../base/unroll.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/point_lanes.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "viewpoint.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Fewest neighbors (the key point and its copies included) for a normal, as in PCL.
inline constexpr std::uint32_t min_normal_neighbors = 3;

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// How members are brought to fixed point: coordinates times `unit`, which makes the farthest one at most 1 long; then
/// they, and products of two of them, times `scale`.
struct MomentScale {
  float unit;
  float scale;
};

/// The finest for `n` points that are no farther than `farthest`.
[[nodiscard]] inline MomentScale moment_scale(std::uint32_t n, float farthest) noexcept {
  return {1.0f / farthest, fixed_point_scale(n)};
}

/// How far the members reach; 1e-19 m at least: below that, squares are lost to underflow.
template <class Neighbors>
[[nodiscard]] inline float farthest_member(const Neighbors& n, Radius radius) noexcept {
  simd::F32 farthest = simd::all(0.0f);
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const simd::F32 d2 = load_neighbors(n, i).d2;
    farthest = simd::max(farthest, keep(d2 < simd::all(radius.squared), d2));
  }
  const float root = simd::sqrt(simd::largest(farthest));
  return root > 1e-19f ? root : 1e-19f;
}

/// What points add to moments: x, y, z; xx, xy, xz, yy, yz, zz. Integers, see fixed_point.hpp.
struct Terms {
  static constexpr int kinds = 9;
  simd::I32 of[kinds];
};

[[nodiscard, gnu::always_inline]] inline Terms terms_of(const NeighborLanes& v, const MomentScale& by) noexcept {
  using simd::all;
  using simd::F32;
  const F32 x = v.dx * all(by.unit);
  const F32 y = v.dy * all(by.unit);
  const F32 z = v.dz * all(by.unit);
  const F32 wx = x * all(by.scale);
  const F32 wy = y * all(by.scale);
  const F32 wz = z * all(by.scale);
  return {{round_to_int(wx), round_to_int(wy), round_to_int(wz), round_to_int(wx * x), round_to_int(wx * y),
           round_to_int(wx * z), round_to_int(wy * y), round_to_int(wy * z), round_to_int(wz * z)}};
}

/// Sums over the members of a neighborhood: all that its plane depends on. Lanes hold either shares of one
/// neighborhood, or neighborhoods. The origin is arbitrary.
struct Moments {
  simd::I32 members;
  simd::I32 of[Terms::kinds];
};

/// Adds a register of points, where they are members.
template <class TermOf>
[[gnu::always_inline]] inline void add_where(simd::Mask members, Moments& to, TermOf term_of) noexcept {
  to.members = increment(members, to.members);
  unroll<Terms::kinds>([&](auto k) { to.of[k] = to.of[k] + keep(members, term_of(k)); });
}

/// The sums over one neighborhood, in every lane.
template <class Neighbors>
[[nodiscard]] inline Moments moments_of(const Neighbors& n, Radius radius, const MomentScale& by) noexcept {
  Moments shares{};
  std::uint32_t i = 0;
  for (; i < n.size; i += simd::lanes) {
    const NeighborLanes v = load_neighbors(n, i);
    const Terms terms = terms_of(v, by);
    add_where(v.d2 < simd::all(radius.squared), shares, [&](auto k) { return terms.of[k]; });
  }
  const auto left_over = static_cast<std::int32_t>(i - n.size);  // what fills up the last register
  Moments moments;
  moments.members = simd::all_int(sum(shares.members) - left_over);
  unroll<Terms::kinds>([&](auto k) { moments.of[k] = simd::all_int(sum(shares.of[k])); });
  return moments;
}

/// Are there enough members, and do they reach far enough in the unit for their rounding to integers to mean nothing?
[[nodiscard]] inline simd::Mask is_fine(const Moments& m, const MomentScale& by) noexcept {
  const simd::Mask enough = m.members > simd::all_int(static_cast<std::int32_t>(min_normal_neighbors) - 1);
  return enough & (to_float(m.of[3] + m.of[6] + m.of[8]) > to_float(m.members) * simd::all(0.0625f * by.scale));
}

[[nodiscard]] inline PointLanes keep(simd::Mask m, const PointLanes& v) noexcept {
  return {keep(m, v.x), keep(m, v.y), keep(m, v.z)};
}

/// Unit vectors along which the members scatter least about their centroid, turned `towards` something; zeros where
/// they lie on a line, or in one place.
[[nodiscard]] inline PointLanes normals_of(const Moments& m, const MomentScale& by,
                                           const PointLanes& towards) noexcept {
  using simd::all;
  using simd::F32;
  const auto moment = [&m](int kind) { return to_float(m.of[kind]); };
  const F32 members = to_float(m.members);
  const F32 x = moment(0);
  const F32 y = moment(1);
  const F32 z = moment(2);
  const F32 weight = all(1.0f) / (members * all(by.scale));
  const F32 mean_x = x * weight;
  const F32 mean_y = y * weight;
  const F32 mean_z = z * weight;
  const EigenLanes eigen = decompose({{moment(3) - x * mean_x, moment(4) - x * mean_y, moment(5) - x * mean_z,
                                       moment(6) - y * mean_y, moment(7) - y * mean_z, moment(8) - z * mean_z}});
  // What float can tell apart, and what the rounding of the members to integers may have moved.
  const F32 resolution = all(1e-6f) * eigen.value(2) + all(4.0f) * members;
  const simd::Mask flat = eigen.value(1) - eigen.value(0) > resolution;
  const F32(&axis)[4] = eigen.of[0];
  const simd::Mask away = (axis[0] * towards.x + axis[2] * towards.z) + axis[1] * towards.y < all(0.0f);
  const auto turned = [&](int k) { return negate(away, axis[k]) + all(0.0f); };  // no negative zeros
  return keep(flat, PointLanes{turned(0), turned(1), turned(2)});
}

/// What to turn the normals at these places to; zeros if the viewpoint is absent.
[[nodiscard]] inline PointLanes directions(const Viewpoint& viewpoint, const PointLanes& places) noexcept {
  using Side = Viewpoint::Side;
  using simd::all;
  const float side = viewpoint.side == Side::absent ? 0.0f : viewpoint.side == Side::towards ? 1.0f : -1.0f;
  const Point& p = viewpoint.point;
  return {(all(p.x) - places.x) * all(side), (all(p.y) - places.y) * all(side), (all(p.z) - places.z) * all(side)};
}

/// One normal from each lane.
inline void store(SurfaceNormal* normals, const PointLanes& v) noexcept {
  float components[3][simd::lanes];
  simd::store(components[0], v.x);
  simd::store(components[1], v.y);
  simd::store(components[2], v.z);
  for (std::size_t lane = 0; lane < simd::lanes; ++lane) {
    normals[lane] = {components[0][lane], components[1][lane], components[2][lane]};
  }
}

[[nodiscard]] inline bool is_zero(const SurfaceNormal& n) noexcept { return n.x == 0.0f && n.y == 0.0f && n.z == 0.0f; }

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The normal of the plane through a gathered neighborhood: the direction in which the neighbors within `radius`
/// scatter least about their centroid, the key point and its copies among them. Source: PCL 1.13's NormalEstimation.
///
/// `radius` may be smaller than the one the neighborhood was gathered with.
/// `viewpoint` turns the normal. Where it is absent, or at right angles to the normal, the sign is the solver's:
/// arbitrary, but the same on every machine.
///
/// Statuses: bad_radius; bad_viewpoint (not finite); too_many_neighbors (more than 2^24); too_few_neighbors (fewer than
/// three); ambiguous_frame (the two smaller extents are equal within float resolution: the neighbors lie on a line, or
/// in one place). `normal` is zeroed then. No allocation, reentrant. The result does not depend on the order of the
/// neighbors.
template <class Neighbors>
[[nodiscard]] inline Status estimate_normal(const Neighbors& n, Radius radius, SurfaceNormal& normal,
                                            const Viewpoint& viewpoint = {}) noexcept {
  normal = SurfaceNormal{};
  float view[3] = {};
  const Status usable = detail::validate_estimate(n, radius, viewpoint, view);
  if (usable != Status::ok) return usable;

  const extend::PointLanes towards{extend::simd::all(view[0]), extend::simd::all(view[1]), extend::simd::all(view[2])};
  const std::uint32_t members = extend::count_within(n, radius);
  if (members < min_normal_neighbors) return Status::too_few_neighbors;
  // In units of the radius; or, where the members fill too little of it, of the farthest one's distance.
  detail::MomentScale scale = detail::moment_scale(members, radius.value);
  detail::Moments moments = detail::moments_of(n, radius, scale);
  SurfaceNormal found[extend::simd::lanes] = {};
  if (any(detail::is_fine(moments, scale))) detail::store(found, detail::normals_of(moments, scale, towards));
  if (detail::is_zero(found[0])) {
    scale = detail::moment_scale(members, detail::farthest_member(n, radius));
    moments = detail::moments_of(n, radius, scale);
    detail::store(found, detail::normals_of(moments, scale, towards));
  }
  normal = found[0];
  return detail::is_zero(normal) ? Status::ambiguous_frame : Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_FRAME_NORMAL_HPP
