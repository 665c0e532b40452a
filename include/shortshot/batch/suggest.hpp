// shortshot/batch/suggest.hpp: lengths that fit a cloud: the support's radius, the leaf of its key points, the radius
// of normals. Hosted only: allocates.
#pragma once

#include <algorithm>
#include <cstddef>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../frame/viewpoint.hpp"
#include "../kernel/support.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "diagnose.hpp"
#include "frame_agreement.hpp"
#include "grid_search.hpp"
#include "plausible.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What suggest() says; lengths are in the cloud's unit. Trivially copyable.
struct Suggestion {
  Status status;          ///< ok; or why there is nothing to suggest, and all else is 0
  float radius;           ///< of the support
  float leaf;             ///< of the key points: half the radius
  float normal_radius;    ///< for SHOT and CSHOT: a quarter of it
  float spacing;          ///< from a point to the nearest one elsewhere, median
  float frame_agreement;  ///< at this radius, see frame_agreement(); negative if there are no frames to compare
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Two digits: nobody wants to type more. 0 for what is no positive number.
[[nodiscard]] inline float in_two_digits(float length) noexcept {
  if (!(length > 0.0f) || !math::is_finite(length)) return 0.0f;
  float tens = 1.0f;  // 10 to 99 of these
  float tenths = 1.0f;
  while (length >= 99.5f * tens) tens *= 10.0f;
  while (length * tenths < 9.95f && tenths < 1e37f) tenths *= 10.0f;
  return __builtin_roundf(length / tens * tenths) / tenths * tens;
}

[[nodiscard]] inline float largest_extent(const Diagnosis& d) noexcept {
  return std::max({d.high.x - d.low.x, d.high.y - d.low.y, d.high.z - d.low.z});
}

/// The median distance from a point to the nearest one, whatever the cloud's unit: as diagnose() sees it. 0 if it sees
/// none.
[[nodiscard]] inline Status find_spacing(const CloudView& cloud, float& extent, float& spacing) {
  extent = spacing = 0.0f;
  Diagnosis d{};
  const Status usable = validate(cloud);
  if (usable != Status::ok) return usable;
  look_at_all(cloud, d);
  if (d.not_finite == 1.0f) return Status::empty_cloud;
  extent = largest_extent(d);
  if (extent > 0.0f && extent < 64.0f * std::max(float_spacing(d.low), float_spacing(d.high))) {
    return Status::coarse_coordinates;
  }
  // Points of a surface that fills its box lie that far apart; where they are sparser the search widens by itself.
  const float guess = extent / simd::sqrt(static_cast<float>(cloud.size));
  if (validate(Radius(guess)) != Status::ok) return Status::bad_radius;
  const GridSearch search(cloud, 2.0f * guess);
  if (search.status() != Status::ok) return search.status();
  Examination<GridSearch>(cloud, search, 2.0f * guess).look_at_some(d);
  spacing = d.spacing;
  if (d.status != Status::ok) return d.status;
  if (!(spacing > 0.0f)) return Status::bad_radius;
  return spacing < 8.0f * d.float_step ? Status::coarse_coordinates : Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Lengths for a cloud of which nothing is known, not even its unit. Another cloud gets others: two clouds that are to
/// be compared, and all views that a recognizer sees, must be described with the same ones.
///
/// The radius is 20 spacings, which hold a thousand points of a surface, as 4 cm do of what a depth camera sees a meter
/// away; at most a third of the cloud's largest extent, beyond which all key points see the same, but 5 spacings at
/// least. Where fewer than half of the frames repeat (frame_agreement()) it grows in two steps up to twice as much, as
/// long as that helps. All in two digits.
///
/// `viewpoint`  what the frames will be turned to
///
/// Statuses: empty_cloud, bad_view, coarse_coordinates and what a GridSearch has; bad_radius where points have no
/// distance: there are fewer than two places. Takes some milliseconds for each 100,000 points. Allocates a GridSearch
/// and a copy of the cloud's coordinates. Reentrant; the same numbers on every machine.
[[nodiscard]] inline Suggestion suggest(const CloudView& cloud, const Viewpoint& viewpoint = {}) {
  Suggestion out{};
  float extent = 0.0f;
  out.status = validate(viewpoint);
  if (out.status == Status::ok) out.status = detail::find_spacing(cloud, extent, out.spacing);
  if (out.status != Status::ok) return {out.status, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  constexpr float enough = 0.5f;
  for (const float times : {1.0f, 1.4f, 2.0f}) {
    const float least = 5.0f * out.spacing;
    const float radius = detail::in_two_digits(std::max(least, std::min(20.0f * times * out.spacing, extent / 3.0f)));
    const float agreement = frame_agreement(cloud, radius, 0.5f * radius, viewpoint);
    if (times == 1.0f || agreement > out.frame_agreement) {
      out.radius = radius;
      out.frame_agreement = agreement;
    }
    if (agreement >= enough) break;
  }
  out.leaf = detail::in_two_digits(0.5f * out.radius);
  out.normal_radius = detail::in_two_digits(0.25f * out.radius);
  return out;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
