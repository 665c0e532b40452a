// Descriptors in nibbles: every code's borders, signs, what is no descriptor value, in place, the exact distance, and
// matches of rows of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "fixtures.hpp"

namespace test_nibbles {
namespace {

using namespace unit;
using ss::Status;

using Nibbles95 = ss::NibbleDescriptor<ss::ShapeColor95>;
static_assert(std::is_trivial_v<Nibbles95> && alignof(Nibbles95) == 1 && sizeof(Nibbles95) == 95);
static_assert(sizeof(ss::NibbleDescriptor<ss::ShapeColor32>) == 32 && sizeof(ss::NibbleDescriptor<ss::Scsh336>) == 168);
static_assert(sizeof(ss::NibbleDescriptor<ss::RoomColor95>) == 95 &&
              sizeof(ss::NibbleDescriptor<ss::ColorRings27>) == 27 &&
              sizeof(ss::NibbleDescriptor<ss::HeightShape96>) == 96);
static_assert(Nibbles95::step == 1.0f / 50.0f);

/// Signed values first, as in ShapeColor32, and an odd number of them all.
using Odd = ss::Descriptor<ss::MultilinearVoting, ss::ColorMeansPart<ss::SphericalGrid<1, 1, 1>, 100>,
                           ss::ColorRingsPart<1, ss::LabAxis::L, 4>>;
static_assert(Odd::size == 7);
using OddNibbles = ss::NibbleDescriptor<Odd, 32>;

int naive_code(float value, bool has_sign) {
  if (std::isnan(value)) return 0;
  const double steps = static_cast<double>(value) * 32.0;
  if (!has_sign) return static_cast<int>(std::floor(std::clamp(steps, 0.0, 15.0) + 0.5));
  const double high = std::floor(std::min(std::abs(steps), 7.0) + 0.5);
  return static_cast<int>(steps < 0.0 ? -high : high);
}

template <class D, int Scale>
ss::NibbleDescriptor<D, Scale> nibbles_of(const std::vector<float>& values) {
  ss::NibbleDescriptor<D, Scale> nibbles;
  std::memset(&nibbles, 0xA5, sizeof nibbles);
  ss::quantize(values.data(), nibbles);
  return nibbles;
}

std::vector<float> any_values(Random& random, std::size_t size) {
  std::vector<float> values(size);
  for (float& value : values) {
    const std::size_t kind = random.below(20);
    value = kind == 0 ? infinity : kind == 1 ? -infinity : kind == 2 ? not_a_number : random.between(-0.3f, 0.6f);
  }
  return values;
}

template <class D, int Scale>
std::vector<ss::NibbleDescriptor<D, Scale>> random_rows(std::uint32_t seed, std::size_t count) {
  Random random(seed);
  std::vector<ss::NibbleDescriptor<D, Scale>> rows;
  for (std::size_t i = 0; i < count; ++i) {
    rows.push_back(nibbles_of<D, Scale>(any_values(random, static_cast<std::size_t>(D::size))));
  }
  return rows;
}

}  // namespace

TEST_CASE("nibbles: each value is its nearest code, with signs where its part has them") {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<float> values = any_values(random, 7);
    if (trial < 200) {  // on the borders of codes, and the next floats to both sides
      const float border = (static_cast<float>(trial % 40) - 10.0f + 0.5f) / 32.0f;
      const float next = std::nextafter(border, trial % 3 == 0 ? -1.0f : 1.0f);
      values.assign(7, trial % 3 == 1 ? border : next);
    }
    const OddNibbles nibbles = nibbles_of<Odd, 32>(values);
    float back[7];
    ss::dequantize(nibbles, back);
    for (std::size_t i = 0; i < 7; ++i) {
      const bool has_sign = i < 3;
      const int stored = i % 2 == 0 ? nibbles.bytes[i / 2] & 15 : nibbles.bytes[i / 2] >> 4;
      const int expected = naive_code(values[i], has_sign);
      CAPTURE(values[i]);
      CHECK(stored == expected + (has_sign ? 8 : 0));
      CHECK(back[i] == static_cast<float>(expected) / 32.0f);
    }
    CHECK((nibbles.bytes[3] >> 4) == 0);
  }
}

TEST_CASE("nibbles: in place, too") {
  Random random(2);
  union {
    float values[190];
    Nibbles95 nibbles;
  } both;
  const std::vector<float> values = any_values(random, 190);
  std::memcpy(both.values, values.data(), sizeof both.values);
  ss::quantize(both.values, both.nibbles);
  const Nibbles95 expected = nibbles_of<ss::ShapeColor95, 50>(values);
  CHECK(std::memcmp(&both.nibbles, &expected, sizeof expected) == 0);
}

TEST_CASE("nibbles: the distance is that of the values they stand for, exactly") {
  const auto check = [](auto rows) {
    using Nibbles = typename decltype(rows)::value_type;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      std::vector<float> a(static_cast<std::size_t>(Nibbles::size)), b(a.size());
      ss::dequantize(rows[i - 1], a.data());
      ss::dequantize(rows[i], b.data());
      long expected = 0;
      for (std::size_t k = 0; k < a.size(); ++k) {
        const long difference = std::lround((a[k] - b[k]) / Nibbles::step);
        expected += difference * difference;
      }
      CHECK(static_cast<long>(ss::squared_distance(rows[i - 1], rows[i])) == expected);
      CHECK(ss::squared_distance(rows[i], rows[i]) == 0);
    }
  };
  check(random_rows<ss::ShapeColor95, 50>(3, 50));
  check(random_rows<ss::ShapeColor32, 40>(4, 50));
  check(random_rows<Odd, 32>(5, 50));
  check(random_rows<ss::Scsh336, 32>(6, 50));
}

TEST_CASE("nibbles: rows of them are matched like rows of the values they stand for") {
  const auto database = random_rows<ss::ShapeColor32, 40>(7, 300);
  const auto queries = random_rows<ss::ShapeColor32, 40>(8, 70);
  std::vector<Status> status(database.size(), Status::ok);
  status[5] = Status::too_few_neighbors;
  const ss::NibbleRows from = ss::rows_of(queries);
  const ss::NibbleRows to = ss::rows_of(database, status.data());
  std::vector<ss::Match> matches;
  REQUIRE(ss::nearest(from, to, 2, matches, 2u) == Status::ok);
  for (std::size_t q = 0; q < queries.size(); ++q) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
    for (std::size_t row = 0; row < database.size(); ++row) {
      if (row != 5) {
        all.emplace_back(ss::squared_distance(queries[q], database[row]), static_cast<std::uint32_t>(row));
      }
    }
    std::sort(all.begin(), all.end());
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK(matches[2 * q + k].row == all[k].second);
      CHECK(matches[2 * q + k].distance == doctest::Approx(std::sqrt(static_cast<double>(all[k].first)) / 40.0));
    }
  }
  std::vector<ss::MatchedPair> pairs;
  CHECK(ss::reciprocal_correspondences(from, from, pairs) == Status::ok);
  CHECK(pairs.size() == queries.size());

  ss::NibbleRows other_step = to;
  other_step.step = 0.5f;
  CHECK(ss::nearest(from, other_step, 1, matches) == Status::bad_rows);
  const ss::NibbleRows missing{nullptr, 3, 32, 0.02f, nullptr};
  CHECK(ss::nearest(missing, missing, 1, matches) == Status::bad_rows);
  CHECK((ss::validate(from) == Status::ok && ss::validate(missing) == Status::bad_rows));
}

}  // namespace test_nibbles
