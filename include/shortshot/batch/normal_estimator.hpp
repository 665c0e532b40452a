// shortshot/batch/normal_estimator.hpp: the normals of a few points that follow each other, estimated together. Hosted
// only: allocates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../dispatch/widest.hpp"
#include "../frame/normal.hpp"
#include "../frame/normals_together.hpp"
#include "../frame/viewpoint.hpp"
#include "../search/neighborhood.hpp"
#include "../search/pinhole.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "growing_workspace.hpp"
#include "known_normals.hpp"
#include "plausible.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What a thread keeps from block to block.
struct NormalMemory {
  GrowingWorkspace workspace;
  KnownNormals known;
  bool other_cloud = false;  ///< the search has named points that lie elsewhere in the cloud
};

/// Estimates normals of a few points at a time. Points that follow each other in a cloud mostly lie side by side: one
/// search, a little wider, finds the neighbors of all, and what a neighbor adds to moments about their middle is
/// computed once for all of them.
template <class Search>
class NormalEstimator {
 public:
  NormalEstimator(const CloudView& cloud, const Search& search, Radius radius, const Viewpoint& viewpoint,
                  const std::uint8_t* needed, NormalMemory& memory, SurfaceNormal* normals) noexcept
      : cloud_(cloud),
        search_(search),
        radius_(radius),
        viewpoint_(viewpoint),
        needed_(needed),
        memory_(memory),
        normals_(normals) {
    row_ = is_image(cloud) ? cloud.width : 0;
  }

  /// Of the k-th to the one before the end-th point; `normals` has NaN for all of them before.
  void estimate(std::size_t begin, std::size_t end) {
    std::size_t used = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = in_zigzag(k);
      const Point p = point(cloud_, i);
      if (!is_finite(p)) continue;
      index_[used] = i;
      x_[used] = p.x;
      y_[used] = p.y;
      z_[used] = p.z;
      if (++used < group) continue;
      estimate_part(0, group);
      used = 0;
    }
    for (std::size_t k = 0; k < used; ++k) {
      if (is_needed(k, 1)) estimate_alone(k);
    }
  }

 private:
  static constexpr std::size_t group = PlaceGroup::most;
  static constexpr std::size_t smallest_part = 8;
  static constexpr float largest_shared = 1e18f;  // radius: CandidateChunk needs room beyond it
  static_assert(smallest_part % simd::lanes == 0, "whole registers");

  /// The k-th point, where four rows of an image are walked at once: a group then lies in a square.
  [[nodiscard]] std::size_t in_zigzag(std::size_t k) const noexcept {
    constexpr std::size_t rows = 4;
    if (row_ == 0) return k;
    const std::size_t first = k - k % (rows * row_);
    return cloud_.size - first < rows * row_ ? k : first + (k - first) / rows + k % rows * row_;
  }

  /// Is any of these points? Groups are made of all points, needed or not: so normals have the bits that they have
  /// among those of the whole cloud.
  [[nodiscard]] bool is_needed(std::size_t first, std::size_t count) const noexcept {
    if (needed_ == nullptr) return true;
    const std::size_t* const index = index_ + first;
    return std::any_of(index, index + count, [this](std::size_t i) { return needed_[i] != 0; });
  }

  /// Points [first, first + count) of the group, or each half of them if they lie too far apart.
  void estimate_part(std::size_t first, std::size_t count) {
    if (!is_needed(first, count)) return;
    SurfaceNormal found[group] = {};
    const bool one_place = are_in_one_place(first, count);
    const SurfaceNormal* const known =
        one_place ? memory_.known.find(place(first), KnownNormals::Way::together) : nullptr;
    Neighborhood candidates;
    Radius wide = radius_;
    if (known != nullptr) {
      std::fill_n(found + first, count, *known);
    } else if (gather_for_all(first, count, candidates, wide)) {
      const PlaceGroup places{x_ + first, y_ + first, z_ + first, count};
      normals_widest(cloud_, candidates, wide, radius_, viewpoint_, places, &found[first].x);
      if (one_place) memory_.known.keep(place(first), KnownNormals::Way::together, candidates.found, found[first]);
    } else if (count > smallest_part) {
      estimate_part(first, count / 2);
      estimate_part(first + count / 2, count / 2);
      return;
    }
    for (std::size_t k = first; k < first + count; ++k) {
      if (is_zero(found[k])) {
        estimate_alone(k);
      } else {
        normals_[index_[k]] = found[k];
      }
    }
  }

  /// Candidates for the neighbors of all these points, and the radius that it takes; false if it is not worth while.
  [[nodiscard]] bool gather_for_all(std::size_t first, std::size_t count, Neighborhood& candidates, Radius& wide) {
    const auto middle = [=](const float(&v)[group]) {
      const auto ends = std::minmax_element(v + first, v + first + count);
      return 0.5f * (*ends.first + *ends.second);
    };
    const Point center{middle(x_), middle(y_), middle(z_)};
    float farthest_d2 = 0.0f;
    for (std::size_t k = first; k < first + count; ++k) {
      const float dx = x_[k] - center.x;
      const float dy = y_[k] - center.y;
      const float dz = z_[k] - center.z;
      farthest_d2 = std::max(farthest_d2, unfused(dx * dx) + unfused(dy * dy) + unfused(dz * dz));
    }
    wide = Radius((radius_.value + simd::sqrt(farthest_d2)) * 1.00001f);  // more than all roundings
    const float widest = (count > smallest_part ? 1.75f : 3.0f) * radius_.value;
    return wide.value < widest && wide.value < largest_shared && validate(wide) == Status::ok &&
           gather(center, wide, candidates) == Status::ok;
  }

  void estimate_alone(std::size_t k) {
    const Point p = place(k);
    SurfaceNormal& normal = normals_[index_[k]];
    if (const SurfaceNormal* const known = memory_.known.find(p, KnownNormals::Way::alone)) {
      normal = *known;
      return;
    }
    Neighborhood n;
    SurfaceNormal found{};
    const bool is_found =
        gather(p, radius_, n) == Status::ok && estimate_normal(n, radius_, found, viewpoint_) == Status::ok;
    if (is_found) normal = found;
    memory_.known.keep(p, KnownNormals::Way::alone, n.found, normal);
  }

  /// Also notes whether the search is one over another cloud.
  [[nodiscard]] Status gather(const Point& center, Radius radius, Neighborhood& n) {
    const Status status = memory_.workspace.gather(search_, center, radius, n);
    if (status == Status::ok && !is_of(cloud_, center, n)) memory_.other_cloud = true;
    return status;
  }

  [[nodiscard]] Point place(std::size_t k) const noexcept { return {x_[k], y_[k], z_[k]}; }

  [[nodiscard]] bool are_in_one_place(std::size_t first, std::size_t count) const noexcept {
    for (std::size_t k = first + 1; k < first + count; ++k) {
      if (!(x_[k] == x_[first] && y_[k] == y_[first] && z_[k] == z_[first])) return false;
    }
    return true;
  }

  const CloudView cloud_;
  const Search& search_;
  const Radius radius_;
  const Viewpoint viewpoint_;
  const std::uint8_t* const needed_;  // one per point; null: all are
  NormalMemory& memory_;
  SurfaceNormal* const normals_;
  std::size_t index_[group];
  float x_[group];
  float y_[group];
  float z_[group];
  std::size_t row_;  // of an image, in points; 0 for other clouds
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
