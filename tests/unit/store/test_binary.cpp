// B-SHOT's bits, against the published rule in double and against what its authors' code gives; the distance of bits.
#include <doctest/doctest.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "fixtures.hpp"

namespace test_binary {
namespace {

using namespace unit;
namespace detail = ss::detail;
namespace simd = ss::extend::simd;

/// All that a descriptor must be to have bits.
template <int Size>
struct Values {
  static constexpr int size = Size;
};

using Binary352 = ss::BinaryDescriptor<Values<352>>;
static_assert(std::is_trivial_v<Binary352> && alignof(Binary352) == 1 && sizeof(Binary352) == 44);
static_assert(Binary352::bits == 352 && Binary352::size_bytes == 44);
static_assert(ss::BinaryDescriptor<Values<9>, 5>::size_bytes == 2);

/// Four values' subsets in the order of the authors' code.
const std::vector<unsigned> published_order = {0b0001, 0b0010, 0b0100, 0b1000, 0b0011, 0b0110, 0b1100,
                                               0b1001, 0b1010, 0b0101, 0b0111, 0b1110, 0b1101, 0b1011};

/// The order for any group as its description says it: by number of values, then by the smallest number that rotating
/// makes, then by how far that one is rotated.
std::vector<unsigned> described_order(int group) {
  const unsigned whole = (1u << group) - 1u;
  std::vector<std::tuple<std::size_t, unsigned, int, unsigned>> keys;
  for (unsigned subset = 1; subset < whole; ++subset) {
    unsigned smallest = subset;
    int places = 0;
    for (int k = 1; k < group; ++k) {
      const unsigned turned_back = (subset >> k | subset << (group - k)) & whole;
      if (turned_back < smallest) {
        smallest = turned_back;
        places = k;
      }
    }
    keys.emplace_back(std::bitset<8>(subset).count(), smallest, places, subset);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<unsigned> order;
  order.reserve(keys.size());
  for (const auto& key : keys) order.push_back(std::get<3>(key));
  return order;
}

/// The published rule for one group: float sums, compared in double.
unsigned naive_group(const float* values, int group, const std::vector<unsigned>& order) {
  const auto sum_of = [&](unsigned subset) {
    float sum = 0.0f;
    for (int i = 0; i < group; ++i) sum += (subset >> i & 1u) != 0 ? values[i] : 0.0f;
    return sum;
  };
  const unsigned whole = (1u << group) - 1u;
  if (std::all_of(values, values + group, [](float value) { return value == 0.0f; })) return 0;
  const double limit = 0.9 * static_cast<double>(sum_of(whole));
  for (const unsigned subset : order) {
    if (static_cast<double>(sum_of(subset)) > limit) return subset;
  }
  return whole;
}

/// All bits; what the last group lacks is zero.
std::vector<std::uint8_t> naive_bits(std::vector<float> values, int group, const std::vector<unsigned>& order) {
  const std::size_t size = values.size();
  const auto width = static_cast<std::size_t>(group);
  std::vector<std::uint8_t> bytes((size + 7) / 8, 0);
  values.resize(size + width, 0.0f);
  for (std::size_t i = 0; i < size; i += width) {
    const unsigned bits = naive_group(&values[i], group, order);
    for (std::size_t j = i; j < std::min(i + width, size); ++j) {
      bytes[j / 8] = static_cast<std::uint8_t>(bytes[j / 8] | (bits >> (j - i) & 1u) << j % 8);
    }
  }
  return bytes;
}

template <int Size, int Group = 4>
std::vector<std::uint8_t> binarized(const std::vector<float>& values) {
  REQUIRE(values.size() == static_cast<std::size_t>(Size));
  ss::BinaryDescriptor<Values<Size>, Group> binary;
  std::memset(&binary, 0xA5, sizeof binary);
  ss::binarize(values.data(), binary);
  return {std::begin(binary.bytes), std::end(binary.bytes)};
}

/// Values as in descriptors: many zeros, few large ones, now and then ties, tiny values, NaN and infinity.
std::vector<float> sparse_values(Random& random, std::size_t size) {
  const float unit = std::ldexp(1.0f, static_cast<int>(random.below(5)) * -37);  // down to where all are subnormal
  std::vector<float> values(size);
  for (float& value : values) {
    switch (random.below(8)) {
      case 0: value = random.between(0.0f, 1.0f) * unit; break;
      case 1: value = static_cast<float>(random.below(11)) * unit; break;  // 0.9 S exactly, here and there
      case 2: value = random.between(0.0f, 0.1f) * unit; break;
      case 3: value = random.below(40) != 0 ? 0.0f : random.below(2) == 0 ? not_a_number : infinity; break;
      default: value = 0.0f;
    }
  }
  return values;
}

template <int Size, int Group>
void check_against_naive(std::uint32_t seed) {
  CAPTURE(Size);
  CAPTURE(Group);
  Random random(seed);
  const std::vector<unsigned> order = Group == 4 ? published_order : described_order(Group);
  for (int round = 0; round < 400; ++round) {
    const std::vector<float> values = sparse_values(random, static_cast<std::size_t>(Size));
    REQUIRE((binarized<Size, Group>(values) == naive_bits(values, Group, order)));
  }
}

/// Full groups, tails of groups, of bytes, of registers; less than a group.
template <int Group>
void check_sizes() {
  check_against_naive<352, Group>(1);
  check_against_naive<343, Group>(2);
  check_against_naive<65, Group>(3);
  check_against_naive<8 * Group - 1, Group>(4);
  check_against_naive<Group + 1, Group>(5);
  check_against_naive<1, Group>(6);

  const auto& of = detail::subsets<Group>.of;
  const std::vector<unsigned> tried(std::rbegin(of) + 1, std::rend(of) - 1);
  CHECK(tried == described_order(Group));
  CHECK(unsigned{of[0]} == (1u << Group) - 1u);
  CHECK(unsigned{of[detail::Subsets<Group>::count - 1]} == 0u);
}

float from_bits(std::uint32_t bits) {
  float value = 0.0f;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// The largest float that is not above the limit as the authors compute it.
float naive_limit(float sum) {
  const double limit = 0.9 * static_cast<double>(sum);
  const auto nearest = static_cast<float>(limit);
  return static_cast<double>(nearest) > limit ? std::nextafterf(nearest, 0.0f) : nearest;
}

std::vector<char> golden_array(const char* name) {
  std::ifstream file(std::string(SHORTSHOT_TEST_DATA "/edge/") + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::uint8_t> random_bytes(Random& random, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (std::uint8_t& byte : bytes) byte = random.byte();
  return bytes;
}

}  // namespace

TEST_CASE("binary: the bits that the authors' code gives for PCL's SHOT, NaN rows too") {
  const std::vector<char> shot = golden_array("shot352.bin");
  const std::vector<char> expected = golden_array("bshot.bin");
  REQUIRE(expected.size() == 36 * 44);
  REQUIRE(shot.size() == 36 * 352 * sizeof(float));
  for (std::size_t row = 0; row < 36; ++row) {
    CAPTURE(row);
    std::vector<float> values(352);
    std::memcpy(values.data(), &shot[row * 352 * sizeof(float)], 352 * sizeof(float));
    CHECK(std::memcmp(binarized<352>(values).data(), &expected[row * 44], 44) == 0);
  }
}

TEST_CASE("binary: the published rule, for groups of 2 to 8 and any size") {
  check_sizes<2>();
  check_sizes<3>();
  check_sizes<4>();
  check_sizes<5>();
  check_sizes<6>();
  check_sizes<7>();
  check_sizes<8>();
}

TEST_CASE("binary: every group of four from 0 to 10 units, in the published order; some pairs are exactly 0.9 S") {
  std::vector<unsigned> differs;
  const std::vector<unsigned> order = described_order(4);
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (order[k] != published_order[k]) differs.push_back(order[k]);
  }
  CHECK(differs == std::vector<unsigned>{0b0101, 0b1010});  // disjoint

  std::size_t ties = 0;
  for (const float unit : {1.0f, 0.1f, 1e-45f, 3e37f}) {  // of which some sums are infinite
    std::vector<float> values;
    for (int code = 0; code < 11 * 11 * 11 * 11; ++code) {
      float four[4] = {};
      int rest = code;
      for (float& value : four) {
        value = static_cast<float>(rest % 11) * unit;
        rest /= 11;
      }
      const float sum = four[0] + four[1] + four[2] + four[3];
      if (sum > 0.0f && static_cast<double>(four[0] + four[1]) == 0.9 * static_cast<double>(sum)) ++ties;
      values.insert(values.end(), four, four + 4);
    }
    CHECK(binarized<4 * 11 * 11 * 11 * 11>(values) == naive_bits(values, 4, published_order));
  }
  CHECK(ties > 40);
}

TEST_CASE("binary: the limit in single precision decides as 0.9 S in double, for every mantissa") {
  // Of subnormal numbers, of the smallest normal ones, of 1, of the largest ones; and of everything in coarse steps.
  const auto check = [](std::uint32_t first, std::uint32_t last, std::uint32_t step) {
    std::uint32_t wrong = 0;
    for (std::uint32_t bits = first; bits <= last; bits += step * static_cast<std::uint32_t>(simd::lanes)) {
      float sums[simd::lanes], limits[simd::lanes];
      for (std::size_t k = 0; k < simd::lanes; ++k) {
        sums[k] = from_bits(std::min(bits + step * static_cast<std::uint32_t>(k), last));
      }
      simd::store(limits, detail::nine_tenths(simd::load(sums)));
      for (std::size_t k = 0; k < simd::lanes; ++k) wrong += limits[k] == naive_limit(sums[k]) ? 0u : 1u;
    }
    CHECK(wrong == 0);
  };
  constexpr std::uint32_t mantissas = 1u << 23;
  check(0, 2 * mantissas, 1);
  check(127 * mantissas, 128 * mantissas, 1);
  check(254 * mantissas, 255 * mantissas, 1);  // and infinity
  check(0, 255 * mantissas, 997);
}

TEST_CASE("binary: what has no sum has all bits, in its group only") {
  std::vector<float> values(32, 0.0f);
  values[5] = not_a_number;
  values[8] = infinity;
  values[12] = values[13] = std::numeric_limits<float>::max();
  values[17] = -0.0f;
  values[20] = 1.0f;
  CHECK(binarized<32>(values) == std::vector<std::uint8_t>{0xF0, 0xFF, 0x10, 0x00});
}

TEST_CASE("binary: distances are what std::bitset counts, at any length and alignment") {
  Random random(7);
  for (std::size_t size = 0; size <= 100; ++size) {
    for (std::size_t offset = 0; offset < 3; ++offset) {
      const std::vector<std::uint8_t> a = random_bytes(random, size + offset), b = random_bytes(random, size + 5);
      std::size_t expected = 0;
      for (std::size_t i = 0; i < size; ++i) {
        expected += std::bitset<8>(static_cast<unsigned>(a[i + offset] ^ b[i])).count();
      }
      CHECK(ss::hamming_distance(a.data() + offset, b.data(), size) == static_cast<int>(expected));
    }
  }
}

TEST_CASE("binary: each bit counts as one, and distances are a metric") {
  Random random(8);
  Binary352 binary[3];
  for (int round = 0; round < 100; ++round) {
    for (Binary352& one : binary) {
      const std::vector<std::uint8_t> bytes = random_bytes(random, sizeof one);
      std::memcpy(&one, bytes.data(), sizeof one);
    }
    const auto distance = [&](int i, int j) { return ss::hamming_distance(binary[i], binary[j]); };
    CHECK(distance(0, 0) == 0);
    CHECK(distance(0, 1) == distance(1, 0));
    CHECK(distance(0, 2) <= distance(0, 1) + distance(1, 2));
    Binary352 opposite = binary[0];
    for (std::uint8_t& byte : opposite.bytes) byte = static_cast<std::uint8_t>(~byte);
    CHECK(ss::hamming_distance(binary[0], opposite) == 352);
  }
  for (unsigned j = 0; j < 352; ++j) {
    Binary352 other = binary[0];
    other.bytes[j / 8] = static_cast<std::uint8_t>(other.bytes[j / 8] ^ 1u << j % 8);
    CHECK(ss::hamming_distance(binary[0], other) == 1);
  }
}

}  // namespace test_binary
