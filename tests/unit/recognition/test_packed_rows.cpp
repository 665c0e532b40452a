// Borrowed rows of bytes and bits: which can be compared, and how far apart they are.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "descriptor_rows.hpp"
#include "fixtures.hpp"

namespace test_packed_rows {
namespace {

using namespace unit;
using ss::Status;

constexpr float step = 1.0f / 512.0f;

}  // namespace

TEST_CASE("packed rows: those that do not fit each other are refused") {
  const std::vector<std::uint8_t> bytes(12);
  std::vector<ss::Match> out(2);
  const ss::ByteRows good{bytes.data(), 4, 3, step, nullptr};
  const ss::ByteRows bad[] = {{nullptr, 4, 3, step, nullptr},
                              {bytes.data(), 4, 0, step, nullptr},
                              {bytes.data(), 6, 2, step, nullptr},
                              {bytes.data(), 1, 66052, step, nullptr},
                              {bytes.data(), ss::no_row, 3, step, nullptr}};
  for (const ss::ByteRows& other : bad) {
    CHECK(ss::nearest(good, other, 1, out) == Status::bad_rows);
    CHECK(ss::nearest(other, good, 1, out) == Status::bad_rows);
    const ss::BitRows bits{other.bytes, other.count, other.size, nullptr};
    CHECK(ss::nearest(ss::BitRows{bytes.data(), 4, 3, nullptr}, bits, 1, out) == Status::bad_rows);
    CHECK(out.empty());
  }
  CHECK(ss::nearest(good, ss::ByteRows{bytes.data(), 4, 3, 2.0f * step, nullptr}, 1, out) == Status::bad_rows);
  CHECK(ss::validate(good) == Status::ok);
  CHECK(ss::validate(bad[1]) == Status::bad_rows);
  CHECK(ss::validate(ss::BitRows{nullptr, 0, 3, nullptr}) == Status::ok);
  CHECK(ss::nearest(good, good, 0, out) == Status::bad_option);
  const ss::ByteRows none{nullptr, 0, 3, step, nullptr};
  CHECK(ss::nearest(good, none, 1, out) == Status::ok);
  CHECK((out.size() == 4 && out[0].row == ss::no_row && out[0].distance == infinity));
}

TEST_CASE("packed rows: quantized and binarized descriptors") {
  using D = ss::Ssh32;
  using Bytes = ss::ByteDescriptor<D>;
  const Rows rows = random_rows(5, 40, D::size);
  std::vector<Bytes> bytes(rows.count());
  std::vector<ss::BinaryDescriptor<D>> bits(rows.count());
  for (std::size_t i = 0; i < rows.count(); ++i) {
    ss::quantize(rows.values.data() + i * rows.size, bytes[i]);
    ss::binarize(rows.values.data() + i * rows.size, bits[i]);
  }
  const std::vector<Status> status(rows.count(), Status::ok);
  const ss::ByteRows from = ss::rows_of(bytes, status.data());
  const ss::BitRows from_bits = ss::rows_of(bits);
  CHECK((from.count == 40 && from.size == 32 && from.status == status.data()));
  CHECK((from_bits.count == 40 && from_bits.size == 4 && from_bits.status == nullptr));
  for (std::size_t i = 1; i < rows.count(); ++i) {
    const std::uint32_t squared = ss::squared_distance(bytes[0], bytes[i]);
    REQUIRE(from.compare(0, from, i) == squared);
    REQUIRE(from.distance(squared) == Bytes::step * std::sqrt(static_cast<float>(squared)));
    REQUIRE(from_bits.compare(0, from_bits, i) == static_cast<std::uint32_t>(ss::hamming_distance(bits[0], bits[i])));
  }
}

TEST_CASE("packed rows: the largest distance of bytes that there can be") {
  const std::size_t size = 66051;
  std::vector<std::uint8_t> values(2 * size, 255);
  std::fill_n(values.begin(), size, std::uint8_t{0});
  const ss::ByteRows zeros{values.data(), 1, size, step, nullptr};
  const ss::ByteRows ones{values.data() + size, 1, size, step, nullptr};
  CHECK(zeros.compare(0, ones, 0) == 4294966275u);
  std::vector<ss::Match> out;
  REQUIRE(ss::nearest(zeros, ones, 1, out) == Status::ok);
  CHECK((out[0].row == 0 && out[0].distance == step * std::sqrt(4294966275.0f)));
}

TEST_CASE("packed rows: the longest rows of nibbles and of bits") {
  const std::size_t size = 66051;
  std::vector<std::uint8_t> bytes(3 * size, 255);
  std::fill_n(bytes.begin(), size, std::uint8_t{0});
  bytes[2 * size + 7] = 0;
  std::vector<ss::Match> out;
  REQUIRE(ss::nearest(ss::NibbleRows{bytes.data(), 1, size, 1.0f, nullptr},
                      ss::NibbleRows{bytes.data() + size, 2, size, 1.0f, nullptr}, 2, out) == Status::ok);
  CHECK((out[0].row == 1 && out[0].distance == std::sqrt(66050.0f * 450.0f)));
  CHECK((out[1].row == 0 && out[1].distance == std::sqrt(66051.0f * 450.0f)));
  REQUIRE(ss::nearest(ss::BitRows{bytes.data(), 1, size, nullptr}, ss::BitRows{bytes.data() + size, 2, size, nullptr},
                      2, out) == Status::ok);
  CHECK((out[0].row == 1 && out[0].distance == 8.0f * 66050.0f));
  CHECK((out[1].row == 0 && out[1].distance == 8.0f * 66051.0f));
}

TEST_CASE("match: the distance of two rows of floats is what matching says") {
  for (const std::size_t size : {1u, 7u, 8u, 33u, 336u}) {
    const Rows pair = random_rows(7, 2, size);
    const float* const a = pair.values.data();
    std::vector<ss::Match> out;
    REQUIRE(ss::nearest({a, 1, size, nullptr}, {a + size, 1, size, nullptr}, 1, out) == Status::ok);
    CHECK(ss::l2_distance(a, a + size, size) == out[0].distance);
    CHECK(std::fabs(ss::l2_distance(a, a + size, size) - distance(pair, 0, pair, 1)) < 1e-5f);
    float sums[8] = {};
    for (std::size_t v = 0; v < size; ++v) {
      const float d = a[v] - a[size + v];
      sums[v % 8] += ss::extend::unfused(d * d);
    }
    CHECK(ss::squared_l2_distance(a, a + size, size) ==
          ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7])));
  }
  CHECK(ss::l2_distance(nullptr, nullptr, 0) == 0.0f);
}

}  // namespace test_packed_rows
