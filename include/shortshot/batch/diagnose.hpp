// shortshot/batch/diagnose.hpp: numbers that cannot work are named: units, radii, searches, normals, colors. Hosted
// only: allocates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../cloud/cloud.hpp"
#include "../cloud/keypoint.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../kernel/support.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../search/search.hpp"
#include "../status.hpp"
#include "extractor.hpp"
#include "growing_workspace.hpp"
#include "plausible.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What diagnose() sees. Shares are 0 to 1, lengths are in the cloud's unit. Trivially copyable.
struct Diagnosis {
  Status status;       ///< ok; or why nothing more can be said (all that extract() says of a cloud, a search and radii)
  float not_finite;    ///< share of the points that are no measurement: NaN or infinite
  float at_origin;     ///< share of the points at (0, 0, 0): many of them mean "no measurement"
  Point low;           ///< least coordinates of the valid points that are not at the origin
  Point high;          ///< largest ones
  bool one_color;      ///< there are colors, and they are the same at all points
  float no_normal;     ///< share of the valid points that have no normal; 1 if the cloud has none
  float other_length;  ///< share of the normals whose length is not 1, within a hundredth

  std::size_t sampled;     ///< points that were looked at for what follows, at most 1000; none at the origin
  float float_step;        ///< median distance of floats at their largest coordinates: what these cannot tell apart
  float spacing;           ///< median distance to the nearest point elsewhere; 0 if there is none near
  float doubles;           ///< share of them on which another point lies exactly
  float neighbors;         ///< median number within the support's radius, the point itself included
  float few_neighbors;     ///< share of them with fewer than five others there: too few for a frame
  float no_frame;          ///< share of them without a frame, for whatever reason
  float frame_confidence;  ///< median of confidence() of the others

