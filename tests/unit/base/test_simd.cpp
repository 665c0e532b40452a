// The lane shim: what the passes rely on, for every mask.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace test_simd {
namespace {

using namespace unit;
namespace simd = ss::extend::simd;

constexpr std::size_t lanes = simd::lanes;

/// The lanes of `set`, one bit each.
simd::Mask mask_of(std::uint32_t set) {
  float values[lanes];
  for (std::size_t k = 0; k < lanes; ++k) values[k] = (set >> k & 1u) != 0 ? 1.0f : 0.0f;
  return simd::load(values) > simd::all(0.0f);
}

std::uint32_t set_of(simd::Mask mask) {
  float values[lanes];
  simd::store(values, simd::keep(mask, simd::all(1.0f)));
  std::uint32_t set = 0;
  for (std::size_t k = 0; k < lanes; ++k) set |= values[k] == 1.0f ? 1u << k : 0u;
  return set;
}

}  // namespace

TEST_CASE("simd: store() packs the lanes of every mask, in order, and writes no more than a register") {
  float values[lanes];
  std::uint32_t indices[lanes];
  for (std::size_t k = 0; k < lanes; ++k) {
    values[k] = k == 0 ? not_a_number : -1.5f - static_cast<float>(k);  // bits are moved, whatever they mean
    indices[k] = 0xFFFFFF00u + static_cast<std::uint32_t>(k);
  }
  for (std::uint32_t set = 0; set < 1u << lanes; ++set) {
    CAPTURE(set);
    const simd::Packing packing = simd::packing(mask_of(set));
    std::vector<float> floats(lanes + 1, 7.0f);
    std::vector<std::uint32_t> integers(lanes + 1, 7u);
    simd::store(floats.data(), simd::load(values), packing);
    simd::store(integers.data(), simd::load(indices), packing);
    std::uint32_t count = 0;
    for (std::size_t k = 0; k < lanes; ++k) {
      if ((set >> k & 1u) == 0) continue;
      CHECK(std::memcmp(&floats[count], &values[k], sizeof(float)) == 0);
      CHECK(integers[count] == indices[k]);
      ++count;
    }
    CHECK(packing.count == count);
    CHECK(floats.back() == 7.0f);
    CHECK(integers.back() == 7u);
  }
}

TEST_CASE("simd: first() and increment() count lanes") {
  for (std::size_t count = 1; count <= lanes; ++count) CHECK(set_of(simd::first(count)) == (1u << count) - 1u);
  for (std::uint32_t set = 0; set < 1u << lanes; ++set) {
    std::uint32_t after[lanes];
    const std::vector<std::uint32_t> before(lanes, 41u);
    simd::store(after, simd::increment(mask_of(set), simd::load(before.data())));
    for (std::size_t k = 0; k < lanes; ++k) CHECK(after[k] == 41u + (set >> k & 1u));
  }
}

TEST_CASE("simd: lanes from a function, bits there and back, products of 31 bits") {
  const float values[] = {1.5f, -0.0f, not_a_number, 3e38f, 1e-45f, -7.0f, 0.1f, 12345.0f};
  const simd::F32 made = simd::from_lanes([&](std::size_t k) { return values[k]; });
  float back[lanes];
  simd::store(back, simd::from_bits(simd::bits_of(made)));
  CHECK(std::memcmp(back, values, sizeof back) == 0);

  const std::uint32_t a[] = {0, 46340, 1, 65536, 2, 3, 32767, 2147483647};
  const std::uint32_t b[] = {2147483647, 46340, 2147483647, 32767, 1073741823, 715827882, 65536, 1};
  std::uint32_t product[lanes];
  simd::store(product, simd::product(simd::load(a), simd::load(b)));
  for (std::size_t k = 0; k < lanes; ++k) CHECK(product[k] == a[k] * b[k]);
}

TEST_CASE("simd: a lane of either mask") {
  for (std::uint32_t a = 0; a < 1u << lanes; ++a) {
    const std::uint32_t b = a * 5u % (1u << lanes);
    CHECK(set_of(mask_of(a) | mask_of(b)) == (a | b));
    CHECK(set_of(mask_of(a) & mask_of(b)) == (a & b));
  }
}

