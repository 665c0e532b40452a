// Made-up rows of descriptors, and matching them.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace unit {

struct Rows {
  std::size_t size;
  std::vector<float> values;
  std::vector<ss::Status> status;  // none, or one per row

  [[nodiscard]] std::size_t count() const { return values.size() / size; }
  [[nodiscard]] bool is_ok(std::size_t row) const { return status.empty() || status[row] == ss::Status::ok; }
  [[nodiscard]] ss::DescriptorRows view() const {
    return {values.data(), count(), size, status.empty() ? nullptr : status.data()};
  }
};

/// Multiples of 1/16 from -2 to 2: squared distances of up to 2000 of them are exact in float, and often the same.
inline Rows dyadic_rows(std::uint32_t seed, std::size_t count, std::size_t size) {
  Random random(seed);
  Rows rows{size, {}, {}};
  for (std::size_t i = 0; i < count * size; ++i) rows.values.push_back(random.dyadic(-2.0f, 2.0f, 4));
  return rows;
}

/// What the sums of squares and of products round.
inline Rows random_rows(std::uint32_t seed, std::size_t count, std::size_t size) {
  Random random(seed);
  Rows rows{size, {}, {}};
  for (std::size_t i = 0; i < count * size; ++i) rows.values.push_back(random.between(-1.0f, 1.0f));
  return rows;
}

inline float distance(const Rows& a, std::size_t i, const Rows& b, std::size_t k) {
  double sum = 0.0;
  for (std::size_t v = 0; v < a.size; ++v) {
    const double d = static_cast<double>(a.values[i * a.size + v]) - static_cast<double>(b.values[k * b.size + v]);
    sum += d * d;
  }
  return static_cast<float>(std::sqrt(sum));
}

template <class Threads = unsigned>
std::vector<ss::Match> nearest(const Rows& queries, const Rows& database, std::size_t k, Threads&& threads = 1u) {
  std::vector<ss::Match> out(3);
  REQUIRE(ss::nearest(queries.view(), database.view(), k, out, threads) == ss::Status::ok);
  REQUIRE(out.size() == queries.count() * k);
  return out;
}

template <class Threads = unsigned>
std::vector<ss::MatchedPair> reciprocal(const Rows& source, const Rows& target, Threads&& threads = 1u) {
  std::vector<ss::MatchedPair> out(3);
  REQUIRE(ss::reciprocal_correspondences(source.view(), target.view(), out, threads) == ss::Status::ok);
  return out;
}

inline bool same(const std::vector<ss::Match>& a, const std::vector<ss::Match>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const ss::Match& x, const ss::Match& y) { return x.row == y.row && x.distance == y.distance; });
}

inline bool same(const std::vector<ss::MatchedPair>& a, const std::vector<ss::MatchedPair>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const ss::MatchedPair& x, const ss::MatchedPair& y) {
    return x.source == y.source && x.target == y.target && x.distance == y.distance;
  });
}

}  // namespace unit
