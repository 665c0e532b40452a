// Signs of sparse sums: next to the recipe with the standard library's generator, and distances.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <type_traits>
#include <vector>

#include "descriptor_rows.hpp"
#include "fixtures.hpp"

namespace test_sum_bits {
namespace {

using namespace unit;
using ss::Status;

using D = ss::ShapeColor95;
using Bits = ss::SumBits<D>;
static_assert(std::is_trivial_v<Bits> && alignof(Bits) == 1 && sizeof(Bits) == 44 && Bits::bits == 352);
static_assert(sizeof(ss::SumBits<D, 256, 6>) == 32);

/// x_0 ... x_189 are the codes; for each bit some draws g() mod 190 with signs -, +, -, +, ...
std::vector<bool> recipe(const ss::NibbleDescriptor<D>& nibbles, int bits, int draws) {
  std::vector<int> x;
  for (std::size_t i = 0; i < 190; ++i) {
    const int stored = i % 2 == 0 ? nibbles.bytes[i / 2] & 15 : nibbles.bytes[i / 2] >> 4;
    x.push_back(i >= 64 && i < 136 ? stored - 8 : stored);
  }
  std::mt19937 g(1);
  std::vector<bool> all;
  for (int bit = 0; bit < bits; ++bit) {
    int sum = 0;
    for (int k = 0; k < draws; ++k) {
      const int value = x[g() % 190];
      sum += k % 2 == 0 ? -value : value;
    }
    all.push_back(sum > 0);
  }
  return all;
}

std::vector<ss::NibbleDescriptor<D>> random_nibbles(std::uint32_t seed, std::size_t count) {
  Random random(seed);
  std::vector<ss::NibbleDescriptor<D>> all(count);
  for (auto& nibbles : all) {
    std::vector<float> values(D::size);
    for (float& value : values) value = random.below(3) == 0 ? 0.0f : random.between(-0.15f, 0.2f);
    ss::quantize(values.data(), nibbles);
  }
  return all;
}

template <int BitCount, int Draws>
void check_recipe() {
  for (const auto& nibbles : random_nibbles(5, 30)) {
    ss::SumBits<D, BitCount, Draws> bits;
    ss::binarize(nibbles, bits);
    const std::vector<bool> expected = recipe(nibbles, BitCount, Draws);
    int wrong = 0, ones = 0;
    for (std::size_t j = 0; j < expected.size(); ++j) {
      wrong += (bits.bytes[j / 8] >> j % 8 & 1) == (expected[j] ? 1 : 0) ? 0 : 1;
      ones += expected[j] ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK((ones > BitCount / 4 && ones < 3 * BitCount / 4));
  }
}

}  // namespace

TEST_CASE("sum bits: the generator is the standard library's") {
  std::mt19937 theirs(1);
  ss::detail::MersenneTwister mine(1);
  for (int i = 0; i < 3000; ++i) REQUIRE(mine() == theirs());
}

TEST_CASE("sum bits: as the recipe has them, 352 of four draws and 256 of six") {
  check_recipe<352, 4>();
  check_recipe<256, 6>();
}

TEST_CASE("sum bits: distances, and rows of them") {
  const auto nibbles = random_nibbles(6, 50);
  std::vector<Bits> bits(nibbles.size());
  for (std::size_t i = 0; i < bits.size(); ++i) ss::binarize(nibbles[i], bits[i]);
  const ss::BitRows rows = ss::rows_of(bits);
  CHECK((rows.count == 50 && rows.size == 44));
  for (std::size_t i = 1; i < bits.size(); ++i) {
    const std::vector<bool> a = recipe(nibbles[0], 352, 4), b = recipe(nibbles[i], 352, 4);
    int differ = 0;
    for (std::size_t j = 0; j < a.size(); ++j) differ += a[j] != b[j] ? 1 : 0;
    CHECK(ss::hamming_distance(bits[0], bits[i]) == differ);
    CHECK(rows.compare(0, rows, i) == static_cast<std::uint32_t>(differ));
  }
  std::vector<ss::Match> out;
  REQUIRE(ss::nearest(rows, rows, 1, out) == Status::ok);
  CHECK((out[7].row == 7 && out[7].distance == 0.0f));
}

}  // namespace test_sum_bits