TEST_CASE("simd: numbers differ, zeros do not, and NaN differs from itself") {
  const float tiny = 1e-45f;
  const auto differ = [](float a, float b) { return any(simd::all(a) != simd::all(b)); };
  CHECK(differ(tiny, 0.0f));
  CHECK(differ(-1.0f, 1.0f));
  CHECK(!differ(-0.0f, 0.0f));
  CHECK(!differ(tiny, tiny));
  CHECK(differ(not_a_number, not_a_number));
}

TEST_CASE("simd: two registers in one of 16 bits, in order, with the arithmetic of one") {
  constexpr std::size_t both = 2 * lanes;
  std::uint32_t bits[both];
  std::int32_t numbers[both];
  for (std::size_t k = 0; k < both; ++k) {
    numbers[k] = k % 5 == 0 ? -32768 : k % 5 == 1 ? 32767 : static_cast<std::int32_t>(k * k * 23) - 700;
    bits[k] = static_cast<std::uint32_t>(numbers[k]);
  }
  const simd::I32 first = simd::load(bits), second = simd::load(bits + lanes);
  const simd::I16 a = narrow(first, second);
  const simd::I16 b = simd::like(a, 7);
  const auto check = [&](simd::I16 result, auto expected) {
    std::int16_t shorts[both + 1] = {};
    shorts[both] = 77;
    simd::store(shorts, result);
    for (std::size_t k = 0; k < both; ++k) CHECK(shorts[k] == static_cast<std::int16_t>(expected(numbers[k])));
    CHECK(shorts[both] == 77);
  };
  check(a, [](int x) { return x; });
  check(narrow(first > simd::all_int(100), second > simd::all_int(100)), [](int x) { return x > 100 ? -1 : 0; });
  check(a + b, [](int x) { return x + 7; });
  check(a - b, [](int x) { return x - 7; });
  check(a & b, [](int x) { return x & 7; });
  check(a | b, [](int x) { return x | 7; });
  check(a * b, [](int x) { return x * 7; });
  check(a == b, [](int x) { return x == 7 ? -1 : 0; });
  check(a > b, [](int x) { return x > 7 ? -1 : 0; });
  check(is_negative(a), [](int x) { return x < 0 ? -1 : 0; });
  check(small_min(a, b), [](int x) { return x < 7 ? x : 7; });
  check(small_max(a, b), [](int x) { return x > 7 ? x : 7; });
  check(keep(is_negative(a), b), [](int x) { return x < 0 ? 7 : 0; });
  check(drop(is_negative(a), b), [](int x) { return x < 0 ? 0 : 7; });
  check(minus_one_or_one(is_negative(a)), [](int x) { return x < 0 ? -1 : 1; });
  for (const int factor : {1, 2, 3, 8, 60}) {
    check(ss::extend::times(a, factor), [=](int x) { return x * factor; });
  }
}

TEST_CASE("simd: what goes from floats to integers, and masks of signs") {
  for (const float value : {-4194303.5f, -1.5f, -0.75f, -0.5f, -0.0f, 0.0f, 0.25f, 0.5f, 1.5f, 2.5f, 4194303.5f}) {
    CAPTURE(value);
    const auto each_is = [](simd::I32 result, double expected) {
      std::int32_t integers[lanes];
      simd::store(integers, result);
      for (const std::int32_t integer : integers) CHECK(static_cast<double>(integer) == expected);
    };
    each_is(round_to_int(simd::all(value)), std::nearbyint(static_cast<double>(value)));
    for (const float factor : {1.0f, 3.0f, 256.0f, 0.3f}) {
      each_is(truncated_product(simd::all(value), simd::all(factor)), std::trunc(static_cast<double>(value * factor)));
    }
    const auto whole = static_cast<std::int32_t>(value);
    const simd::I32 integer = simd::all_int(whole);
    each_is(minus_one_or_one(is_negative(integer)), whole < 0 ? -1.0 : 1.0);
    each_is(invert(is_negative(integer), integer), whole < 0 ? -1.0 - whole : whole);
    each_is(keep(is_negative(integer), simd::all_int(5)), whole < 0 ? 5.0 : 0.0);
    each_is(drop(is_negative(integer), simd::all_int(5)), whole < 0 ? 0.0 : 5.0);
    CHECK(any(is_negative(integer)) == (whole < 0));
  }
}

}  // namespace test_simd
