// Bootstrap intervals: known cases, coverage, and the same numbers on every machine.

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "paper/campaign/statistics.hpp"

namespace test_campaign_statistics {
namespace {

using namespace shortshot_bench::campaign;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

const std::vector<double> ten = {0.2, 1.5, 0.9, 3.1, 0.4, 2.2, 1.1, 0.7, 5.0, 1.9};

}  // namespace

TEST_CASE("mean and quantiles") {
  CHECK(mean({1.0, 2.0, 6.0}) == 3.0);
  CHECK(quantile({3.0, 1.0, 2.0}, 0.0) == 1.0);
  CHECK(quantile({3.0, 1.0, 2.0}, 0.5) == 2.0);
  CHECK(quantile({3.0, 1.0, 2.0}, 0.75) == 2.5);
  CHECK(quantile({3.0, 1.0, 2.0}, 1.0) == 3.0);
  CHECK(quantile({7.0}, 0.3) == 7.0);
  CHECK(quantile(ten, 0.5) == doctest::Approx(shortshot_bench::median(ten)));
}

TEST_CASE("equal items have no spread") {
  for (const Statistic statistic : {Statistic::mean, Statistic::median}) {
    const Interval interval = bootstrap({{0.5, 0.5}, {0.5}, {0.5, 0.5, 0.5}}, statistic, 1);
    CHECK(interval.value == 0.5);
    CHECK(interval.low == 0.5);
    CHECK(interval.high == 0.5);
  }
  const Interval ratio = bootstrap_ratio({{{1.0, 2.0}}, {{3.0, 6.0}}}, 1);
  CHECK(ratio.low == 0.5);
  CHECK(ratio.high == 0.5);
}

TEST_CASE("the value is that of all items, whatever their groups; groups move it more than items") {
  const Interval items = bootstrap(each_its_own_group(std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1}), Statistic::mean, 3);
  const Interval groups = bootstrap({{0, 0, 0, 0}, {1, 1, 1, 1}}, Statistic::mean, 3);
  CHECK(items.value == 0.5);
  CHECK(groups.value == 0.5);
  CHECK(groups.low == 0.0);  // both draws give the same group in a quarter of the rounds
  CHECK(groups.high == 1.0);
  CHECK(items.low > 0.0);
  CHECK(items.high < 1.0);
  CHECK(bootstrap({{1.0, 2.0}, {}, {9.0}}, Statistic::median, 3).value == 2.0);
}

TEST_CASE("a ratio is that of the sums; rounds without a denominator do not count") {
  const Interval precision = bootstrap_ratio({{{1.0, 1.0}, {0.0, 3.0}}, {{2.0, 4.0}}, {{0.0, 0.0}}}, 5);
  CHECK(precision.value == 0.375);
  CHECK(precision.low == 0.25);
  CHECK(precision.high == 0.5);
}

TEST_CASE("a seed gives the same numbers on every machine") {
  const auto is = [](const Interval& interval, double low, double high) {
    return interval.low == doctest::Approx(low).epsilon(1e-12) && interval.high == doctest::Approx(high).epsilon(1e-12);
  };
  // As an independent program computes them, with a Mersenne Twister of its own.
  CHECK(is(bootstrap(each_its_own_group(ten), Statistic::mean, 42), 0.94, 2.59));
  CHECK(is(bootstrap(each_its_own_group(ten), Statistic::median, 42, 500), 0.7, 2.3));
  const std::vector<std::vector<double>> groups = {{0.2, 1.5}, {0.9, 3.1, 0.4}, {2.2}, {1.1, 0.7, 5.0, 1.9}};
  CHECK(is(bootstrap(groups, Statistic::mean, 42), 1.0555555555555556, 2.18));
  const std::vector<std::vector<Fraction>> fractions = {{{3, 7}, {1, 9}}, {{2, 2}}, {{5, 11}}, {{0, 4}}, {{6, 6}}};
  CHECK(is(bootstrap_ratio(fractions, 42), 0.23809523809523808, 0.8));
  CHECK(!is(bootstrap(each_its_own_group(ten), Statistic::mean, 43), 0.94, 2.59));
}

TEST_CASE("intervals contain the truth about as often as they say") {
  std::mt19937_64 random(7);
  int containing = 0;
  constexpr int experiments = 300;
  for (int experiment = 0; experiment < experiments; ++experiment) {
    std::vector<double> values;
    for (int i = 0; i < 40; ++i) values.push_back(static_cast<double>(random() >> 11) * 0x1p-53);  // mean 0.5
    const Interval interval = bootstrap(each_its_own_group(values), Statistic::mean, random(), 400);
    CHECK(interval.low < interval.value);
    CHECK(interval.value < interval.high);
    containing += interval.low < 0.5 && 0.5 < interval.high ? 1 : 0;
  }
  CHECK(containing > experiments * 90 / 100);
  CHECK(containing < experiments * 99 / 100);
}

TEST_CASE("no items and items that are no numbers are refused") {
  CHECK_THROWS_AS(mean({}), std::invalid_argument);
  CHECK_THROWS_AS(mean({1.0, no_number}), std::invalid_argument);
  CHECK_THROWS_AS(quantile({}, 0.5), std::invalid_argument);
  CHECK_THROWS_AS(quantile({1.0, infinity}, 0.5), std::invalid_argument);
  CHECK_THROWS_AS(quantile({1.0}, 1.1), std::invalid_argument);
  CHECK_THROWS_AS(quantile({1.0}, no_number), std::invalid_argument);
  for (const Statistic statistic : {Statistic::mean, Statistic::median}) {
    CHECK_THROWS_AS(bootstrap({}, statistic, 1), std::invalid_argument);
    CHECK_THROWS_AS(bootstrap({{}, {}}, statistic, 1), std::invalid_argument);
    CHECK_THROWS_AS(bootstrap({{1.0}, {no_number}}, statistic, 1), std::invalid_argument);
    CHECK_THROWS_AS(bootstrap({{1.0}}, statistic, 1, 0), std::invalid_argument);
  }
  CHECK_THROWS_AS(bootstrap_ratio({}, 1), std::invalid_argument);
  CHECK_THROWS_AS(bootstrap_ratio({{{0.0, 0.0}}}, 1), std::invalid_argument);
  CHECK_THROWS_AS(bootstrap_ratio({{{no_number, 1.0}}}, 1), std::invalid_argument);
  CHECK_THROWS_AS(bootstrap_ratio({{{1.0, infinity}}}, 1), std::invalid_argument);
  CHECK_THROWS_AS(bootstrap_ratio({{{1.0, -1.0}}}, 1), std::invalid_argument);
}

}  // namespace test_campaign_statistics
