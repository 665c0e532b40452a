// shortshot/recognition/vote_centers_list.hpp: a list of centers of votes. Hosted only: allocates.
#pragma once

#include <cstddef>
#include <vector>

#include "../base/simd.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "vote_centers.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The centers of votes[i] for each index, as columns.
inline void write_centers(const Vote* votes, const std::vector<std::size_t>& indices, float* x, float* y,
                          float* z) noexcept {
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const Point& center = votes[indices[k]].center;
    x[k] = center.x;
    y[k] = center.y;
    z[k] = center.z;
  }
  pad(x, y, z, indices.size());
}

/// A list of its own, of up to `most` centers; only the constructor allocates: 12 bytes for each.
class VoteCentersList {
 public:
  explicit VoteCentersList(std::size_t most) : room_(most + 2 * simd::lanes), xyz_(3 * room_) {}

  [[nodiscard]] VoteCenters centers() const noexcept {
    return {xyz_.data(), xyz_.data() + room_, xyz_.data() + 2 * room_, padded(count_)};
  }

  /// The centers of votes[i] for each index.
  void assign(const Vote* votes, const std::vector<std::size_t>& indices) noexcept {
    count_ = indices.size();
    write_centers(votes, indices, x(), y(), z());
  }

  /// Those of others that lie within a distance of a place, as they are ordered.
  void assign_close(const VoteCenters& others, const Point& place, float distance) noexcept {
    count_ = 0;
    for (std::size_t i = 0; i < others.padded; i += simd::lanes) {
      const simd::Mask close = offsets(others, i, place).d2 < simd::all(distance * distance);
      if (!any(close)) continue;
      const simd::Packing packing = simd::packing(close);
      store(x() + count_, simd::load(others.x + i), packing);
      store(y() + count_, simd::load(others.y + i), packing);
      store(z() + count_, simd::load(others.z + i), packing);
      count_ += packing.count;
    }
    pad(x(), y(), z(), count_);
  }

 private:
  [[nodiscard]] float* x() noexcept { return xyz_.data(); }
  [[nodiscard]] float* y() noexcept { return xyz_.data() + room_; }
  [[nodiscard]] float* z() noexcept { return xyz_.data() + 2 * room_; }

  std::size_t room_;  // a register may be stored behind the last one
  std::vector<float> xyz_;
  std::size_t count_ = 0;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
