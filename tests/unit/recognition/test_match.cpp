// nearest() and reciprocal_correspondences() next to a double loop over all pairs.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "descriptor_rows.hpp"
#include "fixtures.hpp"

namespace test_match {
namespace {

using namespace unit;
using ss::Status;

/// The definition: all distances, in stable order.
std::vector<ss::Match> all_by_distance(const Rows& queries, std::size_t query, const Rows& database) {
  std::vector<ss::Match> all;
  for (std::size_t row = 0; row < database.count() && queries.is_ok(query); ++row) {
    if (!database.is_ok(row)) continue;
    all.push_back({static_cast<std::uint32_t>(row), distance(queries, query, database, row)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const ss::Match& a, const ss::Match& b) { return a.distance < b.distance; });
  return all;
}

/// For rows whose distances are exact.
bool is_as_defined(const std::vector<ss::Match>& out, const Rows& queries, const Rows& database, std::size_t k) {
  for (std::size_t query = 0; query < queries.count(); ++query) {
    std::vector<ss::Match> expected = all_by_distance(queries, query, database);
    expected.resize(std::max(k, expected.size()), {ss::no_row, infinity});
    for (std::size_t i = 0; i < k; ++i) {
      const ss::Match& match = out[query * k + i];
      if (match.row != expected[i].row || match.distance != expected[i].distance) return false;
    }
  }
  return true;
}

/// The definition: pairs that are nearest in both directions.
std::vector<ss::MatchedPair> mutual(const Rows& source, const Rows& target) {
  std::vector<ss::MatchedPair> pairs;
  for (std::size_t s = 0; s < source.count(); ++s) {
    const std::vector<ss::Match> there = all_by_distance(source, s, target);
    if (there.empty() || all_by_distance(target, there[0].row, source)[0].row != s) continue;
    pairs.push_back({static_cast<std::uint32_t>(s), there[0].row, there[0].distance});
  }
  return pairs;
}

struct Sizes {
  std::size_t queries, database, size, k;
};

}  // namespace

TEST_CASE("match: the nearest rows are those of a sort by distance, whatever the numbers of rows and values") {
  const Sizes all[] = {{1, 1, 1, 1},    {1, 1, 1, 3},       {5, 3, 7, 5},      {40, 60, 1, 4},
                       {3, 1500, 2, 2}, {129, 1025, 33, 3}, {128, 1024, 8, 1}, {150, 20, 336, 2}};
  for (const Sizes& sizes : all) {
    CAPTURE(sizes.queries);
    const Rows queries = dyadic_rows(1, sizes.queries, sizes.size);
    const Rows database = dyadic_rows(2, sizes.database, sizes.size);
    CHECK(is_as_defined(nearest(queries, database, sizes.k), queries, database, sizes.k));
    CHECK(same(reciprocal(queries, database), mutual(queries, database)));
  }
}

TEST_CASE("match: distances of rows that are close, but far from the origin, do not suffer from cancellation") {
  const std::size_t size = 65;
  Random random(3);
  Rows queries{size, {}, {}};
  Rows database{size, {}, {}};
  for (std::size_t v = 0; v < size; ++v) queries.values.push_back(random.dyadic(500.0f, 1000.0f, 10));
  for (int row = 300; row > 0; --row) {  // ever closer, by less than the products' rounding
    for (std::size_t v = 0; v < size; ++v) {
      const float step = v == 0 ? static_cast<float>(row) / 1024.0f : 0.0f;
      database.values.push_back(queries.values[v] + step);
    }
  }
  const std::vector<ss::Match> out = nearest(queries, database, 3);
  CHECK(is_as_defined(out, queries, database, 3));
  CHECK(out[0].row == 299);
  CHECK(out[0].distance == 1.0f / 1024.0f);
}

TEST_CASE("match: of rows whose squares round, none is nearer by more than that rounding") {
  const Rows queries = random_rows(18, 140, 336);
  const Rows database = random_rows(19, 230, 336);
  const std::vector<ss::Match> out = nearest(queries, database, 2);
  for (std::size_t query = 0; query < queries.count(); ++query) {
    const std::vector<ss::Match> expected = all_by_distance(queries, query, database);
    for (std::size_t i = 0; i < 2; ++i) {
      const ss::Match& match = out[2 * query + i];
      REQUIRE(std::fabs(match.distance - expected[i].distance) < 1e-5f);
      REQUIRE(std::fabs(match.distance - distance(queries, query, database, match.row)) < 1e-5f);
    }
  }
}

TEST_CASE("match: of rows that are as near the first ones win, however many there are") {
  Rows queries = dyadic_rows(4, 3, 20);
  const Rows other = dyadic_rows(5, 1, 20);
  Rows database{20, {}, {}};
  for (int copy = 0; copy < 1200; ++copy) {
    const float* row = copy % 2 == 0 ? other.values.data() : queries.values.data() + 20;
    database.values.insert(database.values.end(), row, row + 20);
  }
  const std::vector<ss::Match> out = nearest(queries, database, 4);
  CHECK(is_as_defined(out, queries, database, 4));
  for (std::uint32_t i = 0; i < 4; ++i) CHECK(out[4 + i].row == 2 * i + 1);
  const std::vector<ss::MatchedPair> pairs = reciprocal(database, database);
  REQUIRE(pairs.size() == 2);  // the first of each kind with itself
  CHECK((pairs[0].source == 0 && pairs[0].target == 0 && pairs[1].source == 1 && pairs[1].target == 1));
}

TEST_CASE("match: values of any magnitude, zeros too") {
  for (const int exponent : {-70, -30, 50, -1000}) {  // squares below the normal numbers; ...; only zeros
    CAPTURE(exponent);
    Rows queries = dyadic_rows(6, 30, 17);
    Rows database = dyadic_rows(7, 40, 17);
    for (float& value : queries.values) value = std::ldexp(value, exponent);
    for (float& value : database.values) value = std::ldexp(value, exponent);
    CHECK(is_as_defined(nearest(queries, database, 2), queries, database, 2));
    CHECK(same(reciprocal(queries, database), mutual(queries, database)));
  }
}

TEST_CASE("match: rows whose status is not ok, or whose values are no numbers, match nobody") {
  Rows queries = dyadic_rows(8, 140, 12);
  Rows database = dyadic_rows(9, 1100, 12);
  queries.status.assign(queries.count(), Status::ok);
  database.status.assign(database.count(), Status::ok);
  for (std::size_t i = 0; i < queries.count(); i += 3) queries.status[i] = Status::too_few_neighbors;
  for (std::size_t i = 0; i < database.count(); i += 2) database.status[i] = Status::ambiguous_frame;
  queries.values[0] = not_a_number;  // of a row that is left out: spoils no other
  database.values[0] = infinity;
  CHECK(is_as_defined(nearest(queries, database, 2), queries, database, 2));
  CHECK(same(reciprocal(queries, database), mutual(queries, database)));

  Rows unusable_queries = queries;
  Rows unusable_database = database;
  unusable_queries.values[12] = not_a_number;  // row 1
  unusable_queries.values[24] = 1e19f;         // row 2: squared distances could overflow
  unusable_database.values[12] = not_a_number;
  unusable_database.values[36] = -infinity;                                          // row 3
  for (std::size_t v = 0; v < 12; ++v) unusable_queries.values[4 * 12 + v] = 1e30f;  // products: infinity
  for (std::size_t v = 0; v < 12; ++v) unusable_database.values[5 * 12 + v] = 3e38f;
  for (const std::size_t row : {1u, 2u, 4u}) queries.status[row] = Status::bad_frame;
  for (const std::size_t row : {1u, 3u, 5u}) database.status[row] = Status::bad_frame;
  CHECK(is_as_defined(nearest(unusable_queries, unusable_database, 2), queries, database, 2));
  CHECK(same(reciprocal(unusable_queries, unusable_database), mutual(queries, database)));

  database.status.assign(database.count(), Status::too_few_neighbors);
  CHECK(is_as_defined(nearest(queries, database, 2), queries, database, 2));
  CHECK(reciprocal(queries, database).empty());
}

TEST_CASE("match: no rows, no matches") {
  const Rows some = dyadic_rows(10, 4, 5);
  const Rows none{5, {}, {}};
  CHECK(nearest(none, some, 2).empty());
  CHECK(is_as_defined(nearest(some, none, 2), some, none, 2));
  CHECK(reciprocal(none, some).empty());
  CHECK(reciprocal(some, none).empty());
}

TEST_CASE("match: rows that do not fit each other, and options out of range, are refused") {
  const Rows rows = dyadic_rows(11, 4, 6);
  const ss::DescriptorRows good = rows.view();
  const ss::DescriptorRows bad[] = {{nullptr, 4, 6, nullptr},
                                    {good.values, 4, 0, nullptr},
                                    {good.values, 8, 3, nullptr},
                                    {good.values, ss::no_row, 6, nullptr}};
  std::vector<ss::Match> matches(3);
  std::vector<ss::MatchedPair> pairs(3);
  for (const ss::DescriptorRows& other : bad) {
    CHECK(ss::nearest(other, good, 1, matches) == Status::bad_rows);
    CHECK(ss::nearest(good, other, 1, matches) == Status::bad_rows);
    CHECK(ss::reciprocal_correspondences(good, other, pairs) == Status::bad_rows);
    CHECK(ss::reciprocal_correspondences(other, good, pairs) == Status::bad_rows);
    CHECK(matches.empty());
    CHECK(pairs.empty());
  }
  for (const std::size_t k : {std::size_t{0}, std::numeric_limits<std::size_t>::max()}) {
    matches.resize(3);
    CHECK(ss::nearest(good, good, k, matches) == Status::bad_option);
    CHECK(matches.empty());
  }
}

}  // namespace test_match
