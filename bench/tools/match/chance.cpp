#include "tools/match/chance.hpp"

#include <algorithm>
#include <cmath>

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

/// How many of the sources, in this order, are no nearer than `apart` to one that was counted before; adds them.
std::size_t count_places(const std::vector<PointPair>& pairs, const std::vector<std::uint32_t>& order, float apart,
                         std::vector<Point>& places) {
  const std::size_t before = places.size();
  for (const std::uint32_t i : order) {
    const Point& p = pairs[i].source;
    const auto is_near = [&](const Point& q) { return shortshot::squared_distance(p, q) < apart * apart; };
    if (std::none_of(places.begin(), places.end(), is_near)) places.push_back(p);
  }
  return places.size() - before;
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

Chance chance_of(const std::vector<PointPair>& pairs, const std::vector<std::uint32_t>& inliers,
                 const shortshot::Pose& pose, const std::vector<Point>& targets, float reach, float apart,
                 std::size_t tried) {
  Chance chance;
  chance.log10_expected = std::log10(static_cast<double>(std::max<std::size_t>(1, tried)));  // three pairs always agree
  if (inliers.size() < 3 || targets.empty()) return chance;
  std::vector<std::uint32_t> all(pairs.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
  std::vector<Point> places;
  chance.agreement = agreement_of(pairs, pose, targets, reach);
  chance.agreeing = count_places(pairs, inliers, apart, places);
  chance.places = chance.agreeing + count_places(pairs, all, apart, places);
  const double at_each = static_cast<double>(pairs.size()) / static_cast<double>(chance.places);
  chance.at_place = 1.0 - std::pow(1.0 - std::min(1.0, chance.agreement), at_each);
  if (chance.agreeing <= 3) return chance;
  chance.log10_expected += log10_binomial_tail(chance.places - 3, chance.agreeing - 3, chance.at_place);
  return chance;
}

}  // namespace shortshot_bench