  std::size_t off_surface;  ///< key points without a point within a quarter of the radius, or twice the spacing
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The lower one of the two in the middle; 0 of none.
[[nodiscard]] inline float median(std::vector<float>& values) noexcept {
  if (values.empty()) return 0.0f;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

[[nodiscard]] inline float share(std::size_t part, std::size_t whole) noexcept {
  return whole == 0 ? 0.0f : static_cast<float>(part) / static_cast<float>(whole);
}

[[nodiscard]] inline bool is_at_origin(const Point& p) noexcept { return p.x == 0.0f && p.y == 0.0f && p.z == 0.0f; }

/// The first half: everything that one look at each point tells.
inline void look_at_all(const CloudView& cloud, Diagnosis& out) noexcept {
  std::size_t valid = 0;
  std::size_t at_origin = 0;
  std::size_t with_normal = 0;
  std::size_t of_other_length = 0;
  bool is_first = true;
  for_each_valid(cloud, [&](std::size_t i, const Point& p) {
    ++valid;
    if (has_normals(cloud)) {
      const SurfaceNormal n = normal(cloud, i);
      const float squared = squared_distance({n.x, n.y, n.z}, {});
      const bool is_there = math::is_finite(squared) && squared > 0.0f;
      if (is_there) ++with_normal;
      if (is_there && !(squared > 0.98f && squared < 1.02f)) ++of_other_length;
    }
    if (is_at_origin(p)) {
      ++at_origin;
      return;
    }
    out.low = is_first ? p : Point{std::min(out.low.x, p.x), std::min(out.low.y, p.y), std::min(out.low.z, p.z)};
    out.high = is_first ? p : Point{std::max(out.high.x, p.x), std::max(out.high.y, p.y), std::max(out.high.z, p.z)};
    is_first = false;
  });
  out.not_finite = share(cloud.size - valid, cloud.size);
  out.at_origin = share(at_origin, cloud.size);
  out.no_normal = 1.0f - share(with_normal, valid);
  out.other_length = share(of_other_length, with_normal);
  out.one_color = has_colors(cloud);
  for (std::size_t i = 1; i < cloud.size && out.one_color; ++i) {
    const Rgb a = color(cloud, 0);
    const Rgb b = color(cloud, i);
    out.one_color = a.r == b.r && a.g == b.g && a.b == b.b;
  }
}

/// The second half: the neighborhoods of some points.
template <class Search>
class Examination {
 public:
  Examination(const CloudView& cloud, const Search& neighbors, const Support& support) noexcept
      : cloud_(cloud), search_(neighbors), support_(support) {}

  void look_at_some(Diagnosis& out) {
    std::size_t looked_at = 0;  // neighbors
    const std::size_t tries = std::min(cloud_.size, 2 * most_samples);
    for (std::size_t k = 0; k < tries && out.sampled < most_samples; ++k) {
      if (out.sampled >= least_samples && looked_at > most_neighbors) break;
      const Point p = point(cloud_, tries == cloud_.size ? k : scattered(k));
      if (!is_finite(p) || is_at_origin(p)) continue;
      Neighborhood n;
      const Status status = workspace_.gather(search_, p, gather_radius(support_), n);
      if (status == Status::ok && (n.found == 0 || !is_of(cloud_, p, n))) out.status = Status::other_cloud;
      if (out.status != Status::ok) return;
      looked_at += n.size;
      ++out.sampled;
      steps_.push_back(float_spacing(p));
      if (status == Status::ok) look_at(p, n);
    }
    out.float_step = median(steps_);
    out.spacing = median(spacings_);
    out.doubles = share(doubles_, out.sampled);
    out.neighbors = median(counts_);
    out.few_neighbors = share(few_, out.sampled);
    out.no_frame = 1.0f - share(confidences_.size(), out.sampled);
    out.frame_confidence = median(confidences_);
  }

  [[nodiscard]] bool has_point_within(const Point& p, Radius radius) {
    Neighborhood n;
    return is_finite(p) && (workspace_.gather(search_, p, radius, n) != Status::ok || n.found > 0);
  }

 private:
  static constexpr std::size_t most_samples = 1000;
  static constexpr std::size_t least_samples = 32;
  static constexpr std::size_t most_neighbors = 10000000;

  /// Points all over the cloud, whatever their order: multiples of the golden ratio.
  [[nodiscard]] std::size_t scattered(std::size_t k) const noexcept {
    const auto turn = static_cast<std::uint32_t>(k) * 2654435769u;
    return static_cast<std::size_t>(std::uint64_t{turn} * cloud_.size >> 32);
  }

  void look_at(const Point& p, Neighborhood& n) {
    const std::uint32_t within = count_within(n, support_.radius);
    counts_.push_back(static_cast<float>(within));
    if (within <= 5) ++few_;
    Frame frame;
    FrameConfidence sure;
    if (estimate_frame(n, support_.frame_radius, frame, sure, support_.viewpoint) == Status::ok) {
      confidences_.push_back(confidence(sure));
    }
    if (std::count(n.d2, n.d2 + n.size, 0.0f) > 1) ++doubles_;
    look_for_nearest(p, n);
  }

  /// In spheres that grow, at few points, where the support holds none elsewhere.
  void look_for_nearest(const Point& p, Neighborhood& n) {
    Radius radius = gather_radius(support_);
    for (int doubled = 0; doubled <= 16; ++doubled) {
      float nearest = radius.squared;
      for (std::uint32_t i = 0; i < n.size; ++i) {
        if (n.d2[i] > 0.0f) nearest = std::min(nearest, n.d2[i]);
      }
      if (nearest < radius.squared) return spacings_.push_back(simd::sqrt(nearest));
      radius = Radius(2.0f * radius.value);
      if (wide_searches_ >= least_samples * 16 || validate(radius) != Status::ok) return;
      ++wide_searches_;
      if (workspace_.gather(search_, p, radius, n) != Status::ok) return;
    }
  }

  const CloudView cloud_;
  const Search& search_;
  const Support support_;
  GrowingWorkspace workspace_;
  std::vector<float> steps_;
  std::vector<float> spacings_;
  std::vector<float> counts_;
  std::vector<float> confidences_;
  std::size_t doubles_ = 0;
  std::size_t few_ = 0;
  std::size_t wide_searches_ = 0;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Looks at what is about to be described: is the search one over this cloud, has the radius the cloud's unit, can
/// float hold its coordinates, are there points that are none? Numbers for a program to check once, when a sensor or a
/// data set is new; the demo's option `--diagnose` says in sentences what they mean.
///
/// `keypoints`  what will be described, as for extract(); an index outside of the cloud counts as off the surface
///
/// Looks once at each point, at the neighborhoods of 1000 points (fewer, but 32 at least, once ten million neighbors
/// were seen), always the same ones, and near each key point. Allocates 20 KB, and 30 bytes for each neighbor of the
/// largest neighborhood; may throw std::bad_alloc. Reentrant; starts no threads.
template <class Search, class Key = std::uint32_t>
[[nodiscard]] Diagnosis diagnose(const CloudView& cloud, const Search& search, const Support& support,
                                 const std::vector<Key>& keypoints = {}) {
  Diagnosis out{};
  out.status = detail::validate_search(cloud, search);
  if (out.status == Status::ok) out.status = validate(support.radius);
  if (out.status == Status::ok) out.status = validate(support.frame_radius);
  if (out.status == Status::ok) out.status = validate(support.viewpoint);
  if (out.status != Status::ok) return out;
  detail::look_at_all(cloud, out);
  detail::Examination<Search> examination(cloud, search, support);
  examination.look_at_some(out);
  if (out.status != Status::ok) return out;
  const Radius near = std::max(0.25f * support.radius.value, 2.0f * out.spacing);
  for (std::size_t row = 0; row < keypoints.size(); ++row) {
    KeyPoint key;
    const bool exists = detail::keypoint_at(cloud, keypoints, row, key);
    if (!exists || !examination.has_point_within(key.position, near)) ++out.off_surface;
  }
  return out;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
