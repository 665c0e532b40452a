// shortshot/recognition/climb.hpp: from a vote to a maximum of the density of votes.
//
// After D. Comaniciu, P. Meer: Mean shift: A robust approach toward feature space analysis (PAMI 24, 2002), with a
// Gaussian kernel.
#pragma once

#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "vote_density.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A place and how dense votes are there.
struct Peak {
  Point at;
  float density;
};

/// The maximum where the mean shift from a vote's center ends, after 100 steps at the most. reachable(place) gives
/// VoteCenters with all votes of the class that are in reach of a place; others among them change no bit.
template <class Reachable>
[[nodiscard]] inline Peak climb(const VoteDensity& density, const Point& from, const Reachable& reachable) noexcept {
  constexpr float still = 1e-3f;  // a shift that ends the climb, in bandwidths
  constexpr int most_steps = 100;
  const float still_d2 = still * still * density.bandwidth() * density.bandwidth();
  Peak peak{from, 0.0f};
  Point at = from;
  for (int step = 0; step < most_steps; ++step) {
    const VoteDensity::Sums sums = density.at(at, reachable(at));
    if (!(sums.density > peak.density)) break;  // it grows, but for rounding, from the 1 of the vote itself
    peak = {at, sums.density};
    at = {at.x + sums.shift.x / sums.density, at.y + sums.shift.y / sums.density, at.z + sums.shift.z / sums.density};
    if (!(squared_distance(at, peak.at) > still_d2)) break;
  }
  return peak;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
