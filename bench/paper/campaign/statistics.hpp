// Figures of many items and how far they would move with other items: bootstrap intervals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "speed/timing/clock.hpp"  // median()

namespace shortshot_bench::campaign {

/// All functions throw std::invalid_argument if there are no items or one is not finite.

double mean(const std::vector<double>& values);

/// The value below which a share (0 to 1) of the values lies, linear between two of them: 0.5 gives the median.
double quantile(std::vector<double> values, double share);

/// Correct matches of all matches, as an example. The ratio of several is that of the sums.
struct Fraction {
  double numerator = 0.0;
  double denominator = 0.0;  // not negative
};

/// A statistic and where the middle 95 % of its values lie when the groups are drawn again.
struct Interval {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

enum class Statistic { mean, median };

constexpr unsigned bootstrap_rounds = 2000;

/// Percentile bootstrap (Efron 1979): in each round as many groups are drawn, with replacement, as there are, and the
/// statistic is taken over all of their items together. Items of one group (views of one object, say) are not
/// independent: they come or stay away together. For paired comparisons the items are the differences. The intervals
/// are the same on every machine for a seed.
Interval bootstrap(const std::vector<std::vector<double>>& groups, Statistic statistic, std::uint64_t seed,
                   unsigned rounds = bootstrap_rounds);

/// The same of sum(numerators) / sum(denominators). Rounds whose denominators are all zero have no ratio and do not
/// count; std::invalid_argument if those of all items are.
Interval bootstrap_ratio(const std::vector<std::vector<Fraction>>& groups, std::uint64_t seed,
                         unsigned rounds = bootstrap_rounds);

/// The same of any statistic of the groups that were drawn, which are known by their places among all; rounds in which
/// it has no value do not count. std::invalid_argument if it has none of all groups.
Interval bootstrap_of(std::size_t groups,
                      const std::function<std::optional<double>(const std::vector<std::size_t>& drawn)>& statistic,
                      std::uint64_t seed, unsigned rounds = bootstrap_rounds);

/// Independent items: each is a group.
template <class Item>
std::vector<std::vector<Item>> each_its_own_group(const std::vector<Item>& items) {
  std::vector<std::vector<Item>> groups;
  for (const Item& item : items) groups.push_back({item});
  return groups;
}

}  // namespace shortshot_bench::campaign
