// shortshot/batch/estimate_normals.hpp: the surface normals of a whole cloud, on one or more threads. Hosted only:
// allocates, starts threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/point_lanes.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../frame/normal.hpp"
#include "../frame/viewpoint.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../search/search.hpp"
#include "../status.hpp"
#include "executor.hpp"
#include "growing_workspace.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Points that a thread takes at a time: about a quarter of a millisecond of work.
inline constexpr std::size_t normal_block = 512;

/// Some of the points that may be neighbors of a group: where they are, and their terms of moments.
class CandidateChunk {
 public:
  static constexpr std::uint32_t most = 64;

  /// Candidates from `first` on; their moments are about the place that `candidates` were gathered around.
  void fill(const CloudView& cloud, const Neighborhood& candidates, std::uint32_t first,
            const MomentScale& by) noexcept {
    for (size_ = 0; size_ < most && first + size_ < candidates.size; size_ += simd::lanes) {
      const NeighborLanes v = load_neighbors(candidates, first + size_);
      const std::uint32_t left = candidates.size - first - size_;
      std::uint32_t index[simd::lanes];
      simd::store(index, v.index);
      for (std::size_t lane = left; lane < simd::lanes; ++lane) index[lane] = index[0];
      const PointLanes p = read_lanes(cloud.points, [&](std::size_t lane) { return std::size_t{index[lane]}; });
      // What fills up the last register is nobody's neighbor: on the other side of the origin, beyond any radius.
      const float nowhere = candidates.center.x > 0.0f ? -1.3e19f : 1.3e19f;
      simd::store(x_ + size_, select(simd::first(left), p.x, simd::all(nowhere)));
      simd::store(y_ + size_, p.y);
      simd::store(z_ + size_, p.z);
      const Terms each = terms_of(v, by);
      unroll<Terms::kinds>([&](auto k) { simd::store(terms_[k] + size_, each.of[k]); });
    }
  }

  /// Adds those that are neighbors of a point.
  void add_neighbors(const Point& p, Radius radius, Moments& to) const noexcept {
    const simd::F32 x = simd::all(p.x);
    const simd::F32 y = simd::all(p.y);
    const simd::F32 z = simd::all(p.z);
    Moments sums = to;
    for (std::uint32_t i = 0; i < size_; i += simd::lanes) {
      const simd::F32 dx = simd::load(x_ + i) - x;
      const simd::F32 dy = simd::load(y_ + i) - y;
      const simd::F32 dz = simd::load(z_ + i) - z;
      const simd::Mask near = (dx * dx + dy * dy) + dz * dz < simd::all(radius.squared);
      add_where(near, sums, [&](auto k) { return simd::load(terms_[k] + i); });
    }
    to = sums;
  }

 private:
  alignas(simd::F32) float x_[most];
  alignas(simd::F32) float y_[most];
  alignas(simd::F32) float z_[most];
  alignas(simd::F32) std::uint32_t terms_[Terms::kinds][most];
  std::uint32_t size_ = 0;
};

/// The totals of moments whose lanes hold shares, one after the other.
[[nodiscard]] inline Moments totals(const Moments* shares) noexcept {
  Moments result;
  const auto total = [&](const auto& share_of) {
    std::uint32_t lanes[simd::lanes];
    for (std::size_t k = 0; k < simd::lanes; ++k) lanes[k] = static_cast<std::uint32_t>(sum(share_of(shares[k])));
    return simd::load(lanes);
  };
  result.members = total([](const Moments& m) { return m.members; });
  unroll<Terms::kinds>([&](auto k) { result.of[k] = total([k](const Moments& m) { return m.of[k]; }); });
  return result;
}

/// Estimates normals of a few points at a time. Points that follow each other in a cloud mostly lie side by side: one
/// search, a little wider, finds the neighbors of all, and what a neighbor adds to moments about their middle is
/// computed once for all of them.
template <class Search>
class NormalEstimator {
 public:
  NormalEstimator(const CloudView& cloud, const Search& search, Radius radius, const Viewpoint& viewpoint,
                  GrowingWorkspace& workspace, SurfaceNormal* normals) noexcept
      : cloud_(cloud),
        search_(search),
        radius_(radius),
        viewpoint_(viewpoint),
        workspace_(workspace),
        normals_(normals) {
    const bool image = cloud.height > 1 && cloud.size % cloud.height == 0 && cloud.size / cloud.height == cloud.width;
    row_ = image ? cloud.width : 0;
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
    for (std::size_t k = 0; k < used; ++k) estimate_alone(k);
  }

 private:
  static constexpr std::size_t group = 16;
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

