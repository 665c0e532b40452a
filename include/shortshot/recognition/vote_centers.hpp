// shortshot/recognition/vote_centers.hpp: votes for an object's center, as lanes read them.
#pragma once

#include <cstddef>
#include <cstdint>

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

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
