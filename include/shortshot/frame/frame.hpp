// shortshot/frame/frame.hpp: the SHOT local reference frame of a gathered neighborhood.
#ifndef SHORTSHOT_FRAME_FRAME_HPP
#define SHORTSHOT_FRAME_FRAME_HPP

#include <cstdint>

#include "../base/fixed_point.hpp"
#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../base/symmetric_eigen.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../cloud/point_lanes.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "rank_by_distance.hpp"
#include "viewpoint.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A local reference frame: three orthonormal axes in the cloud's coordinates, right-handed. Trivial type.
struct Frame {
  float x[3];  ///< in SHOT: along the surface, where more points are
  float y[3];  ///< z cross x
  float z[3];  ///< in SHOT: the normal, where more points are
};

/// How clear the decisions were that made a frame; confidence() makes one number of them. Zeros: there is no frame, or
/// something was decided by a hair. Trivial type.
struct FrameConfidence {
  float eigenvalue_gap;  ///< 0 to 1: 1 - l2 / l1 of the two largest eigenvalues, l1 >= l2: how unique the line of x is
  float x_margin;        ///< 0 to 1/2: the share of the members on the side that x points to, less 1/2; 0: a tie
  float z_margin;        ///< the same of z; 1/2 where a viewpoint told, which outvotes all members
};

/// Fewest neighbors (other than the key point and its copies) for a frame, as in PCL.
inline constexpr int min_frame_neighbors = 5;

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// How sure a frame is, 0 to 1: the least of the eigenvalues' gap and twice either margin. It ranks frames of one
/// radius and is no probability. On generated noisy surfaces, where 15 % of all frames were more than 37 degrees off,
/// 2 % of the surer half were; on surfaces that are flat but for their noise it tells little.
[[nodiscard]] inline float confidence(const FrameConfidence& of) noexcept {
  const float margin = 2.0f * (of.x_margin < of.z_margin ? of.x_margin : of.z_margin);
  return margin < of.eigenvalue_gap ? margin : of.eigenvalue_gap;
}

/// Is this a frame one can describe in: finite, and orthonormal within 1e-3?
[[nodiscard]] inline Status validate(const Frame& frame) noexcept {
  const float(*const axes[3])[3] = {&frame.x, &frame.y, &frame.z};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k <= i; ++k) {
      const float error = extend::dot(*axes[i], *axes[k]) - (i == k ? 1.0f : 0.0f);
      if (!extend::math::is_finite(error) || !(error > -1e-3f && error < 1e-3f)) return Status::bad_frame;
    }
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Members, those who make a frame, lie strictly inside its radius and not at the key point itself: the key point and
/// its copies move no sum, but must not be counted.
[[nodiscard]] inline simd::Mask within(const NeighborLanes& v, Radius radius) noexcept {
  return v.d2 < simd::all(radius.squared);
}
[[nodiscard]] inline simd::Mask is_elsewhere(const NeighborLanes& v) noexcept {
  return simd::abs(v.dx) + simd::abs(v.dy) + simd::abs(v.dz) > simd::all(0.0f);
}

/// Pass 1: how far the members reach, as the squared distance of the farthest one, and how many there are.
struct Census {
  float farthest_d2;
  int members;
};

template <class Neighbors>
[[nodiscard]] inline Census take_census(const Neighbors& n, Radius radius) noexcept {
  simd::F32 farthest = simd::all(0.0f);
  simd::I32 members{};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    simd::F32 d2;
    simd::Mask member;
    if constexpr (simd::lanes == 1) {
      const NeighborLanes v = load_neighbors(n, i);
      d2 = v.d2;
      member = within(v, radius);
      if (small_code || any(simd::all(0.0f) >= d2)) member = member & is_elsewhere(v);  // seldom
      if (!any(member)) continue;
    } else {
      d2 = load_d2(n, i);
      member = d2 < simd::all(radius.squared);
      if (any(simd::all(0.0f) >= d2)) member = member & is_elsewhere(load_neighbors(n, i));  // seldom
    }
    farthest = simd::max(farthest, keep(member, d2));
    members = increment(member, members);
  }
  return {simd::largest(farthest), sum(members)};
}

/// How members are brought to fixed point: coordinates times `unit`, a power of two (so that nothing is rounded) that
/// makes the farthest one 1/2 to 1 long, and weights times `scale`.
struct MemberScale {
  float unit;
  float scale;
};