  /// Points [first, first + count) of the group, or each half of them if they lie too far apart.
  void estimate_part(std::size_t first, std::size_t count) {
    SurfaceNormal found[group] = {};
    Neighborhood candidates;
    Radius wide = radius_;
    if (gather_for_all(first, count, candidates, wide)) {
      estimate_together(first, count, candidates, wide, found);
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
           workspace_.gather(search_, center, wide, candidates) == Status::ok;
  }

  /// Normals of these points; zeros for those that need to be looked at alone.
  void estimate_together(std::size_t first, std::size_t count, const Neighborhood& candidates, Radius wide,
                         SurfaceNormal (&found)[group]) const noexcept {
    const MomentScale scale = moment_scale(candidates.size, wide.value);
    Moments shares[group] = {};
    CandidateChunk chunk;
    for (std::uint32_t i = 0; i < candidates.size; i += CandidateChunk::most) {
      chunk.fill(cloud_, candidates, i, scale);
      for (std::size_t k = first; k < first + count; ++k) {
        chunk.add_neighbors({x_[k], y_[k], z_[k]}, radius_, shares[k]);
      }
    }
    for (std::size_t k = first; k < first + count; k += simd::lanes) {
      const Moments moments = totals(shares + k);
      store(found + k, keep(is_fine(moments, scale), normals_of(moments, scale, directions_at(k))));
    }
  }

  /// What to turn the normals of a register of points to; zeros if the viewpoint is absent.
  [[nodiscard]] PointLanes directions_at(std::size_t k) const noexcept {
    using Side = Viewpoint::Side;
    const float side = viewpoint_.side == Side::absent ? 0.0f : viewpoint_.side == Side::towards ? 1.0f : -1.0f;
    const Point& p = viewpoint_.point;
    return {(simd::all(p.x) - simd::load(x_ + k)) * simd::all(side),
            (simd::all(p.y) - simd::load(y_ + k)) * simd::all(side),
            (simd::all(p.z) - simd::load(z_ + k)) * simd::all(side)};
  }

  void estimate_alone(std::size_t k) {
    Neighborhood n;
    SurfaceNormal found{};
    if (workspace_.gather(search_, {x_[k], y_[k], z_[k]}, radius_, n) != Status::ok) return;
    if (estimate_normal(n, radius_, found, viewpoint_) == Status::ok) normals_[index_[k]] = found;
  }

  const CloudView cloud_;
  const Search& search_;
  const Radius radius_;
  const Viewpoint viewpoint_;
  GrowingWorkspace& workspace_;
  SurfaceNormal* const normals_;
  std::size_t index_[group];
  float x_[group];
  float y_[group];
  float z_[group];
  std::size_t row_;  // of an image, in points; 0 for other clouds
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The surface normal at each point of a cloud, as estimate_normal() gives it but for the rounding of sums: points that
/// follow each other are looked at together.
///
/// `search`     any search over this cloud (GridSearch, NanoflannSearch, ...)
/// `radius`     of the neighborhoods, in meters
/// `viewpoint`  to which side of the surface normals point: Viewpoint::towards({0, 0, 0}) for what a depth camera gives
///              in its own coordinates; Viewpoint{} leaves them as they come
/// `normals`    one per point, all three components NaN where the point is not finite or has no normal: fewer than
///              three neighbors, or all of them on a line. with_normals(cloud, normals.data()) puts them into a view
/// `threads`    how many threads share the work, or an executor (see extract()); the result is the same, bit for bit,
///              for any number, and for any search
///
/// Statuses: empty_cloud, bad_view (also: the search is over a cloud of another size), bad_radius, bad_viewpoint (not
/// finite), or what the search's build() returned; `normals` is empty then. Allocates the normals (none, if they fit
/// already) and about 30 bytes for each neighbor of the largest neighborhood and each thread. May throw what
/// extract() may; `normals` is empty then, or NaN where none was estimated by then.
template <class Search, class Threads = unsigned>
[[nodiscard]] Status estimate_normals(const CloudView& cloud, const Search& search, Radius radius,
                                      const Viewpoint& viewpoint, std::vector<SurfaceNormal>& normals,
                                      Threads&& threads = 1u) {
  normals.clear();
  Status status = detail::validate_search(cloud, search);
  if (status == Status::ok) status = validate(radius);
  if (status == Status::ok) status = validate(viewpoint);
  if (status != Status::ok) return status;

  auto&& executor = detail::executor_of(threads, (cloud.size + detail::normal_block - 1) / detail::normal_block);
  const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
  std::vector<detail::GrowingWorkspace> workspaces(team);
  for (detail::GrowingWorkspace& workspace : workspaces) workspace.reserve(1024);
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  normals.assign(cloud.size, {none, none, none});  // and so they stay where an executor throws before their turn
  detail::for_blocks(
      executor, team, cloud.size, detail::normal_block, [&](std::size_t thread, std::size_t begin, std::size_t end) {
        detail::NormalEstimator<Search>(cloud, search, radius, viewpoint, workspaces[thread], normals.data())
            .estimate(begin, end);
      });
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
