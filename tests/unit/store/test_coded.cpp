// Coded descriptors in every number of bits: codes next to a naive rule, layout, in place, exact distances, scales.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "fixtures.hpp"

namespace test_coded {
namespace {

using namespace unit;

using D = ss::ShapeColor95;
static_assert(sizeof(ss::CodedDescriptor<D, 3>) == 72 && sizeof(ss::CodedDescriptor<ss::ShapeColor32, 3>) == 24);
static_assert(sizeof(ss::CodedDescriptor<D, 4>) == 95 && sizeof(ss::CodedDescriptor<D, 8>) == 190);
static_assert(std::is_same_v<ss::NibbleDescriptor<D>, ss::CodedDescriptor<D, 4, 50>>);
static_assert(std::is_same_v<ss::ByteDescriptor<ss::Scsh336>, ss::CodedDescriptor<ss::Scsh336, 8, 512>>);
static_assert(ss::code_scale<D, 3> == 23 && ss::code_scale<ss::Scsh336, 3> == 15 && ss::code_scale<D, 8> == 360);
static_assert(std::is_trivial_v<ss::CodedDescriptor<D, 3>> && alignof(ss::CodedDescriptor<D, 3>) == 1);

bool has_sign(int value) { return value >= 64 && value < 136; }  // ShapeColor95's means

template <int Bits>
int naive_steps(float value, bool sign) {
  if (std::isnan(value)) return 0;
  const float half_steps = value * static_cast<float>(2 * ss::code_scale<D, Bits>);  // the one that is rounded
  const double steps = static_cast<double>(half_steps) / 2.0;
  const int most = sign ? (1 << (Bits - 1)) - 1 : (1 << Bits) - 1;
  const double high = std::floor(std::min(std::abs(steps), static_cast<double>(most)) + 0.5);
  return static_cast<int>(steps >= 0.0 ? high : sign ? -high : 0.0);
}

std::vector<float> any_values(Random& random) {
  std::vector<float> values(D::size);
  for (float& value : values) {
    const std::size_t kind = random.below(20);
    value = kind == 0 ? infinity : kind == 1 ? -infinity : kind == 2 ? not_a_number : random.between(-0.5f, 0.8f);
    if (kind < 9 && kind > 4) value = (std::floor(value * 23.0f) + 0.5f) / 23.0f;  // at the border of two codes, or so
  }
  return values;
}

/// Bit by bit, as the layout says.
template <int Bits>
int stored(const std::uint8_t* bytes, int value) {
  int number = 0;
  for (int k = 0; k < Bits; ++k) {
    const int bit = Bits * value + k;
    number |= (bytes[bit / 8] >> bit % 8 & 1) << k;
  }
  return number;
}

template <int Bits>
void check_codes() {
  using Coded = ss::CodedDescriptor<D, Bits>;
  Random random(Bits);
  Coded last{};
  std::vector<int> last_steps(D::size);
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<float> values = any_values(random);
    union {
      float values[D::size];
      Coded coded;
    } both;
    std::memcpy(both.values, values.data(), sizeof both.values);
    ss::quantize(both.values, both.coded);
    Coded coded;
    std::memset(&coded, 0xA5, sizeof coded);
    ss::quantize(values.data(), coded);
    REQUIRE(std::memcmp(&coded, &both.coded, sizeof coded) == 0);
    float back[D::size];
    ss::dequantize(coded, back);
    std::uint32_t squared = 0;
    for (int i = 0; i < D::size; ++i) {
      const int steps = naive_steps<Bits>(values[static_cast<std::size_t>(i)], has_sign(i));
      REQUIRE(stored<Bits>(coded.bytes, i) == steps + (has_sign(i) ? 1 << (Bits - 1) : 0));
      REQUIRE(back[i] == static_cast<float>(steps) * Coded::step);
      const int difference = steps - last_steps[static_cast<std::size_t>(i)];
      squared += static_cast<std::uint32_t>(difference * difference);
      last_steps[static_cast<std::size_t>(i)] = steps;
    }
    const int left_over = 8 * static_cast<int>(sizeof coded) - Bits * D::size;
    REQUIRE((left_over == 0 || coded.bytes[sizeof coded - 1] >> (8 - left_over) == 0));
    if (trial > 0) REQUIRE(ss::squared_distance(coded, last) == squared);
    last = coded;
  }
}

}  // namespace

TEST_CASE("coded: 3, 4 and 8 bits: nearest codes, layout, in place, and the exact distance") {
  check_codes<3>();
  check_codes<4>();
  check_codes<8>();
}

TEST_CASE("coded: distances of rows that end anywhere") {
  Random random(9);
  for (std::size_t size = 1; size < 80; ++size) {
    std::vector<std::uint8_t> a(size), b(size);
    for (std::size_t i = 0; i < size; ++i) a[i] = random.byte(), b[i] = random.byte();
    const auto check = [&](auto bits, std::uint32_t distance) {
      std::uint32_t expected = 0;
      for (int i = 0; i < static_cast<int>(size) * 8 / bits; ++i) {
        const int difference = stored<bits>(a.data(), i) - stored<bits>(b.data(), i);
        expected += static_cast<std::uint32_t>(difference * difference);
      }
      CHECK(distance == expected);
    };
    check(std::integral_constant<int, 3>{}, ss::detail::squared_code_distance<3>(a.data(), b.data(), size));
    check(std::integral_constant<int, 4>{}, ss::detail::squared_code_distance<4>(a.data(), b.data(), size));
    check(std::integral_constant<int, 8>{}, ss::detail::squared_code_distance<8>(a.data(), b.data(), size));
  }
}

TEST_CASE("coded: four bytes at a time, as instructions for halves have them") {
  namespace simd = ss::extend::simd;
  CHECK(simd::add_squared_differences(0x00FF01FFu, 0xFF0003FFu, 7) == 7u + 65025u + 65025u + 4u);
  CHECK(simd::add_squared_differences(0x01020304u, 0x04030201u, 0xFFFFFFFFu) == 19u);  // wraps
}

TEST_CASE("coded: steps of 1/360 cut off no value that compact descriptors can have") {
  // All points in one cell, in one bin of every color's histogram, or as far from the mean as colors can be.
  const double whole = std::sqrt(1.0 + 1.5 * 1.5);
  CHECK(1.0 / whole < 255.0 / 360.0);
  CHECK(1.5 / std::sqrt(3.0) / 1.5 < 255.0 / 360.0);
  CHECK(0.6 / whole < 127.0 / 360.0);
}

}  // namespace test_coded
