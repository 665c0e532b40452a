// Distances that stop where they are too far: exact below the limit, and never below it where the rows are not.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace test_distance_below {
namespace {

using namespace unit;
using Bytes = std::vector<std::uint8_t>;

/// Rows of all lengths, alike in most places, or in few.
template <class Exact, class Below>
void check(const Exact& exact, const Below& below, std::size_t step) {
  Random random(3);
  for (std::size_t size = step; size <= 120; size += step) {
    for (int alike = 0; alike < 4; ++alike) {
      Bytes a(size), b(size);
      for (std::size_t i = 0; i < size; ++i) {
        a[i] = random.byte();
        b[i] = random.byte() < 80 * alike ? a[i] : random.byte();
      }
      const std::uint32_t distance = exact(a, b);
      const auto of = [&](std::uint32_t limit) { return below(a, b, limit); };
      REQUIRE(of(0xFFFFFFFFu) == distance);
      REQUIRE(of(distance + 1) == distance);
      for (std::uint32_t limit = 0; limit <= distance; limit += 1 + distance / 50) REQUIRE(of(limit) >= limit);
    }
  }
}

template <int Bits>
void check_codes(std::size_t step) {
  check([](const Bytes& a,
           const Bytes& b) { return ss::detail::squared_code_distance<Bits>(a.data(), b.data(), a.size()); },
        [](const Bytes& a, const Bytes& b, std::uint32_t limit) {
          return ss::detail::squared_code_distance_below<Bits>(a.data(), b.data(), a.size(), limit);
        },
        step);
}

}  // namespace

TEST_CASE("distance below: bits") {
  check([](const Bytes& a,
           const Bytes& b) { return static_cast<std::uint32_t>(ss::hamming_distance(a.data(), b.data(), a.size())); },
        [](const Bytes& a, const Bytes& b, std::uint32_t limit) {
          return ss::detail::hamming_distance_below(a.data(), b.data(), a.size(), limit);
        },
        1);
}

TEST_CASE("distance below: codes of 8, 4 and 3 bits") {
  check_codes<8>(1);
  check_codes<4>(1);
  check_codes<3>(3);
}

}  // namespace test_distance_below