[[nodiscard]] inline MemberScale member_scale(std::uint32_t n, float farthest_d2, Radius radius) noexcept {
  // Below 1e-19 m squares are lost to underflow: such members count as if they were at the key point.
  const float root = simd::sqrt(farthest_d2);
  const float farthest = root > 1e-19f ? root : 1e-19f;
  const float unit = 0.5f / math::power_of_two_below(farthest);
  // The largest w |v|^2 with w = 1 - |v| / R: at |v| = 2/3 R, or at the farthest member if that is closer.
  const float largest_at = radius.value * 0.6667f;
  const float place = farthest > largest_at ? largest_at : farthest;
  float bound = (1.0f - place / radius.value) * (place * unit) * (place * unit);
  float scale = fixed_point_scale(n);
  for (int bits = 0; bound < 0.49f && bits < 4; ++bits, bound *= 2.0f) scale *= 2.0f;
  return {unit, scale};
}

/// Pass 2: sum of w v v^T over the members (PCL's matrix but for its scale, which moves no eigenvector).
template <class Neighbors>
[[nodiscard]] inline SymmetricLanes weighted_scatter(const Neighbors& n, Radius radius, float farthest_d2) noexcept {
  using simd::all;
  using simd::F32;
  const MemberScale to = member_scale(n.size, farthest_d2, radius);
  const F32 unit = all(to.unit);
  const F32 scale = all(to.scale);
  const F32 inverse = all(1.0f / radius.value);
  simd::I32 sums[6] = {};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const NeighborLanes v = load_neighbors(n, i);
    const F32 at[3] = {v.dx * unit, v.dy * unit, v.dz * unit};
    const F32 w = keep(within(v, radius), (all(1.0f) - simd::sqrt(v.d2) * inverse) * scale);
    simd::I32* entry = sums;  // of the upper triangle, row by row
    each<3>([&](auto row) SHORTSHOT_INLINE_LAMBDA {
      const F32 weighted = w * at[row];
      each<3>([&](auto column) SHORTSHOT_INLINE_LAMBDA {
        if (column < row) return;
        *entry = *entry + round_to_int(weighted * at[column]);
        ++entry;
      });
    });
  }
  SymmetricLanes total;
  each<6>([&](auto k) { total.entry[k] = all(static_cast<float>(sum(sums[k]))); });
  return total;
}

/// Pass 3: for each of two axes, how many members have v . axis < 0.
struct AxisVotes {
  int x;
  int z;
};

template <class Neighbors>
[[nodiscard]] inline AxisVotes count_votes_against(const Neighbors& n, Radius radius, const float (&x)[3],
                                                   const float (&z)[3]) noexcept {
  using simd::all;
  simd::I32 against_x{}, against_z{};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const NeighborLanes v = load_neighbors(n, i);
    const simd::Mask near = within(v, radius);
    const PointLanes offset{v.dx, v.dy, v.dz};
    against_x = increment((along(x, offset) < all(0.0f)) & near, against_x);
    against_z = increment((along(z, offset) < all(0.0f)) & near, against_z);
  }
  return {sum(against_x), sum(against_z)};
}

/// PCL's answer to a tied vote: of the five members in the middle of the order by distance, do at least three have
/// v . axis > 0?
template <class Neighbors>
[[nodiscard]] inline bool middle_votes_for(const Neighbors& n, int members, const float (&axis)[3]) noexcept {
  const int rank = count_before(n, 1) + members / 2 - 2;  // behind the key point and its copies
  const Place first = place_of_rank(n, rank);
  const Place end = place_of_rank(n, rank + 5);
  int votes = 0;
  for (std::uint32_t i = 0; i < n.size; ++i) {
    if (place_at(n, i) - first >= end - first) continue;
    const Neighbor v = neighbor_at(n, i);
    votes += dot({v.dx, v.dy, v.dz}, axis) > 0.0f ? 1 : 0;
  }
  return votes >= 3;
}

/// Sign disambiguation: turn an axis towards the majority of the members.
template <class Neighbors>
inline void disambiguate_sign(const Neighbors& n, int members, int against, float (&axis)[3]) noexcept {
  const int lead = 2 * against - members;
  if (lead == 0 ? middle_votes_for(n, members, axis) : lead < 0) return;
  for (float& component : axis) component = 0.0f - component;
}

/// By how much a majority is more than one half.
[[nodiscard]] inline float margin_of(int members, int against) noexcept {
  const int lead = 2 * against - members;
  return static_cast<float>(lead < 0 ? -lead : lead) / static_cast<float>(2 * members);
}

