#include "paper/campaign/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <stdexcept>

namespace shortshot_bench::campaign {
namespace {

void refuse_unless_finite(double value) {
  if (!std::isfinite(value)) throw std::invalid_argument("a statistic of values that are not all finite");
}

/// Draws groups and evaluates the statistic, which takes pointers to the groups drawn and gives nothing if they have
/// none.
template <class Group, class StatisticOf>
Interval percentile_interval(const std::vector<Group>& groups, const StatisticOf& statistic, std::uint64_t seed,
                             unsigned rounds) {
  if (rounds == 0) throw std::invalid_argument("a bootstrap of no rounds");
  std::vector<const Group*> drawn;
  for (const Group& group : groups) drawn.push_back(&group);
  const std::optional<double> value = statistic(drawn);
  if (!value) throw std::invalid_argument("a statistic of no items");
  std::mt19937_64 random(seed);
  std::vector<double> values;
  for (unsigned round = 0; round < rounds; ++round) {
    // The distributions of the standard library differ between its implementations; this is the same everywhere.
    for (const Group*& group : drawn) group = &groups[((random() >> 32) * groups.size()) >> 32];
    if (const std::optional<double> again = statistic(drawn)) values.push_back(*again);
  }
  return {*value, quantile(values, 0.025), quantile(values, 0.975)};
}

/// A ratio needs no more of a group than its sums.
Interval interval_of_ratio(const std::vector<Fraction>& sums, std::uint64_t seed, unsigned rounds) {
  const auto ratio = [](const std::vector<const Fraction*>& drawn) -> std::optional<double> {
    Fraction sum;
    for (const Fraction* group : drawn) {
      sum.numerator += group->numerator;
      sum.denominator += group->denominator;
    }
    if (sum.denominator == 0.0) return std::nullopt;
    return sum.numerator / sum.denominator;
  };
  return percentile_interval(sums, ratio, seed, rounds);
}

Interval interval_of_median(const std::vector<std::vector<double>>& groups, std::uint64_t seed, unsigned rounds) {
  const auto median_of = [](const std::vector<const std::vector<double>*>& drawn) -> std::optional<double> {
    std::vector<double> items;
    for (const std::vector<double>* group : drawn) items.insert(items.end(), group->begin(), group->end());
    if (items.empty()) return std::nullopt;
    return median(std::move(items));
  };
  return percentile_interval(groups, median_of, seed, rounds);
}

}  // namespace

double mean(const std::vector<double>& values) {
  if (values.empty()) throw std::invalid_argument("the mean of no values");
  std::for_each(values.begin(), values.end(), refuse_unless_finite);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) throw std::invalid_argument("a quantile of no values");
  if (!(share >= 0.0 && share <= 1.0)) throw std::invalid_argument("a quantile's share is between 0 and 1");
  std::for_each(values.begin(), values.end(), refuse_unless_finite);
  std::sort(values.begin(), values.end());
  const double position = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (position - static_cast<double>(below)) * (values[above] - values[below]);
}

Interval bootstrap(const std::vector<std::vector<double>>& groups, Statistic statistic, std::uint64_t seed,
                   unsigned rounds) {
  std::vector<Fraction> sums;
  for (const std::vector<double>& group : groups) {
    std::for_each(group.begin(), group.end(), refuse_unless_finite);
    sums.push_back({std::accumulate(group.begin(), group.end(), 0.0), static_cast<double>(group.size())});
  }
  if (statistic == Statistic::median) return interval_of_median(groups, seed, rounds);
  return interval_of_ratio(sums, seed, rounds);
}

Interval bootstrap_ratio(const std::vector<std::vector<Fraction>>& groups, std::uint64_t seed, unsigned rounds) {
  std::vector<Fraction> sums;
  for (const std::vector<Fraction>& group : groups) {
    Fraction& sum = sums.emplace_back();
    for (const Fraction& item : group) {
      refuse_unless_finite(item.numerator);
      refuse_unless_finite(item.denominator);
      if (item.denominator < 0.0) throw std::invalid_argument("a ratio with a negative denominator");
      sum.numerator += item.numerator;
      sum.denominator += item.denominator;
    }
  }
  return interval_of_ratio(sums, seed, rounds);
}

Interval bootstrap_of(std::size_t groups,
                      const std::function<std::optional<double>(const std::vector<std::size_t>& drawn)>& statistic,
                      std::uint64_t seed, unsigned rounds) {
  std::vector<std::size_t> places(groups);
  std::iota(places.begin(), places.end(), std::size_t{0});
  const auto of_places = [&](const std::vector<const std::size_t*>& drawn) {
    std::vector<std::size_t> list;
    for (const std::size_t* place : drawn) list.push_back(*place);
    return statistic(list);
  };
  return percentile_interval(places, of_places, seed, rounds);
}

}  // namespace shortshot_bench::campaign
