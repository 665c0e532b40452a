// shortshot/recognition/vote_centers.hpp: votes for an object's center, and a list of them as lanes read it. Hosted
// only: allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A vote for an object's center.
struct Vote {
  Point center;
  std::uint32_t object_class;
  std::uint32_t instance;
};

/// Centers of votes, borrowed. A register that they do not fill is filled with the last one at an infinite x: out of
/// any reach, and nothing overflows on the way.
struct VoteCenters {
  const float* x;
  const float* y;
  const float* z;
  std::size_t padded;  ///< how many there are with these; a multiple of lanes
};

/// How far some votes lie from a place.
struct VoteOffsets {
  simd::F32 x, y, z;
  simd::F32 d2;  ///< as squared_distance() has it
};

[[nodiscard]] SHORTSHOT_INLINE VoteOffsets offsets(const VoteCenters& votes, std::size_t i,
                                                   const Point& from) noexcept {
  const simd::F32 x = simd::load(votes.x + i) - simd::all(from.x);
  const simd::F32 y = simd::load(votes.y + i) - simd::all(from.y);
  const simd::F32 z = simd::load(votes.z + i) - simd::all(from.z);
  return {x, y, z, (x * x + y * y) + z * z};
}

[[nodiscard]] constexpr std::size_t padded(std::size_t count) noexcept {
  return (count + simd::lanes - 1) / simd::lanes * simd::lanes;
}

/// Fills the last register of columns of centers.
inline void pad(float* x, float* y, float* z, std::size_t count) noexcept {
  for (std::size_t i = count; i < padded(count); ++i) {
    x[i] = extend::math::float_of(0x7F800000u);
    y[i] = y[count - 1];
    z[i] = z[count - 1];
  }
}

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
