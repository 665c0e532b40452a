#include "tools/match/chance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace shortshot_bench {
namespace {

using shortshot::Point;
using shortshot::PointPair;

/// Mean share of the targets that a moved source reaches.
double agreement_of(const std::vector<PointPair>& pairs, const shortshot::Pose& pose, const std::vector<Point>& targets,
                    float reach) {
  const auto view = shortshot::view_of(targets);
  const shortshot::GridSearch search(view, reach);
  shortshot::Workspace<4096> workspace;
  double reached = 0.0;
  for (const PointPair& pair : pairs) {
    shortshot::Neighborhood n = shortshot::neighborhood_in(workspace);
    static_cast<void>(search.gather(shortshot::transform_point(pose, pair.source), reach, n));
    reached += static_cast<double>(n.found);
  }
  return reached / static_cast<double>(pairs.size()) / static_cast<double>(targets.size());
}

}  // namespace

double log10_binomial_tail(std::size_t trials, std::size_t least, double probability) {
  if (least == 0 || probability >= 1.0) return 0.0;
  if (least > trials || probability <= 0.0) return -300.0;
  const auto n = static_cast<double>(trials);
  double largest = -1e300;  // of the terms' logarithms
  std::vector<double> terms;
  for (std::size_t k = least; k <= trials; ++k) {
    const auto m = static_cast<double>(k);
    const double ways = std::lgamma(n + 1.0) - std::lgamma(m + 1.0) - std::lgamma(n - m + 1.0);
    terms.push_back(ways + m * std::log(probability) + (n - m) * std::log1p(-probability));
    largest = std::max(largest, terms.back());
  }
  double sum = 0.0;
  for (const double term : terms) sum += std::exp(term - largest);
  return std::min(0.0, (largest + std::log(sum)) / std::log(10.0));
}

Places places_of(const std::vector<Point>& points, const std::vector<float>& distances, float apart) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return distances[a] < distances[b]; });
  Places places;
  places.of.resize(points.size());
  for (const std::uint32_t i : order) {
    const auto is_near = [&](std::uint32_t k) {
      return shortshot::squared_distance(points[i], points[k]) < apart * apart;
    };
    const auto found = std::find_if(places.nearest.begin(), places.nearest.end(), is_near);
    places.of[i] = static_cast<std::uint32_t>(found - places.nearest.begin());
    if (found == places.nearest.end()) places.nearest.push_back(i);
  }
  return places;
}

Agreement agreement_at(const Places& places, const std::vector<std::uint32_t>& agreeing, double probability,
                       std::size_t free) {
  Agreement out;
  out.places = places.nearest.size();
  std::vector<bool> has_any(out.places, false);
  for (const std::uint32_t i : agreeing) {
    has_any[places.of[i]] = true;
    out.nearest += places.nearest[places.of[i]] == i ? 1u : 0u;
  }
  out.any = static_cast<std::size_t>(std::count(has_any.begin(), has_any.end(), true));
  if (out.places <= free) return out;
  const double each = static_cast<double>(places.of.size()) / static_cast<double>(out.places);
  const double of_any = 1.0 - std::pow(1.0 - std::min(1.0, probability), each);
  const auto tail = [&](std::size_t count, double p) {
    return log10_binomial_tail(out.places - free, count > free ? count - free : 0, p);
  };
  out.log10_probability =
      std::min(0.0, std::log10(2.0) + std::min(tail(out.nearest, probability), tail(out.any, of_any)));
  return out;
}

Chance chance_of(const std::vector<PointPair>& pairs, const std::vector<std::uint32_t>& inliers, const Places& places,
                 const shortshot::Pose& pose, const std::vector<Point>& targets, float reach, std::size_t tried) {
  Chance chance;
  if (!targets.empty() && !pairs.empty()) chance.agreement = agreement_of(pairs, pose, targets, reach);
  chance.at = agreement_at(places, inliers, chance.agreement, 3);
  chance.log10_expected =
      std::log10(static_cast<double>(std::max<std::size_t>(1, tried))) + chance.at.log10_probability;
  return chance;
}

}  // namespace shortshot_bench
