// shortshot/normals.hpp: the surface normal of a gathered neighbourhood.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cloud.hpp"
#include "config.hpp"
#include "math.hpp"
#include "neighborhood.hpp"
#include "simd.hpp"
#include "status.hpp"
#include "symmetric_eigen.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {

/// Fewest neighbours (the key point and its copies included) for a normal, as in PCL.
inline constexpr int min_normal_neighbors = 3;

namespace detail {

/// How members are brought to fixed point: coordinates times `unit`, which makes the farthest one at most 1 long; then
/// they, and products of two of them, times `scale`, a power of two.
struct MomentScale {
  float unit;
  float scale;
};

/// The same for all neighbourhoods of a radius and of up to max_plain_members: terms of 20 bits, sums below 2^31.
inline constexpr std::uint32_t max_plain_members = 2047;
[[nodiscard]] inline MomentScale plain_scale(Radius radius) noexcept { return {1.0f / radius.value, 1048576.0f}; }

/// The finest for one neighbourhood: its farthest member is 1 long, terms have up to 22 bits.
[[nodiscard]] inline MomentScale finest_scale(const Neighborhood& n, Radius radius) noexcept {
  simd::F32 farthest = simd::all(0.0f);
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const simd::F32 d2 = load_offsets(n, i).d2;
    farthest = simd::max(farthest, keep(d2 < simd::all(radius.squared), d2));
  }
  // Below 1e-19 m squares are lost to underflow: such members count as if they were at the key point.
  const float root = simd::root(simd::largest(farthest));
  const float room = 1073741824.0f / static_cast<float>(n.size);
  return {1.0f / (root > 1e-19f ? root : 1e-19f), math::power_of_two_below(room < 4194304.0f ? room : 4194304.0f)};
}

/// Sums over the members of a neighbourhood: all that its plane depends on. Integers, see fixed_point.hpp. Lanes hold
/// either shares of one neighbourhood, or neighbourhoods.
struct Moments {
  simd::I32 members, x, y, z, xx, xy, xz, yy, yz, zz;
};

[[gnu::always_inline]] inline void add(Moments& to, const Offsets& v, Radius radius, const MomentScale& by) noexcept {
  using simd::all;
  using simd::F32;
  const simd::Mask near = v.d2 < all(radius.squared);
  const F32 x = v.dx * all(by.unit);
  const F32 y = v.dy * all(by.unit);
  const F32 z = v.dz * all(by.unit);
  const F32 wx = keep(near, x * all(by.scale));
  const F32 wy = keep(near, y * all(by.scale));
  const F32 wz = keep(near, z * all(by.scale));
  to.members = increment(near, to.members);
  to.x = to.x + round_to_int(wx);
  to.y = to.y + round_to_int(wy);
  to.z = to.z + round_to_int(wz);
  to.xx = to.xx + round_to_int(wx * x);
  to.xy = to.xy + round_to_int(wx * y);
  to.xz = to.xz + round_to_int(wx * z);
  to.yy = to.yy + round_to_int(wy * y);
  to.yz = to.yz + round_to_int(wy * z);
  to.zz = to.zz + round_to_int(wz * z);
}

/// The sums over one neighbourhood, in every lane.
[[nodiscard]] inline Moments moments_of(const Neighborhood& n, Radius radius, const MomentScale& by) noexcept {
  Moments m{};
  std::uint32_t i = 0;
  for (; i < n.size; i += simd::lanes) add(m, load_offsets(n, i), radius, by);
  const auto total = [](simd::I32 shares) { return simd::all_int(sum(shares)); };
  const auto left_over = static_cast<std::int32_t>(i - n.size);  // what fills up the last register
  return {total(m.members) - simd::all_int(left_over),
          total(m.x),
          total(m.y),
          total(m.z),
          total(m.xx),
          total(m.xy),
          total(m.xz),
          total(m.yy),
          total(m.yz),
          total(m.zz)};
}

/// Are there enough members, and do they reach far enough in the unit for their rounding to integers to mean nothing?
[[nodiscard]] inline simd::Mask is_fine(const Moments& m, const MomentScale& by) noexcept {
  const simd::Mask enough = m.members > simd::all_int(min_normal_neighbors - 1);
  return enough & (to_float(m.xx + m.yy + m.zz) > to_float(m.members) * simd::all(0.0625f * by.scale));
}

/// A vector in each lane.
struct VectorLanes {
  simd::F32 x, y, z;
};

[[nodiscard]] inline VectorLanes keep(simd::Mask m, const VectorLanes& v) noexcept {
  return {keep(m, v.x), keep(m, v.y), keep(m, v.z)};
}

