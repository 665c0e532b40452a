// shortshot/estimate_normals.hpp: the surface normals of a whole cloud, on one or more threads. Hosted only: allocates,
// starts threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "cloud.hpp"
#include "config.hpp"
#include "executor.hpp"
#include "features.hpp"
#include "neighborhood.hpp"
#include "normals.hpp"
#include "rounded.hpp"
#include "simd.hpp"
#include "status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// Points that a thread takes at a time: about a quarter of a millisecond of work.
inline constexpr std::size_t normal_block = 512;

/// Estimates normals of a few points at a time. Points that follow each other in a cloud mostly lie side by side: one
/// search, a little wider, finds the neighbours of all, and each candidate is offered to all of them in lanes.
template <class Search>
class NormalEstimator {
 public:
  NormalEstimator(const CloudView& cloud, const Search& search, Radius radius, const Point& viewpoint,
                  GrowingWorkspace& workspace, Normal* normals) noexcept
      : cloud_(cloud),
        search_(search),
        radius_(radius),
        viewpoint_(viewpoint),
        workspace_(workspace),
        normals_(normals) {
    const bool image = cloud.height > 1 && cloud.size % cloud.height == 0 && cloud.size / cloud.height == cloud.width;
    row_ = image ? cloud.width : 0;
  }

  void estimate(std::size_t begin, std::size_t end) {
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    std::size_t used = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = in_zigzag(k);
      normals_[i] = {none, none, none};
      const Point p = point(cloud_, i);
      if (!is_finite(p)) continue;
      index_[used] = i;
      x_[used] = p.x;
      y_[used] = p.y;
      z_[used] = p.z;
      if (++used < group) continue;
      estimate_group();
      used = 0;
    }
    for (std::size_t k = 0; k < used; ++k) estimate_alone(k);
  }

 private:
  static constexpr std::size_t group = 8;
  static_assert(group % simd::lanes == 0, "whole registers");

  /// The k-th point, where two rows of an image are walked at once: what follows each other then lies in a square.
  [[nodiscard]] std::size_t in_zigzag(std::size_t k) const noexcept {
    if (row_ == 0) return k;
    const std::size_t first = k - k % (2 * row_);
    return cloud_.size - first < 2 * row_ ? k : first + (k - first) / 2 + k % 2 * row_;
  }

  void estimate_group() {
    Normal found[group] = {};
    Neighborhood candidates;
    if (gather_for_all(candidates)) {
      for (std::size_t first = 0; first < group; first += simd::lanes) {
        estimate_register(candidates, first, found + first);
      }
    }
    for (std::size_t k = 0; k < group; ++k) {
      if (is_zero(found[k])) {
        estimate_alone(k);
      } else {
        normals_[index_[k]] = found[k];
      }
    }
  }

  /// Candidates for the neighbours of all points of the group; false if it is not worth while.
  [[nodiscard]] bool gather_for_all(Neighborhood& candidates) {
    const auto middle = [](const float(&v)[group]) {
      const auto ends = std::minmax_element(v, v + group);
      return 0.5f * (*ends.first + *ends.second);
    };
    const Point center{middle(x_), middle(y_), middle(z_)};
    float farthest_d2 = 0.0f;
    for (std::size_t k = 0; k < group; ++k) {
      const float dx = x_[k] - center.x;
      const float dy = y_[k] - center.y;
      const float dz = z_[k] - center.z;
      farthest_d2 = std::max(farthest_d2, rounded(dx * dx) + rounded(dy * dy) + rounded(dz * dz));
    }
    const Radius wide((radius_.value + simd::root(farthest_d2)) * 1.00001f);  // more than all roundings
    return wide.value < 3.0f * radius_.value && check(wide) == Status::ok &&
           workspace_.gather(search_, center, wide, candidates) == Status::ok && candidates.size <= max_plain_members;
  }

  /// One register of the group, from point `first` on; zeros for those that need to be looked at alone.
  void estimate_register(const Neighborhood& candidates, std::size_t first, Normal* found) const noexcept {
    const simd::F32 x = simd::load(x_ + first);
    const simd::F32 y = simd::load(y_ + first);
    const simd::F32 z = simd::load(z_ + first);
    const MomentScale scale = plain_scale(radius_);
    const CloudView cloud = cloud_;
    Moments moments{};
    for (std::uint32_t i = 0; i < candidates.size; ++i) {
      const Point p = point(cloud, candidates.index[i]);
      const simd::F32 dx = simd::all(p.x) - x;
      const simd::F32 dy = simd::all(p.y) - y;
      const simd::F32 dz = simd::all(p.z) - z;
      add(moments, {dx, dy, dz, (dx * dx + dy * dy) + dz * dz}, radius_, scale);
    }
    const VectorLanes towards{simd::all(viewpoint_.x) - x, simd::all(viewpoint_.y) - y, simd::all(viewpoint_.z) - z};
    const VectorLanes normals = keep(is_fine(moments, scale), normals_of(moments, scale, towards));
    for (std::size_t lane = 0; lane < simd::lanes; ++lane) found[lane] = normal_in(normals, lane);
  }

  void estimate_alone(std::size_t k) {
    Neighborhood n;
    const float towards[3] = {viewpoint_.x - x_[k], viewpoint_.y - y_[k], viewpoint_.z - z_[k]};
    Normal found{};
    if (workspace_.gather(search_, {x_[k], y_[k], z_[k]}, radius_, n) != Status::ok) return;
    if (estimate_normal(n, radius_, towards, found) == Status::ok) normals_[index_[k]] = found;
  }

  const CloudView cloud_;
  const Search& search_;
  const Radius radius_;
  const Point viewpoint_;
  GrowingWorkspace& workspace_;
  Normal* const normals_;
  std::size_t index_[group];
  float x_[group];
  float y_[group];
  float z_[group];
  std::size_t row_;  // of an image, in points; 0 for other clouds
};

}  // namespace detail

