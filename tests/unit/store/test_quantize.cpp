// Descriptors in bytes: every code's borders, what is no descriptor value, in place, and the exact distance.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <type_traits>
#include <vector>

#include "fixtures.hpp"

namespace test_quantize {
namespace {

using namespace unit;

/// All that a descriptor must be to have bytes.
template <int Size>
struct Values {
  static constexpr int size = Size;
};

using Bytes336 = ss::ByteDescriptor<ss::Scsh336>;
static_assert(std::is_trivial_v<Bytes336> && alignof(Bytes336) == 1 && sizeof(Bytes336) == 336);
static_assert(Bytes336::size == 336 && Bytes336::size_bytes == 336 && Bytes336::step == 1.0f / 512.0f);

std::uint8_t quantized(float value) {
  ss::ByteDescriptor<Values<1>> byte = {{0xA5}};
  ss::quantize(&value, byte);
  return byte.bytes[0];
}

template <int Size>
std::vector<std::uint8_t> quantized(const std::vector<float>& values) {
  REQUIRE(values.size() == static_cast<std::size_t>(Size));
  ss::ByteDescriptor<Values<Size>> bytes;
  std::memset(&bytes, 0xA5, sizeof bytes);
  ss::quantize(values.data(), bytes);
  return {std::begin(bytes.bytes), std::end(bytes.bytes)};
}

/// The rule in double, where neither the product nor the sum is rounded.
std::uint8_t naive_byte(float value) {
  return static_cast<std::uint8_t>(std::floor(std::clamp(static_cast<double>(value) * 512.0, 0.0, 255.0) + 0.5));
}

/// Values from 0 to beyond the last code, many of them zero, now and then infinite or NaN.
std::vector<float> any_values(Random& random, std::size_t size) {
  std::vector<float> values(size);
  for (float& value : values) {
    const std::size_t kind = random.below(20);
    value = kind < 8 ? 0.0f : kind == 8 ? infinity : kind == 9 ? not_a_number : random.between(-0.01f, 0.6f);
  }
  return values;
}

template <int Size>
void check_in_place(std::uint32_t seed) {
  Random random(seed);
  const std::vector<float> values = any_values(random, Size);
  union {
    float values[Size];
    ss::ByteDescriptor<Values<Size>> bytes;
  } both;
  std::memcpy(both.values, values.data(), sizeof both.values);
  ss::quantize(both.values, both.bytes);
  const std::vector<std::uint8_t> expected = quantized<Size>(values);
  CHECK(std::equal(expected.begin(), expected.end(), both.bytes.bytes));
}

/// A descriptor of no use but its length: 1.
std::vector<float> unit_values(Random& random, std::size_t size) {
  std::vector<float> values(size);
  float squared = 0.0f;
  for (float& value : values) {
    value = random.below(3) == 0 ? random.between(0.0f, 1.0f) : 0.0f;
    squared += value * value;
  }
  for (float& value : values) value /= std::sqrt(squared);
  return values;
}

}  // namespace

TEST_CASE("quantize: each byte begins half a step below its value, and the last one goes on for ever") {
  for (int code = 1; code <= 255; ++code) {
    CAPTURE(code);
    const float first = (static_cast<float>(code) - 0.5f) / 512.0f;
    // The float below the first border is half a step too, in single precision.
    const float below = std::nextafter(code == 1 ? std::nextafter(first, 0.0f) : first, 0.0f);
    CHECK(quantized(first) == code);
    CHECK(quantized(below) == code - 1);
    CHECK(quantized(static_cast<float>(code) * Bytes336::step) == code);
  }
  for (const float value : {0.5f, 1.0f, 2.0f, 1e30f, std::numeric_limits<float>::max(), infinity}) {
    CHECK(quantized(value) == 255);
  }
}

TEST_CASE("quantize: floats of every size become the nearest byte, within half a step below the last one") {
  std::uint32_t wrong = 0, far = 0;
  const auto check = [&](std::uint32_t bits) {
    float value = 0.0f;
    std::memcpy(&value, &bits, sizeof value);
    const std::uint8_t byte = quantized(value);
    wrong += byte == naive_byte(value) ? 0u : 1u;
    const double error = std::abs(static_cast<double>(byte) / 512.0 - static_cast<double>(value));
    far += byte == 255 || error <= 1.0 / 1024.0 + 6e-11 ? 0u : 1u;
  };
  for (std::uint32_t bits = 0; bits <= 0x7F800000u; bits += 997) check(bits);           // to infinity
  for (std::uint32_t bits = 0x39000000u; bits <= 0x3F800000u; bits += 31) check(bits);  // 1/8192 to 1
  CHECK(wrong == 0);
  CHECK(far == 0);
}

TEST_CASE("quantize: NaN, zeros and what is negative are 0") {
  for (const float value : {0.0f, -0.0f, -1e-45f, -0.3f, -1e30f, -infinity, not_a_number, -not_a_number,
                            std::numeric_limits<float>::signaling_NaN(), 1e-45f, 1e-38f}) {
    CAPTURE(value);
    CHECK(quantized(value) == 0);
  }
}

TEST_CASE("quantize: values do not influence each other") {
  Random random(1);
  for (int round = 0; round < 100; ++round) {
    const std::vector<float> values = any_values(random, 67);
    std::vector<std::uint8_t> expected;
    for (const float value : values) expected.push_back(quantized(value));
    CHECK(quantized<67>(values) == expected);
  }
}

TEST_CASE("quantize: in place, the same bytes as in another place") {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    check_in_place<1>(seed);
    check_in_place<2>(seed);
    check_in_place<5>(seed);
    check_in_place<16>(seed);
    check_in_place<33>(seed);
    check_in_place<336>(seed);
    check_in_place<1344>(seed);
  }
}

