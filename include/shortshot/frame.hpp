// shortshot/frame.hpp: the SHOT local reference frame of a gathered neighbourhood.
#pragma once

#include <cstdint>

#include "config.hpp"
#include "fixed_point.hpp"
#include "math.hpp"
#include "neighborhood.hpp"
#include "ranking.hpp"
#include "rounded.hpp"
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
  return (rounded(a[0] * b[0]) + rounded(a[2] * b[2])) + rounded(a[1] * b[1]);
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

/// A neighbour within the frame's radius is a member, unless it is a copy of the key point. Copies move no sum; where
/// members are counted, the copies' number is taken off.
[[nodiscard]] inline simd::Mask within(const Offsets& v, Radius radius) noexcept {
  return v.d2 < simd::all(radius.squared);
}

/// Pass 1: how far the members reach, as the squared distance of the farthest one, and how many there are.
struct Census {
  float farthest_d2;
  int members;
  int copies;  ///< of the key point, with those that fill up the last register
};

[[nodiscard]] inline Census take_census(const Neighborhood& n, Radius radius) noexcept {
  const simd::F32 zero = simd::all(0.0f);
  simd::F32 farthest = zero;
  simd::I32 inside{}, copies{};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const Offsets v = load_offsets(n, i);
    const simd::Mask near = within(v, radius);
    farthest = simd::max(farthest, keep(near, v.d2));
    inside = increment(near, inside);
    if (any(zero >= v.d2)) {  // seldom: the key point itself, and whatever is so close that its square is lost
      const simd::Mask apart = (v.dx != zero) | (v.dy != zero) | (v.dz != zero);
      copies = increment(near ^ (near & apart), copies);
    }
  }
  const int not_members = sum(copies);
  return {simd::largest(farthest), sum(inside) - not_members, not_members};
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
[[nodiscard]] inline Symmetric3 weighted_scatter(const Neighborhood& n, Radius radius, float farthest_d2) noexcept {
  using simd::all;
  using simd::F32;
  const MemberScale to = member_scale(n.size, farthest_d2, radius);
  const F32 unit = all(to.unit);
  const F32 scale = all(to.scale);
  const F32 inverse = all(1.0f / radius.value);
  simd::I32 xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const Offsets v = load_offsets(n, i);
    const F32 x = v.dx * unit;
    const F32 y = v.dy * unit;
    const F32 z = v.dz * unit;
    const F32 w = keep(within(v, radius), (all(1.0f) - simd::sqrt(v.d2) * inverse) * scale);
    const F32 wx = w * x;
    const F32 wy = w * y;
    xx = xx + round_to_int(wx * x);
    xy = xy + round_to_int(wx * y);
    xz = xz + round_to_int(wx * z);
    yy = yy + round_to_int(wy * y);
    yz = yz + round_to_int(wy * z);
    zz = zz + round_to_int(w * z * z);
  }
  const auto total = [](simd::I32 lanes) { return static_cast<float>(sum(lanes)); };
  return {total(xx), total(xy), total(xz), total(yy), total(yz), total(zz)};
}

/// Pass 3: for each of two axes, how many members have v . axis >= 0.
struct AxisVotes {
  int x;
  int z;
};

[[nodiscard]] inline AxisVotes count_votes(const Neighborhood& n, Radius radius, int copies, const float (&x)[3],
                                           const float (&z)[3]) noexcept {
  using simd::all;
  using simd::F32;
  const F32 x_axis[3] = {all(x[0]), all(x[1]), all(x[2])};
  const F32 z_axis[3] = {all(z[0]), all(z[1]), all(z[2])};
  simd::I32 for_x{}, for_z{};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const Offsets v = load_offsets(n, i);
    const simd::Mask near = within(v, radius);
    const F32 along_x = (v.dx * x_axis[0] + v.dz * x_axis[2]) + v.dy * x_axis[1];
    const F32 along_z = (v.dx * z_axis[0] + v.dz * z_axis[2]) + v.dy * z_axis[1];
    for_x = increment((along_x >= all(0.0f)) & near, for_x);
    for_z = increment((along_z >= all(0.0f)) & near, for_z);
  }
  return {sum(for_x) - copies, sum(for_z) - copies};
}

/// PCL's answer to a tied vote: of the five members in the middle of the order by distance, do at least three have
/// v . axis > 0?
[[nodiscard]] inline bool middle_votes_for(const Neighborhood& n, Radius radius, const Census& census,
                                           const float (&axis)[3]) noexcept {
  int votes = 0;
  std::uint32_t i = member_of_rank(n, radius, census.members / 2 - 2);
  for (int k = 0; k < 5 && i < n.size; ++k) {
    const float v[3] = {n.dx[i], n.dy[i], n.dz[i]};
    votes += dot(v, axis) > 0.0f ? 1 : 0;
    i = next_member(n, radius, {n.d2[i], n.index[i]});
  }
  return votes >= 3;
}

/// Turn an axis towards the majority of the members.
inline void orient_by_vote(const Neighborhood& n, Radius radius, const Census& census, int votes,
                           float (&axis)[3]) noexcept {
  const bool tied = 2 * votes == census.members;
  const bool keep = tied ? middle_votes_for(n, radius, census, axis) : 2 * votes > census.members;
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
  float view[3] = {};
  const Status usable = detail::check_estimate(n, radius, towards_viewpoint, view);
  if (usable != Status::ok) return usable;
  const detail::Census census = detail::take_census(n, radius);
  if (census.members < min_frame_neighbors) return Status::too_few_neighbors;

  const detail::Eigen3 eigen = detail::decompose(detail::weighted_scatter(n, radius, census.farthest_d2));
  // What float can tell apart, and what the rounding of the members to integers may have moved.
  const float resolution = rounded(1e-6f * eigen.values[2]) + rounded(0.5f * static_cast<float>(census.members));
  if (!(eigen.values[2] - eigen.values[1] > resolution && eigen.values[1] - eigen.values[0] > resolution)) {
    return Status::ambiguous_frame;
  }

  for (int k = 0; k < 3; ++k) {
    frame.x[k] = eigen.vectors[2][k];
    frame.z[k] = eigen.vectors[0][k];
  }
  const detail::AxisVotes votes = detail::count_votes(n, radius, census.copies, frame.x, frame.z);
  detail::orient_by_vote(n, radius, census, votes.x, frame.x);
  const float towards = dot(view, frame.z);
  if (towards == 0.0f) {  // no viewpoint, or one that does not tell
    detail::orient_by_vote(n, radius, census, votes.z, frame.z);
  } else if (towards < 0.0f) {
    detail::negate(frame.z);
  }
  frame.y[0] = rounded(frame.z[1] * frame.x[2]) - rounded(frame.z[2] * frame.x[1]);
  frame.y[1] = rounded(frame.z[2] * frame.x[0]) - rounded(frame.z[0] * frame.x[2]);
  frame.y[2] = rounded(frame.z[0] * frame.x[1]) - rounded(frame.z[1] * frame.x[0]);
  return Status::ok;
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