[[nodiscard]] inline FrameConfidence confidence_of(const EigenLanes& eigen, int members, AxisVotes against) noexcept {
  const float gap = 1.0f - simd::largest(eigen.value(1)) / simd::largest(eigen.value(2));
  // What should be zero can be a rounding less.
  return {gap < 1.0f ? gap : 1.0f, margin_of(members, against.x), margin_of(members, against.z)};
}

/// y = z cross x.
[[gnu::always_inline]] inline void set_y(Frame& frame) noexcept {
  frame.y[0] = unfused(frame.z[1] * frame.x[2]) - unfused(frame.z[2] * frame.x[1]);
  frame.y[1] = unfused(frame.z[2] * frame.x[0]) - unfused(frame.z[0] * frame.x[2]);
  frame.y[2] = unfused(frame.z[0] * frame.x[1]) - unfused(frame.z[1] * frame.x[0]);
}

/// estimate_frame() for what was checked before. `view` is the vector to the viewpoint; zeros: there is none.
/// `confidence` is one FrameConfidence, or none: nothing is worked out then, and no code of it is there.
template <class Neighbors, class... Confidence>
[[nodiscard]] inline Status frame_of(const Neighbors& n, Radius radius, const float (&view)[3], Frame& frame,
                                     Confidence&... confidence) noexcept {
  const Census census = take_census(n, radius);
  if (census.members < min_frame_neighbors) return Status::too_few_neighbors;

  const EigenLanes eigen = decompose(weighted_scatter(n, radius, census.farthest_d2));
  // What float can tell apart, and what the rounding of the members to integers may have moved.
  const simd::F32 resolution =
      simd::all(1e-6f) * eigen.value(2) + simd::all(unfused(0.5f * static_cast<float>(census.members)));
  if (!any((eigen.value(2) - eigen.value(1) > resolution) & (eigen.value(1) - eigen.value(0) > resolution))) {
    return Status::ambiguous_frame;
  }

  for (int k = 0; k < 3; ++k) {
    frame.x[k] = simd::largest(eigen.vector(2, k));
    frame.z[k] = simd::largest(eigen.vector(0, k));
  }
  AxisVotes against = count_votes_against(n, radius, frame.x, frame.z);
  const float towards = dot(view, frame.z);
  if (towards != 0.0f) against.z = towards < 0.0f ? census.members : 0;  // a viewpoint that tells outvotes all members
  ((confidence = confidence_of(eigen, census.members, against)), ...);
  disambiguate_sign(n, census.members, against.x, frame.x);
  disambiguate_sign(n, census.members, against.z, frame.z);
  set_y(frame);
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// SHOT's local reference frame (LRF) of a gathered neighborhood: x along the largest and z along the smallest
/// principal axis of the members, weighted by R - |v| and centered on the key point, each turned towards the majority
/// of the members; y = z cross x. Source: PCL 1.13's SHOTLocalReferenceFrameEstimation, its rule for ties included.
///
/// `radius` is the frame's own; it may be smaller than the one the neighborhood was gathered with.
/// `viewpoint` turns z, and only x goes by vote: every depth camera knows where it is, and it makes frames more
/// repeatable. Absent, it is SHOT's frame.
///
/// Statuses: bad_radius; bad_viewpoint (not finite); too_many_neighbors (more than 2^24); too_few_neighbors (fewer than
/// five members); ambiguous_frame (two principal axes equal within float resolution: collinear or symmetric
/// neighborhoods). `frame` is zeroed then. On an exactly planar neighborhood all members lie at z = 0 and the sign of
/// z is the solver's unless a viewpoint is given. No allocation, reentrant. The result does not depend on the order of
/// the neighbors.
template <class Neighbors>
[[nodiscard]] inline Status estimate_frame(const Neighbors& n, Radius radius, Frame& frame,
                                           const Viewpoint& viewpoint = {}) noexcept {
  frame = Frame{};
  float view[3] = {};
  const Status usable = detail::validate_estimate(n, radius, viewpoint, view);
  return usable == Status::ok ? detail::frame_of(n, radius, view, frame) : usable;
}

/// The same frame, and how clear its decisions were: zeros where the status is not ok.
template <class Neighbors>
[[nodiscard]] inline Status estimate_frame(const Neighbors& n, Radius radius, Frame& frame, FrameConfidence& confidence,
                                           const Viewpoint& viewpoint = {}) noexcept {
  frame = Frame{};
  confidence = FrameConfidence{};
  float view[3] = {};
  const Status usable = detail::validate_estimate(n, radius, viewpoint, view);
  return usable == Status::ok ? detail::frame_of(n, radius, view, frame, confidence) : usable;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_FRAME_FRAME_HPP
