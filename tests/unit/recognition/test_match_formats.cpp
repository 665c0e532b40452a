// Rows of bytes, of nibbles, of bits, and in a format of one's own are matched as rows of floats are: next to a double
// loop.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "descriptor_rows.hpp"
#include "fixtures.hpp"
#include "thread_pool.hpp"

namespace test_match_formats {
namespace {

using namespace unit;
using ss::Status;

/// Lines on a map: two numbers a row, city blocks as their distance.
struct Places {
  const std::int16_t* xy;
  std::size_t count;
  const Status* status;

  [[nodiscard]] bool fits(const Places& other) const { return xy != nullptr && other.xy != nullptr; }
  [[nodiscard]] std::int64_t compare(std::size_t row, const Places& other, std::size_t others_row) const {
    const std::int64_t dx = xy[2 * row] - other.xy[2 * others_row];
    const std::int64_t dy = xy[2 * row + 1] - other.xy[2 * others_row + 1];
    return std::abs(dx) + std::abs(dy);
  }
  [[nodiscard]] static float distance(std::int64_t blocks) { return 0.1f * static_cast<float>(blocks); }
};
static_assert(ss::extend::is_row_format<Places> && ss::extend::is_row_format<ss::ByteRows> &&
                  ss::extend::is_row_format<ss::BitRows>,
              "can be matched");

struct WithoutDistance {
  std::size_t count;
  const Status* status;
  [[nodiscard]] bool fits(const WithoutDistance&) const { return true; }
  [[nodiscard]] int compare(std::size_t, const WithoutDistance&, std::size_t) const { return 0; }
};
static_assert(!ss::extend::is_row_format<WithoutDistance> && !ss::extend::is_row_format<int> &&
                  !ss::extend::is_row_format<ss::Features<ss::Ssh32>>,
              "cannot");

/// The storage behind rows, and the definition of their distance, as plainly as can be.
struct OfFloats {
  using Number = float;
  Rows rows;
  [[nodiscard]] ss::DescriptorRows view(const Status* status) const {
    return {rows.values.data(), rows.count(), rows.size, status};
  }
  static float distance(const OfFloats& a, std::size_t i, const OfFloats& b, std::size_t k) {
    return unit::distance(a.rows, i, b.rows, k);
  }
  static OfFloats make(std::uint32_t seed, std::size_t count) { return {dyadic_rows(seed, count, 13)}; }
};

struct OfBytes {
  static constexpr std::size_t size = 77;  // not whole pieces
  std::vector<std::uint8_t> values;
  [[nodiscard]] ss::ByteRows view(const Status* status) const {
    return {values.data(), values.size() / size, size, 1.0f / 512.0f, status};
  }
  static float distance(const OfBytes& a, std::size_t i, const OfBytes& b, std::size_t k) {
    std::uint32_t sum = 0;
    for (std::size_t v = 0; v < size; ++v) {
      const int difference = a.values[i * size + v] - b.values[k * size + v];
      sum += static_cast<std::uint32_t>(difference * difference);
    }
    return std::sqrt(static_cast<float>(sum)) / 512.0f;
  }
  static OfBytes make(std::uint32_t seed, std::size_t count) {
    Random random(seed);
    OfBytes rows;  // two values only, but for some: many ties
    for (std::size_t i = 0; i < count * size; ++i) {
      rows.values.push_back(i % size < 5 ? random.byte() & 0x81u : i % size == 70 ? 255 : 3);
    }
    return rows;
  }
};

/// A row like one of `kinds`, which are the same for all sets: as it is, or with some bytes changed, at its end or
/// anywhere; one in eight is the opposite of another.
void append_variant(Random& random, std::size_t kinds, std::size_t size, std::vector<std::uint8_t>& bytes) {
  Random kind(1000 + static_cast<std::uint32_t>(random.below(kinds)));
  const std::size_t variant = random.below(8);
  const std::size_t changed = random.below(size);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint8_t byte = kind.byte();
    const bool changes = variant == 1 ? i >= changed : variant > 5 && i % 7 == changed % 7;
    bytes.push_back(changes ? random.byte() : static_cast<std::uint8_t>(variant == 0 ? 255 - byte : byte));
  }
}

struct OfNibbles {
  static constexpr std::size_t size = 95;  // 190 numbers: chunks, and a part of one
  std::vector<std::uint8_t> bytes;
  [[nodiscard]] ss::NibbleRows view(const Status* status) const {
    return {bytes.data(), bytes.size() / size, size, 0.02f, status};
  }
  static float distance(const OfNibbles& a, std::size_t i, const OfNibbles& b, std::size_t k) {
    std::uint32_t sum = 0;
    for (std::size_t v = 0; v < size; ++v) {
      const int of_a = a.bytes[i * size + v], of_b = b.bytes[k * size + v];
      const int low = of_a % 16 - of_b % 16, high = of_a / 16 - of_b / 16;
      sum += static_cast<std::uint32_t>(low * low + high * high);
    }
    return 0.02f * std::sqrt(static_cast<float>(sum));
  }
  static OfNibbles make(std::uint32_t seed, std::size_t count) {
    Random random(seed);
    OfNibbles rows;
    for (std::size_t row = 0; row < count; ++row) append_variant(random, count, size, rows.bytes);
    return rows;
  }
};

template <std::size_t Size>
struct OfBits {
  static constexpr std::size_t size = Size;
  std::vector<std::uint8_t> bytes;
  [[nodiscard]] ss::BitRows view(const Status* status) const {
    return {bytes.data(), bytes.size() / size, size, status};
  }
  static float distance(const OfBits& a, std::size_t i, const OfBits& b, std::size_t k) {
    int differ = 0;
    for (std::size_t bit = 0; bit < 8 * size; ++bit) {
      const auto of = [&](const OfBits& rows, std::size_t row) {
        return rows.bytes[row * size + bit / 8] >> bit % 8 & 1;
      };
      differ += of(a, i) != of(b, k) ? 1 : 0;
    }
    return static_cast<float>(differ);
  }
  static OfBits make(std::uint32_t seed, std::size_t count) {
    Random random(seed);
    OfBits rows;
    for (std::size_t row = 0; row < count; ++row) append_variant(random, count, size, rows.bytes);
    return rows;
  }
};

struct OfPlaces {
  std::vector<std::int16_t> xy;
  [[nodiscard]] Places view(const Status* status) const { return {xy.data(), xy.size() / 2, status}; }
  static float distance(const OfPlaces& a, std::size_t i, const OfPlaces& b, std::size_t k) {
    return Places::distance(a.view(nullptr).compare(i, b.view(nullptr), k));
  }
  static OfPlaces make(std::uint32_t seed, std::size_t count) {
    Random random(seed);
    OfPlaces rows;
    for (std::size_t i = 0; i < 2 * count; ++i) rows.xy.push_back(static_cast<std::int16_t>(random.below(40)));
    return rows;
  }
};

/// Every third or so is not ok.
std::vector<Status> some_statuses(std::uint32_t seed, std::size_t count) {
  Random random(seed);
  std::vector<Status> status(count, Status::ok);
  for (Status& s : status) {
    if (random.below(3) == 0) s = Status::too_few_neighbors;
  }
  return status;
}

/// The definition: all distances, in stable order.
template <class Of>
std::vector<ss::Match> all_by_distance(const Of& queries, const std::vector<Status>& query_status, std::size_t query,
                                       const Of& database, const std::vector<Status>& status) {
  std::vector<ss::Match> all;
  for (std::size_t row = 0; row < status.size() && query_status[query] == Status::ok; ++row) {
    if (status[row] != Status::ok) continue;
    all.push_back({static_cast<std::uint32_t>(row), Of::distance(queries, query, database, row)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const ss::Match& a, const ss::Match& b) { return a.distance < b.distance; });
  return all;
}

template <class Of>
void require_as_defined(std::size_t count, std::size_t other_count, std::size_t k) {
  const Of source = Of::make(1, count);
  const Of target = Of::make(2, other_count);
  const std::vector<Status> source_status = some_statuses(3, count);
  const std::vector<Status> target_status = some_statuses(4, other_count);
  const auto from = source.view(source_status.data());
  const auto to = target.view(target_status.data());
  std::vector<ss::Match> expected;
  std::vector<ss::MatchedPair> mutual, distinct;
  for (std::size_t s = 0; s < count; ++s) {
    std::vector<ss::Match> all = all_by_distance(source, source_status, s, target, target_status);
    const auto number = static_cast<std::uint32_t>(s);
    if (all.size() > 1 && all[0].distance < ss::extend::unfused(0.9f * all[1].distance)) {
      distinct.push_back({number, all[0].row, all[0].distance});
    }
    if (!all.empty() && all_by_distance(target, target_status, all[0].row, source, source_status)[0].row == s) {
      mutual.push_back({number, all[0].row, all[0].distance});
    }
    all.resize(std::max(k, all.size()), {ss::no_row, infinity});
    expected.insert(expected.end(), all.begin(), all.begin() + static_cast<std::ptrdiff_t>(k));
  }
  ThreadPool pool(3);
  const auto check = [&](auto&& threads) {
    std::vector<ss::Match> matches(2);
    std::vector<ss::MatchedPair> pairs(2);
    REQUIRE(ss::nearest(from, to, k, matches, threads) == Status::ok);
    REQUIRE(same(matches, expected));
    REQUIRE(ss::reciprocal_correspondences(from, to, pairs, threads) == Status::ok);
    REQUIRE(same(pairs, mutual));
    REQUIRE(ss::ratio_correspondences(from, to, 0.9f, pairs, threads) == Status::ok);
    REQUIRE(same(pairs, distinct));
  };
  for (const unsigned threads : {1u, 2u, 7u}) check(threads);
  check(pool);
  if (count > 100) CHECK((!mutual.empty() && !distinct.empty() && distinct.size() < count / 2));
}

}  // namespace

TEST_CASE_TEMPLATE("match: any format, as a sort by distance has it, ties and all, on any number of threads", Of,
                   OfFloats, OfBytes, OfNibbles, OfBits<11>, OfBits<70>, OfPlaces) {
  require_as_defined<Of>(1, 1, 1);
  require_as_defined<Of>(5, 2, 4);
  require_as_defined<Of>(300, 250, 3);
  require_as_defined<Of>(129, 400, 1);
  require_as_defined<Of>(40, 1100, 2);
}

TEST_CASE("match: the ratio of the two nearest") {
  const float source[] = {0.0f, 10.0f};
  const float target[] = {1.0f, -2.0f, 100.0f, 11.0f, 9.0f};
  const auto pairs_of = [&](std::size_t rows, float ratio) {
    std::vector<ss::MatchedPair> pairs(3);
    REQUIRE(ss::ratio_correspondences({source, 2, 1, nullptr}, {target, rows, 1, nullptr}, ratio, pairs) == Status::ok);
    return pairs;
  };
  CHECK(same(pairs_of(5, 0.51f), {{0, 0, 1.0f}}));
  CHECK(pairs_of(5, 0.5f).empty());                // below, not at
  CHECK(same(pairs_of(5, 1.0f), {{0, 0, 1.0f}}));  // row 1: two that are as near
  CHECK(pairs_of(1, 1.0f).empty());                // no second one
  CHECK(pairs_of(0, 1.0f).empty());
  const Status only_one[] = {Status::ok, Status::bad_frame, Status::ambiguous_frame};
  std::vector<ss::MatchedPair> pairs(3);
  CHECK(ss::ratio_correspondences({source, 2, 1, nullptr}, {target, 3, 1, only_one}, 1.0f, pairs) == Status::ok);
  CHECK(pairs.empty());
  for (const float ratio : {0.0f, -0.5f, 1.0001f, infinity, not_a_number}) {
    pairs.resize(3);
    CHECK(ss::ratio_correspondences({source, 2, 1, nullptr}, {target, 5, 1, nullptr}, ratio, pairs) ==
          Status::bad_option);
    CHECK(pairs.empty());
  }
  pairs.resize(3);
  CHECK(ss::ratio_correspondences({source, 2, 1, nullptr}, {target, 1, 2, nullptr}, 0.5f, pairs) == Status::bad_rows);
  CHECK(pairs.empty());
}

TEST_CASE("match: rows of floats that are no numbers are nobody's second nearest either") {
  const float source[] = {0.0f, 0.0f};
  const float target[] = {1.0f, 0.0f, not_a_number, 0.0f, infinity, 0.0f, 3.0f, 0.0f};
  std::vector<ss::MatchedPair> pairs;
  REQUIRE(ss::ratio_correspondences({source, 1, 2, nullptr}, {target, 3, 2, nullptr}, 1.0f, pairs) == Status::ok);
  CHECK(pairs.empty());
  REQUIRE(ss::ratio_correspondences({source, 1, 2, nullptr}, {target, 4, 2, nullptr}, 0.5f, pairs) == Status::ok);
  CHECK(same(pairs, {{0, 0, 1.0f}}));
}

}  // namespace test_match_formats
