// Sums over packed rows: what they are, for every kind, next to plain loops; and that no row that is near is missed.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace test_simd_sums {
namespace {

using namespace unit;
namespace simd = ss::extend::simd;

/// Rows of codes up to `most`, as many as `Ops` sums up at the same time, one more, and the panel of the first ones.
template <class Ops>
struct Codes {
  std::size_t steps;
  std::vector<std::vector<unsigned>> numbers;
  std::vector<std::vector<typename Ops::Code>> codes;
  std::vector<typename Ops::Cell> panel;

  Codes(std::uint32_t seed, std::size_t step_count, unsigned most, unsigned scale)
      : steps(step_count), panel(step_count * Ops::step_cells) {
    Random random(seed);
    for (std::size_t row = 0; row <= Ops::rows; ++row) {
      numbers.emplace_back();
      codes.emplace_back();
      for (std::size_t i = 0; i < steps * Ops::step_codes; ++i) {
        const bool extreme = seed == 0 || random.below(3) == 0;
        numbers[row].push_back(extreme ? most : static_cast<unsigned>(random.below(most + 1)));
        codes[row].push_back(static_cast<typename Ops::Code>(numbers[row].back() * scale));
      }
    }
    for (std::size_t step = 0; step < steps; ++step) {
      const typename Ops::Code* rows[Ops::rows];
      for (std::size_t k = 0; k < Ops::rows; ++k) rows[k] = codes[k].data() + step * Ops::step_codes;
      Ops::pack(rows, panel.data() + step * Ops::step_cells);
    }
  }
  [[nodiscard]] typename Ops::Sums sums() const {
    typename Ops::Sums all = Ops::none();
    for (std::size_t step = 0; step < steps; ++step) {
      all = Ops::add(all, panel.data() + step * Ops::step_cells, codes.back().data() + step * Ops::step_codes);
    }
    return all;
  }
  [[nodiscard]] std::vector<std::uint32_t> widened() const {
    simd::I32 wide[Ops::rows / simd::lanes];
    Ops::widen(sums(), wide);
    std::vector<std::uint32_t> values(Ops::rows);
    for (std::size_t k = 0; k < Ops::rows; k += simd::lanes) simd::store(values.data() + k, wide[k / simd::lanes]);
    return values;
  }
  template <class Term>
  [[nodiscard]] std::vector<std::uint32_t> expected(Term term) const {
    std::vector<std::uint32_t> values(Ops::rows);
    for (std::size_t k = 0; k < Ops::rows; ++k) {
      for (std::size_t i = 0; i < numbers[k].size(); ++i) values[k] += term(numbers[k][i], numbers.back()[i]);
    }
    return values;
  }
};

std::uint32_t product(unsigned a, unsigned b) { return a * b; }
std::uint32_t bits(unsigned a, unsigned b) {
  return ((a ^ b) & 1u) + ((a ^ b) >> 1 & 1u) + ((a ^ b) >> 2 & 1u) + ((a ^ b) >> 3);
}

/// One limit for every row but one: is that one found, for every place that it may have?
template <class Ops>
void check_limits(const Codes<Ops>& rows, const std::vector<std::uint32_t>& sums, bool above) {
  using Limit = typename Ops::Limit;
  for (std::size_t k = 0; k < Ops::rows; ++k) {
    const auto sum = static_cast<int>(sums[k]);
    const int nobody = above ? 20000 : 0;
    for (const int row_limit : {0, 3}) {
      std::vector<Limit> limits(Ops::rows, static_cast<Limit>(nobody));
      CHECK(!Ops::any_near(rows.sums(), limits.data(), static_cast<Limit>(row_limit)));
      limits[k] = static_cast<Limit>(above ? sum - row_limit : sum + row_limit);  // at the limit: not near
      CHECK(!Ops::any_near(rows.sums(), limits.data(), static_cast<Limit>(row_limit)));
      limits[k] = static_cast<Limit>(above ? sum - row_limit - 1 : sum + row_limit + 1);
      CHECK(Ops::any_near(rows.sums(), limits.data(), static_cast<Limit>(row_limit)));
    }
  }
}

}  // namespace

TEST_CASE("simd sums: products of small and of large codes, the largest ones too") {
  for (const std::uint32_t seed : {0u, 1u, 2u}) {
    for (const std::size_t steps : {1u, 7u, 32u}) {
      const Codes<simd::SmallCodes> small(seed, steps, 15, 1);
      CHECK(small.widened() == small.expected(product));
      if (seed > 0) check_limits(small, small.expected(product), true);
      const Codes<simd::LargeCodes> large(seed, steps, 255, 1);
      CHECK(large.widened() == large.expected(product));
    }
    const Codes<simd::LargeCodes> wrapped(seed, 40000, 255, 1);  // modulo 2^32
    CHECK(wrapped.widened() == wrapped.expected(product));
  }
}

TEST_CASE("simd sums: limits saturate where small sums do") {
  const Codes<simd::SmallCodes> rows(0, 32, 15, 1);
  const std::vector<simd::SmallCodes::Limit> limits(simd::SmallCodes::rows, -16384);
  CHECK(simd::SmallCodes::any_near(rows.sums(), limits.data(), -16384));
  CHECK(simd::SmallCodes::any_near(rows.sums(), limits.data(), 16383));
}

TEST_CASE("simd sums: bits that differ, up to all of 62 half bytes") {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    for (const std::size_t steps : {1u, 9u, 62u}) {
      const Codes<simd::HalfBytes> rows(seed, steps, 15, 16);
      CHECK(rows.widened() == rows.expected(bits));
      check_limits(rows, rows.expected(bits), false);
    }
  }
  Codes<simd::HalfBytes> opposite(0, 62, 15, 16);
  for (auto& code : opposite.codes.back()) code = 0;
  CHECK(opposite.widened() == std::vector<std::uint32_t>(simd::HalfBytes::rows, 248));
}

}  // namespace test_simd_sums