/// The surface normal at each point of a cloud (see estimate_normal()).
///
/// `search`     any search over this cloud (GridSearch, NanoflannSearch, ...)
/// `radius`     of the neighbourhoods, in metres
/// `normals`    one per point, all three components NaN where the point is not finite or has no normal: fewer than
///              three neighbours, or all of them on a line. with_normals(cloud, normals.data()) puts them into a view
/// `viewpoint`  where the camera is, in the cloud's coordinates: normals point to its side of the surface
/// `threads`    how many threads share the work, or an executor (see extract()); the result is the same, bit for bit,
///              for any number, and for any search
///
/// Statuses: empty_cloud, bad_view (also: the search is over a cloud of another size), bad_radius, bad_viewpoint (not
/// finite), or what the search's build() returned; `normals` is empty then. Allocates the normals (none, if they fit
/// already) and about 30 bytes for each neighbour of the largest neighbourhood and each thread. May throw what
/// extract() may.
template <class Search, class Threads = unsigned>
[[nodiscard]] Status estimate_normals(const CloudView& cloud, const Search& search, Radius radius,
                                      std::vector<Normal>& normals, Point viewpoint = {}, Threads&& threads = 1u) {
  normals.clear();
  Status status = check(cloud);
  if (status == Status::ok) status = search.status();
  if (status == Status::ok && search.cloud_size() != cloud.size) status = Status::bad_view;
  if (status == Status::ok) status = check(radius);
  if (status == Status::ok && !is_finite(viewpoint)) status = Status::bad_viewpoint;
  if (status != Status::ok) return status;

  auto&& executor = detail::executor_of(threads, (cloud.size + detail::normal_block - 1) / detail::normal_block);
  const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
  std::vector<detail::GrowingWorkspace> workspaces(team);
  for (detail::GrowingWorkspace& workspace : workspaces) workspace.reserve(detail::max_plain_members);
  normals.resize(cloud.size);
  detail::for_blocks(
      executor, team, cloud.size, detail::normal_block, [&](std::size_t thread, std::size_t begin, std::size_t end) {
        detail::NormalEstimator<Search>(cloud, search, radius, viewpoint, workspaces[thread], normals.data())
            .estimate(begin, end);
      });
  return Status::ok;
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
