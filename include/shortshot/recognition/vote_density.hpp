// shortshot/recognition/vote_density.hpp: how dense votes are at a place, and where their mean lies from there.
#pragma once

#include <cstddef>

#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "vote_centers.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// e^-t, for t from 0 to 80: within 3e-7 of it, relatively, and the same on every machine, as libm's is not.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 exp_minus(simd::F32 t) noexcept {
  using simd::all;
  using simd::F32;
  using simd::I32;
  constexpr float factors[] = {1.0f / 720.0f, 1.0f / 120.0f, 1.0f / 24.0f, 1.0f / 6.0f, 0.5f, 1.0f, 1.0f};
  const I32 halvings = shift_right(truncate_to_int(t * all(2.88539008f)) + simd::all_int(1), 1);  // t / ln 2, rounded
  const F32 n = to_float(halvings);
  const F32 r = (n * all(0.693359375f) - t) - n * all(2.12194440e-4f);  // ln 2 in two parts; |r| <= ln 2 / 2
  F32 sum = all(factors[0]);
  unroll<6>([&](auto k) SHORTSHOT_INLINE_LAMBDA { sum = all(factors[k + 1]) + r * sum; });
  return simd::from_bits(bits_of(sum) - shift_left(halvings, 23));  // exactly: above 2^-126
}
[[nodiscard]] inline float exp_minus(float t) noexcept { return simd::largest(exp_minus(simd::all(t))); }

/// The density of votes (finite, of one class): the sum of w = exp(-d^2 / (2 h^2)) over their distances d, with h the
/// bandwidth.
class VoteDensity {
 public:
  static constexpr float reach = 6.0f;  ///< in bandwidths; the weight of a vote that far away is lost next to a 1

  explicit VoteDensity(float bandwidth) noexcept
      : bandwidth_(bandwidth),
        reach_d2_(reach * reach * bandwidth * bandwidth),
        factor_(0.5f / (bandwidth * bandwidth)) {}

  [[nodiscard]] float bandwidth() const noexcept { return bandwidth_; }

  /// What a vote adds to the density at a place.
  [[nodiscard]] float weight(const Vote& vote, const Point& at) const noexcept {
    const float d2 = squared_distance(vote.center, at);
    return d2 < reach_d2_ ? exp_minus(extend::unfused(factor_ * d2)) : 0.0f;
  }

  struct Sums {
    float density;
    Point shift;  ///< of w times the vote's offset: of differences, so that nothing is lost far away from the origin
  };

  /// Of votes that include all in reach. They are added one after the other, whatever the number of lanes; one that is
  /// out of reach adds zeros, as if it were not there. Offsets of the votes must be finite.
  [[nodiscard]] Sums at(const Point& place, const VoteCenters& votes) const noexcept {
    using simd::F32;
    const F32 reach_d2 = simd::all(reach_d2_);
    const F32 factor = simd::all(factor_);
    Sum sum;
    for (std::size_t i = 0; i < votes.padded; i += simd::lanes) {
      const VoteOffsets offset = offsets(votes, i, place);
      const simd::Mask reached = offset.d2 < reach_d2;
      const F32 w = keep(reached, exp_minus(factor * keep(reached, offset.d2)));
      sum.add(w, w * keep(reached, offset.x), w * offset.y, w * offset.z);  // x may be infinite
    }
    return sum.result();
  }

 private:
  /// Four sums, of numbers in lanes.
  class Sum {
   public:
    template <class F32>
    SHORTSHOT_INLINE void add(F32 w, F32 x, F32 y, F32 z) noexcept {
      if constexpr (simd::lanes == 1) {
        const F32 terms[] = {w, x, y, z};
        each<4>([&](auto k) SHORTSHOT_INLINE_LAMBDA { sums_[+k] += simd::largest(terms[k]); });
      } else {
        simd::Quad terms[simd::lanes];
        transpose(bits_of(w), bits_of(x), bits_of(y), bits_of(z), terms);
        unroll<simd::lanes>([&](auto k) SHORTSHOT_INLINE_LAMBDA { sums_ += reinterpret_cast<Four>(terms[k]); });
      }
    }
    [[nodiscard]] Sums result() const noexcept { return {sums_[0], {sums_[1], sums_[2], sums_[3]}}; }

   private:
    using Four = float __attribute__((vector_size(16)));
    Four sums_{};
  };

  float bandwidth_;
  float reach_d2_;
  float factor_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
