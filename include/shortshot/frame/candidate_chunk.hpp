// shortshot/frame/candidate_chunk.hpp: points that may be neighbors of a group of points, and what they add to moments.
#ifndef SHORTSHOT_FRAME_CANDIDATE_CHUNK_HPP
#define SHORTSHOT_FRAME_CANDIDATE_CHUNK_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/point_lanes.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "normal.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

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

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_FRAME_CANDIDATE_CHUNK_HPP