/// Unit vectors along which the members scatter least about their centroid, turned `towards` something; zeros where
/// they lie on a line, or in one place.
[[nodiscard]] inline VectorLanes normals_of(const Moments& m, const MomentScale& by,
                                            const VectorLanes& towards) noexcept {
  using simd::all;
  using simd::F32;
  const F32 members = to_float(m.members);
  const F32 x = to_float(m.x);
  const F32 y = to_float(m.y);
  const F32 z = to_float(m.z);
  const F32 weight = all(1.0f) / (members * all(by.scale));
  const F32 mean_x = x * weight;
  const F32 mean_y = y * weight;
  const F32 mean_z = z * weight;
  const EigenLanes eigen =
      decompose_lanes({to_float(m.xx) - x * mean_x, to_float(m.xy) - x * mean_y, to_float(m.xz) - x * mean_z,
                       to_float(m.yy) - y * mean_y, to_float(m.yz) - y * mean_z, to_float(m.zz) - z * mean_z});
  // What float can tell apart, and what the rounding of the members to integers may have moved.
  const F32 resolution = all(1e-6f) * eigen.values[2] + all(4.0f) * members;
  const simd::Mask flat = eigen.values[1] - eigen.values[0] > resolution;
  const F32(&axis)[3] = eigen.vectors[0];
  const simd::Mask away = (axis[0] * towards.x + axis[2] * towards.z) + axis[1] * towards.y < all(0.0f);
  const auto turned = [&](int k) { return negate(away, axis[k]) + all(0.0f); };  // no negative zeros
  return keep(flat, VectorLanes{turned(0), turned(1), turned(2)});
}

/// The normal in one lane.
[[nodiscard]] inline Normal normal_in(const VectorLanes& v, std::size_t lane) noexcept {
  float components[3][simd::lanes];
  simd::store(components[0], v.x);
  simd::store(components[1], v.y);
  simd::store(components[2], v.z);
  return {components[0][lane], components[1][lane], components[2][lane]};
}

[[nodiscard]] inline bool is_zero(const Normal& n) noexcept { return n.x == 0.0f && n.y == 0.0f && n.z == 0.0f; }

}  // namespace detail

/// The normal of the plane through a gathered neighbourhood: the direction in which the neighbours within `radius`
/// scatter least about their centroid, the key point and its copies among them. Source: PCL 1.13's NormalEstimation.
///
/// `radius` may be smaller than the one the neighbourhood was gathered with.
/// `towards_viewpoint`, if not null, is a vector (3 floats, any length) from the key point to the camera, to whose side
/// the normal is turned. If it is null or at right angles to the normal, the sign is the solver's: arbitrary, but the
/// same on every machine.
///
/// Statuses: bad_radius; bad_viewpoint (not finite); too_many_neighbors (more than 2^24); too_few_neighbors (fewer than
/// three); ambiguous_frame (the two smaller extents are equal within float resolution: the neighbours lie on a line, or
/// in one place). `normal` is zeroed then. No allocation, reentrant. The result does not depend on the order of the
/// neighbours.
[[nodiscard]] inline Status estimate_normal(const Neighborhood& n, Radius radius, const float* towards_viewpoint,
                                            Normal& normal) noexcept {
  normal = Normal{};
  const Status usable = check(radius);
  if (usable != Status::ok) return usable;
  if (n.size > max_neighbors) return Status::too_many_neighbors;
  float view[3] = {};
  for (int k = 0; k < 3 && towards_viewpoint != nullptr; ++k) view[k] = towards_viewpoint[k];
  if (!math::is_finite(view)) return Status::bad_viewpoint;

  const detail::VectorLanes towards{simd::all(view[0]), simd::all(view[1]), simd::all(view[2])};
  detail::MomentScale scale = detail::plain_scale(radius);
  if (n.size <= detail::max_plain_members) {
    const detail::Moments moments = detail::moments_of(n, radius, scale);
    if (any(detail::is_fine(moments, scale))) {
      normal = detail::normal_in(detail::normals_of(moments, scale, towards), 0);
      if (!detail::is_zero(normal)) return Status::ok;
    }
  }
  scale = detail::finest_scale(n, radius);
  const detail::Moments moments = detail::moments_of(n, radius, scale);
  if (any(simd::all_int(min_normal_neighbors) > moments.members)) return Status::too_few_neighbors;
  normal = detail::normal_in(detail::normals_of(moments, scale, towards), 0);
  return detail::is_zero(normal) ? Status::ambiguous_frame : Status::ok;
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
