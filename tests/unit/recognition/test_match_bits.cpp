// Matching gives the same bits wherever rows are, and whoever does the work.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "descriptor_rows.hpp"
#include "fixtures.hpp"
#include "thread_pool.hpp"

namespace test_match_bits {
namespace {

using namespace unit;
using ss::Status;

bool same_bits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

struct Sizes {
  std::size_t queries, database, size;
};

/// The definition of a product's bits.
float product(const Rows& a, std::size_t i, const Rows& b, std::size_t k) {
  float sum = 0.0f;
  for (std::size_t v = 0; v < a.size; ++v)
    sum += ss::extend::unfused(a.values[i * a.size + v] * b.values[k * b.size + v]);
  return sum;
}

}  // namespace

TEST_CASE("match: products are summed up in one order, whatever the lanes, the tile and the thread") {
  for (const Sizes& sizes : {Sizes{150, 110, 37}, Sizes{1, 1, 1}, Sizes{17, 7, 336}}) {
    const Rows queries = random_rows(13, sizes.queries, sizes.size);
    const Rows database = random_rows(14, sizes.database, sizes.size);
    const ss::detail::ComparedRows from(queries.view());
    const ss::detail::ComparedRows to(database.view());
    for (const std::size_t threads : {1u, 2u}) {
      std::vector<int> seen(sizes.queries * sizes.database);
      std::vector<int> wrong(threads);
      const auto compare = [&](std::size_t thread, std::size_t first, std::size_t row,
                               const float(&products)[ss::detail::panel_rows]) {
        for (std::size_t q = first; q < std::min(first + ss::detail::panel_rows, sizes.queries); ++q) {
          ++seen[q * sizes.database + row];
          wrong[thread] += same_bits(products[q - first], product(queries, q, database, row)) ? 0 : 1;
        }
      };
      ss::detail::StartedThreads executor(threads);
      ss::detail::for_products(executor, threads, from, to, compare);
      CHECK(std::count(seen.begin(), seen.end(), 1) == static_cast<std::ptrdiff_t>(seen.size()));
      CHECK(std::count(wrong.begin(), wrong.end(), 0) == static_cast<std::ptrdiff_t>(threads));
    }
  }
}

TEST_CASE("match: a distance has the same bits wherever the two rows are") {
  const std::size_t size = 45;
  const Rows pair = random_rows(15, 2, size);
  std::vector<ss::Match> alone;
  REQUIRE(ss::nearest({pair.values.data(), 1, size, nullptr}, {pair.values.data() + size, 1, size, nullptr}, 1,
                      alone) == Status::ok);
  CHECK(static_cast<double>(alone[0].distance) == doctest::Approx(static_cast<double>(distance(pair, 0, pair, 1))));
  Rows queries = random_rows(16, 135, size);
  Rows database = random_rows(17, 200, size);
  for (float& value : queries.values) value += 10.0f;  // far from the pair
  for (float& value : database.values) value -= 10.0f;
  for (std::size_t at = 0; at < 135; at += 4) {
    Rows some_queries = queries;
    Rows some_rows = database;
    std::copy_n(pair.values.begin(), size, some_queries.values.begin() + static_cast<std::ptrdiff_t>(at * size));
    std::copy_n(pair.values.begin() + size, size, some_rows.values.begin() + static_cast<std::ptrdiff_t>(at * size));
    for (const unsigned threads : {1u, 2u}) {
      const ss::Match found = nearest(some_queries, some_rows, 2, threads)[2 * at];
      REQUIRE(found.row == at);
      REQUIRE(same_bits(found.distance, alone[0].distance));
    }
  }
}

TEST_CASE("match: the number of threads changes no bit") {
  Random random(12);
  Rows source{31, {}, {}};
  Rows target{31, {}, {}};
  for (int i = 0; i < 700 * 31; ++i) source.values.push_back(random.between(0.0f, 1.0f));
  for (const float value : source.values) target.values.push_back(value + random.between(-0.5f, 0.5f));
  target.values.resize(target.values.size() - 31 * std::size_t{41});
  for (int copy = 0; copy < 100; ++copy) {  // ties that different threads see
    source.values.insert(source.values.end(), source.values.begin(), source.values.begin() + 31 * 4);
  }
  const std::vector<ss::Match> matches = nearest(source, target, 3);
  const std::vector<ss::MatchedPair> pairs = reciprocal(source, target);
  CHECK(pairs.size() > 100);
  CHECK(pairs.size() < 600);
  CHECK(pairs[0].source == 0);  // not one of its copies
  for (const unsigned threads : {2u, 3u, 50u}) {
    CHECK(same(nearest(source, target, 3, threads), matches));
    CHECK(same(reciprocal(source, target, threads), pairs));
  }
  ThreadPool pool(3);
  CHECK(same(nearest(source, target, 3, pool), matches));
  CHECK(same(reciprocal(source, target, pool), pairs));
}

}  // namespace test_match_bits