TEST_CASE("quantize: the distance is the exact integer, up to what 32 bits can count") {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    ss::ByteDescriptor<Values<101>> a, b;
    std::uint64_t expected = 0;
    for (std::size_t i = 0; i < 101; ++i) {
      a.bytes[i] = random.byte();
      b.bytes[i] = random.byte();
      const int difference = int{a.bytes[i]} - int{b.bytes[i]};
      expected += static_cast<std::uint64_t>(difference * difference);
    }
    CHECK(ss::squared_distance(a, b) == expected);
    CHECK(ss::squared_distance(b, a) == expected);
    CHECK(ss::squared_distance(a, a) == 0);
  }
  constexpr int most = 66051;
  static ss::ByteDescriptor<Values<most>> none, all;
  std::memset(&none, 0, sizeof none);
  std::memset(&all, 255, sizeof all);
  CHECK(ss::squared_distance(none, all) == std::uint64_t{most} * 255 * 255);
  CHECK(ss::squared_distance(all, none) == std::uint64_t{most} * 255 * 255);
}

TEST_CASE("quantize: step times the root of it is the descriptors' distance, within the stated bound") {
  Random random(3);
  const double bound = std::sqrt(336.0) / 512.0;
  for (int round = 0; round < 200; ++round) {
    const std::vector<float> a = unit_values(random, 336), b = unit_values(random, 336);
    if (*std::max_element(a.begin(), a.end()) > 0.498f || *std::max_element(b.begin(), b.end()) > 0.498f) continue;
    const double expected = l2_distance(a, b);
    Bytes336 bytes_a, bytes_b;
    ss::quantize(a.data(), bytes_a);
    ss::quantize(b.data(), bytes_b);
    const double found = static_cast<double>(Bytes336::step) * std::sqrt(ss::squared_distance(bytes_a, bytes_b));
    CHECK(std::abs(found - expected) <= bound);
    CHECK(std::abs(found - expected) < 0.01);  // in practice, errors do not add up
  }
}

}  // namespace test_quantize
