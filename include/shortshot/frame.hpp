// shortshot/frame.hpp: the SHOT local reference frame of a gathered neighbourhood.
#pragma once

#include <cstdint>

#include "config.hpp"
#include "fixed_point.hpp"
#include "math.hpp"
#include "neighborhood.hpp"
#include "ranking.hpp"
#include "simd.hpp"
#include "status.hpp"
#include "symmetric_eigen.hpp"

namespace shortshot {

/// A local reference frame: three orthonormal axes in the cloud's coordinates, right-handed. Trivial type.
struct Frame {
  float x[3];
  float y[3];
  float z[3];
};

inline namespace SHORTSHOT_ISA {

/// Fewest neighbours (other than the key point and its copies) for a frame, as in PCL.
inline constexpr int min_frame_neighbors = 5;

[[nodiscard]] inline float dot(const float (&a)[3], const float (&b)[3]) noexcept {
  return (a[0] * b[0] + a[2] * b[2]) + a[1] * b[1];
}

/// Is this a frame one can describe in: finite, and orthonormal within 1e-3?
[[nodiscard]] inline Status check(const Frame& frame) noexcept {
  if (!math::is_finite(frame.x) || !math::is_finite(frame.y) || !math::is_finite(frame.z)) return Status::bad_frame;
  const auto near = [](float value, float target) { return value > target - 1e-3f && value < target + 1e-3f; };
  const bool orthonormal = near(dot(frame.x, frame.x), 1.0f) && near(dot(frame.y, frame.y), 1.0f) &&
                           near(dot(frame.z, frame.z), 1.0f) && near(dot(frame.x, frame.y), 0.0f) &&
                           near(dot(frame.x, frame.z), 0.0f) && near(dot(frame.y, frame.z), 0.0f);
  return orthonormal ? Status::ok : Status::bad_frame;
}

namespace detail {

inline void negate(float (&axis)[3]) noexcept {
  for (float& component : axis) component = 0.0f - component;
}

/// Pass 1: how far the members reach, as the squared distance of the farthest one.
[[nodiscard]] inline float farthest_member_d2(const Neighborhood& n, Radius radius) noexcept {
  simd::F32 farthest = simd::all(0.0f);
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const Offsets v = load_offsets(n, i);
    farthest = simd::max(farthest, keep(are_members(v, radius), v.d2));
  }
  return simd::largest(farthest);
}

/// How members are brought to fixed point: coordinates times `unit`, a power of two (so that nothing is rounded) that
/// makes the farthest one 1/2 to 1 long, and weights times `scale`.
struct MemberScale {
  float unit;
  float scale;
};

[[nodiscard]] inline MemberScale member_scale(std::uint32_t n, float farthest_d2, Radius radius) noexcept {
  // Below 1e-19 m squares are lost to underflow: such members count as if they were at the key point.
  const float root = simd::root(farthest_d2);
  const float farthest = root > 1e-19f ? root : 1e-19f;
  const float unit = 0.5f / math::power_of_two_below(farthest);
  // The largest w |v|^2 with w = 1 - |v| / R: at |v| = 2/3 R, or at the farthest member if that is closer.
  const float place = 3.0f * farthest > 2.0f * radius.value ? radius.value * 0.6667f : farthest;
  float bound = (1.0f - place / radius.value) * (place * unit) * (place * unit);
  int bits = 0;
  for (; bound < 0.49f && bits > -4; bound *= 2.0f) --bits;
  return {unit, fixed_point_scale(n, bits)};
}

/// Pass 2: sum of w v v^T over the members (PCL's matrix but for its scale, which moves no eigenvector).
struct WeightedScatter {
  Symmetric3 matrix;
  int members;
};

[[nodiscard]] inline WeightedScatter weighted_scatter(const Neighborhood& n, Radius radius) noexcept {
  using simd::all;
  const MemberScale to = member_scale(n.size, farthest_member_d2(n, radius), radius);
  const simd::F32 unit = all(to.unit);
  const simd::F32 inverse = all(1.0f / radius.value);
  simd::I32 xx{}, xy{}, xz{}, yy{}, yz{}, zz{}, members{};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const Offsets v = load_offsets(n, i);
    const simd::Mask member = are_members(v, radius);
    const simd::F32 x = keep(member, v.dx) * unit;
    const simd::F32 y = keep(member, v.dy) * unit;
    const simd::F32 z = keep(member, v.dz) * unit;
    const simd::F32 w = (all(1.0f) - simd::sqrt(keep(member, v.d2)) * inverse) * all(to.scale);
    const simd::F32 wx = w * x;
    const simd::F32 wy = w * y;
    xx = xx + round_to_int(wx * x);
    xy = xy + round_to_int(wx * y);
    xz = xz + round_to_int(wx * z);
    yy = yy + round_to_int(wy * y);
    yz = yz + round_to_int(wy * z);
    zz = zz + round_to_int(w * z * z);
    members = members + ones(member);
  }
  const auto total = [](simd::I32 lanes) { return static_cast<float>(sum(lanes)); };
  return {{total(xx), total(xy), total(xz), total(yy), total(yz), total(zz)}, sum(members)};
}

/// Pass 3: how many members have v . axis >= 0.
[[nodiscard]] inline int votes_for(const Neighborhood& n, Radius radius, const float (&axis)[3]) noexcept {
  using simd::all;
  simd::I32 votes{};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const Offsets v = load_offsets(n, i);
    const simd::F32 along = (v.dx * all(axis[0]) + v.dz * all(axis[2])) + v.dy * all(axis[1]);
    votes = votes + ones((along >= all(0.0f)) & are_members(v, radius));
  }
  return sum(votes);
}

