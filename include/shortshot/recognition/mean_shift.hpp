// shortshot/recognition/mean_shift.hpp: the maxima of a density of votes in space.
//
// After D. Comaniciu, P. Meer: Mean shift: A robust approach toward feature space analysis (PAMI 24, 2002), with a
// Gaussian kernel.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "../base/math.hpp"
#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// e^-t, for t from 0 to 80: within 3e-7 of it, relatively, and the same on every machine, as libm's is not.
[[nodiscard]] inline float exp_minus(float t) noexcept {
  const auto halvings = (static_cast<std::int32_t>(t * 2.88539008f) + 1) / 2;  // t / ln 2, to the nearest
  const auto n = static_cast<float>(halvings);
  const float r = (unfused(n * 0.693359375f) - t) - unfused(n * 2.12194440e-4f);  // ln 2 in two parts; |r| <= ln 2 / 2
  float sum = 1.0f / 720.0f;
  for (const float c : {1.0f / 120.0f, 1.0f / 24.0f, 1.0f / 6.0f, 0.5f, 1.0f, 1.0f}) sum = c + unfused(r * sum);
  return unfused(sum * math::float_of(static_cast<std::uint32_t>(127 - halvings) << 23));
}

/// A vote for an object's center.
struct Vote {
  Point center;
  std::uint32_t object_class;
  std::uint32_t instance;
};

/// A place and how dense votes are there.
struct Peak {
  Point at;
  float density;
};

/// The density of votes (finite, borrowed, of one class): the sum of exp(-d^2 / (2 h^2)) over their distances d, with h
/// the bandwidth.
class VoteDensity {
 public:
  VoteDensity(const Vote* begin, const Vote* end, float bandwidth) noexcept
      : begin_(begin),
        end_(end),
        reach_d2_(reach * reach * bandwidth * bandwidth),
        still_d2_(still * still * bandwidth * bandwidth),
        factor_(0.5f / (bandwidth * bandwidth)) {}

  [[nodiscard]] const Vote* begin() const noexcept { return begin_; }
  [[nodiscard]] const Vote* end() const noexcept { return end_; }

  /// What a vote adds to the density at a place.
  [[nodiscard]] float weight(const Vote& vote, const Point& at) const noexcept {
    const float d2 = squared_distance(vote.center, at);
    return d2 < reach_d2_ ? exp_minus(unfused(factor_ * d2)) : 0.0f;
  }

  /// The maximum where the mean shift from a vote ends: one look at all votes for each of at most 100 steps.
  [[nodiscard]] Peak climb(const Vote& vote) const noexcept {
    Peak peak{vote.center, 0.0f};
    Point at = vote.center;
    for (int step = 0; step < most_steps; ++step) {
      float density = 0.0f;
      Point shift{};  // of differences, not of positions: no loss far away from the origin
      for (const Vote& other : *this) {
        const float w = weight(other, at);
        if (w == 0.0f) continue;
        density += w;
        shift.x += unfused(w * (other.center.x - at.x));
        shift.y += unfused(w * (other.center.y - at.y));
        shift.z += unfused(w * (other.center.z - at.z));
      }
      if (!(density > peak.density)) break;  // it grows, but for rounding, from the 1 that the vote itself makes it
      peak = {at, density};
      at = {at.x + shift.x / density, at.y + shift.y / density, at.z + shift.z / density};
      if (!(squared_distance(at, peak.at) > still_d2_)) break;
    }
    return peak;
  }

 private:
  static constexpr float reach = 6.0f;   // in bandwidths; the weight of a vote that far away is lost next to a 1
  static constexpr float still = 1e-3f;  // a shift that ends the climb, in bandwidths
  static constexpr int most_steps = 100;

  const Vote* begin_;
  const Vote* end_;
  float reach_d2_;
  float still_d2_;
  float factor_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
