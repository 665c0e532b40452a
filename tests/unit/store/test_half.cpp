// Halves: all of them there and back, every border between two, what is no number, and matching as floats.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "descriptor_rows.hpp"
#include "fixtures.hpp"

namespace test_half {
namespace {

using namespace unit;
using ss::Status;
using ss::detail::float_of_half;
using ss::detail::half_of;

using D = ss::Ssh32;
using Half = ss::HalfDescriptor<D>;
static_assert(std::is_trivial_v<Half> && alignof(Half) == 2 && sizeof(Half) == 64 && Half::size_bytes == 64);

double naive(std::uint16_t half) {
  const int exponent = half >> 10 & 31, mantissa = half & 1023;
  const double high = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return (half & 0x8000) != 0 ? -high : high;
}

}  // namespace

TEST_CASE("half: every one of them is the float that IEEE 754 says, and comes back") {
  std::uint32_t wrong = 0;
  for (std::uint32_t bits = 0; bits < 0x10000u; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    if ((bits & 0x7C00u) == 0x7C00u) continue;
    const float value = float_of_half(half);
    wrong += static_cast<double>(value) == naive(half) && half_of(value) == half ? 0u : 1u;
  }
  CHECK(wrong == 0);
  CHECK((half_of(infinity) == 0x7C00 && half_of(-infinity) == 0xFC00 && half_of(not_a_number) % 0x8000 == 0x7E00));
  CHECK((float_of_half(0x7C00) == infinity && float_of_half(0xFC00) == -infinity && std::isnan(float_of_half(0x7E01))));
}

TEST_CASE("half: the nearest one, ties to even, at every border") {
  std::uint32_t wrong = 0;
  for (std::uint32_t bits = 0; bits < 0x7BFFu; ++bits) {
    const auto low = static_cast<std::uint16_t>(bits), high = static_cast<std::uint16_t>(bits + 1);
    const auto border = static_cast<float>((naive(low) + naive(high)) / 2.0);  // exact: it has one bit more
    wrong += half_of(border) == (bits % 2 == 0 ? low : high) ? 0u : 1u;
    wrong += half_of(std::nextafter(border, 0.0f)) == low && half_of(std::nextafter(border, 1e9f)) == high ? 0u : 1u;
    wrong += half_of(-border) == (0x8000u | (bits % 2 == 0 ? low : high)) ? 0u : 1u;
  }
  CHECK(wrong == 0);
  CHECK((half_of(65519.0f) == 0x7BFF && half_of(65520.0f) == 0x7C00 && half_of(1e38f) == 0x7C00));
  CHECK((half_of(1e-30f) == 0 && half_of(-1e-45f) == 0x8000));
}

TEST_CASE("half: rows are matched as rows of the floats that they stand for") {
  const Rows of_a = random_rows(1, 70, D::size), of_b = random_rows(2, 210, D::size);
  const auto halves_of = [](const Rows& rows, Rows& floats) {
    std::vector<Half> halves(rows.count());
    floats = rows;
    for (std::size_t i = 0; i < rows.count(); ++i) {
      ss::quantize(rows.values.data() + i * rows.size, halves[i]);
      ss::dequantize(halves[i], floats.values.data() + i * rows.size);
    }
    return halves;
  };
  Rows floats_a = of_a, floats_b = of_b;
  const std::vector<Half> a = halves_of(of_a, floats_a), b = halves_of(of_b, floats_b);
  std::vector<ss::Match> out;
  REQUIRE(ss::nearest(ss::rows_of(a), ss::rows_of(b), 3, out, 2u) == Status::ok);
  CHECK(same(out, nearest(floats_a, floats_b, 3)));
  CHECK(out[0].distance == ss::extend::simd::sqrt(ss::squared_distance(a[0], b[out[0].row])));
  std::vector<ss::MatchedPair> pairs;
  REQUIRE(ss::reciprocal_correspondences(ss::rows_of(a), ss::rows_of(b), pairs) == Status::ok);
  CHECK(same(pairs, reciprocal(floats_a, floats_b)));
  std::vector<Status> status(b.size(), Status::bad_frame);
  REQUIRE(ss::nearest(ss::rows_of(a), ss::rows_of(b, status.data()), 1, out) == Status::ok);
  CHECK(out[0].row == ss::no_row);
  CHECK(ss::nearest(ss::rows_of(a), ss::HalfRows{nullptr, 2, 32, nullptr}, 1, out) == Status::bad_rows);
  CHECK(ss::nearest(ss::rows_of(a), ss::HalfRows{b[0].values, 2, 31, nullptr}, 1, out) == Status::bad_rows);
}

}  // namespace test_half