/// PCL's answer to a tied vote: of the five members in the middle of the order by distance, do at least three have
/// v . axis > 0?
[[nodiscard]] inline bool middle_votes_for(const Neighborhood& n, Radius radius, int members,
                                           const float (&axis)[3]) noexcept {
  int votes = 0;
  std::uint32_t i = member_of_rank(n, radius, members / 2 - 2);
  for (int k = 0; k < 5 && i < n.size; ++k) {
    const float v[3] = {n.dx[i], n.dy[i], n.dz[i]};
    votes += dot(v, axis) > 0.0f ? 1 : 0;
    i = next_member(n, radius, {n.d2[i], n.index[i]});
  }
  return votes >= 3;
}

/// Turn an axis towards the majority of the members.
inline void orient_by_vote(const Neighborhood& n, Radius radius, int members, float (&axis)[3]) noexcept {
  const int votes = votes_for(n, radius, axis);
  const bool keep = 2 * votes == members ? middle_votes_for(n, radius, members, axis) : 2 * votes > members;
  if (!keep) negate(axis);
}

}  // namespace detail

/// SHOT's local reference frame of a gathered neighbourhood: x along the largest and z along the smallest principal
/// axis of the members, weighted by R - |v| and centred on the key point, each turned towards the majority of the
/// members; y = z cross x. Source: PCL 1.13's SHOTLocalReferenceFrameEstimation, its rule for ties included.
///
/// `radius` is the frame's own; it may be smaller than the one the neighbourhood was gathered with.
/// `towards_viewpoint`, if not null, is a vector (3 floats, any length) from the key point to the camera: z is turned
/// to it and only x by vote. Every depth camera knows it, and it makes frames more repeatable; null is SHOT.
///
/// Statuses: bad_radius; bad_viewpoint (not finite); too_many_neighbors (more than 2^24); too_few_neighbors (fewer than
/// five members); ambiguous_frame (two principal axes equal within float resolution: collinear or symmetric
/// neighbourhoods). `frame` is zeroed then. On an exactly planar neighbourhood all members lie at z = 0 and the sign of
/// z is the solver's unless a viewpoint is given. No allocation, reentrant. The result does not depend on the order of
/// the neighbours.
[[nodiscard]] inline Status estimate_frame(const Neighborhood& n, Radius radius, Frame& frame,
                                           const float* towards_viewpoint = nullptr) noexcept {
  frame = Frame{};
  const Status usable = check(radius);
  if (usable != Status::ok) return usable;
  if (n.size > max_neighbors) return Status::too_many_neighbors;
  float view[3] = {};
  for (int k = 0; k < 3 && towards_viewpoint != nullptr; ++k) view[k] = towards_viewpoint[k];
  if (!math::is_finite(view)) return Status::bad_viewpoint;
  const detail::WeightedScatter scatter = detail::weighted_scatter(n, radius);
  if (scatter.members < min_frame_neighbors) return Status::too_few_neighbors;

  const detail::Eigen3 eigen = detail::decompose(scatter.matrix);
  // What float can tell apart, and what the rounding of the members to integers may have moved.
  const float resolution = 1e-6f * eigen.values[2] + 0.5f * static_cast<float>(scatter.members);
  if (!(eigen.values[2] - eigen.values[1] > resolution && eigen.values[1] - eigen.values[0] > resolution)) {
    return Status::ambiguous_frame;
  }

  for (int k = 0; k < 3; ++k) {
    frame.x[k] = eigen.vectors[2][k];
    frame.z[k] = eigen.vectors[0][k];
  }
  detail::orient_by_vote(n, radius, scatter.members, frame.x);
  const float towards = dot(view, frame.z);
  if (towards == 0.0f) {  // no viewpoint, or one that does not tell
    detail::orient_by_vote(n, radius, scatter.members, frame.z);
  } else if (towards < 0.0f) {
    detail::negate(frame.z);
  }
  frame.y[0] = frame.z[1] * frame.x[2] - frame.z[2] * frame.x[1];
  frame.y[1] = frame.z[2] * frame.x[0] - frame.z[0] * frame.x[2];
  frame.y[2] = frame.z[0] * frame.x[1] - frame.z[1] * frame.x[0];
  return Status::ok;
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
