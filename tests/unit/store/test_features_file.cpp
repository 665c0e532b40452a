// Saved features come back as they were; whatever else the bytes are is refused.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "temporary_folder.hpp"

namespace test_features_file {
namespace {

using namespace unit;
using ss::Status;
using Bytes = std::vector<std::uint8_t>;
using D = ss::Ssh32;
using Features = ss::Features<D>;

/// Rows of numbers that are no descriptors, but have all kinds of key points and statuses.
Features some_features(std::uint32_t seed, std::size_t count) {
  Random random(seed);
  Features f;
  const auto next = [&] { return random.between(-1.0f, 1.0f); };
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_ok = i % 4 != 3;
    f.status.push_back(is_ok ? Status::ok : Status::ambiguous_frame);
    for (int v = 0; v < D::size; ++v) f.values.push_back(is_ok ? next() : 0.0f);
    ss::KeyPoint key(ss::Point{next(), next(), i == 3 ? not_a_number : next()});
    if (i % 2 == 0) key = ss::KeyPoint(key.position, {random.byte(), random.byte(), random.byte()});
    key.has_intensity = i % 3 == 0;
    key.intensity = key.has_intensity ? next() : 0.0f;
    f.keypoints.push_back(key);
    f.frames.push_back({{next(), next(), next()}, {next(), next(), next()}, {next(), next(), next()}});
    f.frame_confidence.push_back({next(), next(), next()});
    f.neighbors.push_back(random.bits());
  }
  return f;
}

template <class D>
Bytes saved(const ss::Features<D>& features) {
  Bytes bytes(7);
  REQUIRE(ss::save(features, bytes) == Status::ok);
  return bytes;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

bool same_keypoint(const ss::KeyPoint& a, const ss::KeyPoint& b) {  // without its padding
  return std::memcmp(&a.position, &b.position, sizeof a.position) == 0 &&
         std::memcmp(&a.intensity, &b.intensity, sizeof a.intensity) == 0 && a.color.r == b.color.r &&
         a.color.g == b.color.g && a.color.b == b.color.b && a.has_color == b.has_color &&
         a.has_intensity == b.has_intensity;
}

bool same(const Features& a, const Features& b) {
  return same_bits(a.values, b.values) && a.status == b.status && same_bits(a.frames, b.frames) &&
         same_bits(a.frame_confidence, b.frame_confidence) && a.neighbors == b.neighbors &&
         std::equal(a.keypoints.begin(), a.keypoints.end(), b.keypoints.begin(), b.keypoints.end(), same_keypoint);
}

/// What load() says; the features that were there before must still be.
Status refusal(const Bytes& bytes) {
  static const Features before = some_features(9, 3);
  Features features = before;
  const Status status = ss::load(bytes.data(), bytes.size(), features);
  if (status != Status::ok) CHECK(same(features, before));
  return status;
}

void put(Bytes& bytes, std::size_t at, std::uint64_t value, std::size_t size) {
  for (std::size_t k = 0; k < size; ++k) bytes.at(at + k) = static_cast<std::uint8_t>(value >> (8 * k) & 0xFFu);
}

/// Another number of `size` bytes, and a checksum that is right.
Bytes changed(Bytes bytes, std::size_t at, std::uint64_t value, std::size_t size) {
  put(bytes, at, value, size);
  put(bytes, bytes.size() - 8, ss::detail::checksum(bytes.data(), bytes.size() - 8), 8);
  return bytes;
}

// Where things are in the file of `rows` rows.
constexpr std::size_t rows = 6;
const std::size_t at_row_size = 12 + 8 + ss::layout_of<D>().size();
const std::size_t at_count = at_row_size + 8;
const std::size_t at_values = at_count + 8;
const std::size_t at_status = at_values + rows * 32 * 4;
const std::size_t at_keypoints = at_status + rows;
const std::size_t at_frames = at_keypoints + rows * 20;
const std::size_t at_confidence = at_frames + rows * 36;
const std::size_t at_neighbors = at_confidence + rows * 12;

}  // namespace

TEST_CASE("features file: they come back as they were, bit for bit") {
  for (const std::size_t count : {0u, 1u, 6u, 500u}) {
    const Features before = some_features(1, count);
    const Bytes bytes = saved(before);
    Features after = some_features(2, 4);
    REQUIRE(ss::load(bytes.data(), bytes.size(), after) == Status::ok);
    CHECK(same(after, before));
    CHECK(saved(after) == bytes);
  }
}

TEST_CASE("features file: what extract() gives can be saved, whatever it says of the key points") {
  const TestCloud cloud = curved_surface(12, 800);
  const std::vector<std::uint32_t> keypoints{5, 100, 0xFFFFFFu};
  Features before, after;
  REQUIRE(ss::extract(cloud.view(), ss::BruteSearch(cloud.view()), keypoints, 0.05f, before) == Status::ok);
  const Bytes bytes = saved(before);
  REQUIRE(ss::load(bytes.data(), bytes.size(), after) == Status::ok);
  CHECK(same(after, before));
}

TEST_CASE("features file: the format is what features_file.hpp says, on every machine") {
  const Features features = some_features(3, rows);
  const Bytes bytes = saved(features);
  REQUIRE(bytes.size() == at_neighbors + rows * 4 + 8);
  const auto number_at = [&](std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < size; ++k) value += std::uint64_t{bytes[at + k]} << (8 * k);
    return value;
  };
  CHECK(std::memcmp(bytes.data(), "SSHOTFEA", 8) == 0);
  CHECK(number_at(8, 4) == 1);
  CHECK(number_at(12, 8) == ss::layout_of<D>().size());
  CHECK(number_at(at_row_size, 8) == 32);
  CHECK(number_at(at_count, 8) == rows);
  CHECK(number_at(at_values + 4, 4) == ss::extend::math::bits_of(features.values[1]));
  CHECK(number_at(at_status + 3, 1) == static_cast<unsigned>(Status::ambiguous_frame));
  CHECK(number_at(at_keypoints + 20, 4) == ss::extend::math::bits_of(features.keypoints[1].position.x));
  CHECK(number_at(at_keypoints + 2 * 20 + 16, 1) == features.keypoints[2].color.r);
  CHECK(number_at(at_keypoints + 19, 1) == 3);           // a color and an intensity
  CHECK(number_at(at_keypoints + 3 * 20 + 19, 1) == 2);  // no color
  CHECK(number_at(at_frames + 36 + 12, 4) == ss::extend::math::bits_of(features.frames[1].y[0]));
  CHECK(number_at(at_confidence + 8, 4) == ss::extend::math::bits_of(features.frame_confidence[0].z_margin));
  CHECK(number_at(at_neighbors + 4, 4) == features.neighbors[1]);
  CHECK(ss::detail::checksum(bytes.data(), bytes.size()) == 1489728419841003315u);
}

TEST_CASE("features file: no beginning of one is one") {
  const Bytes bytes = saved(some_features(4, rows));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Bytes beginning(bytes.data(), bytes.data() + size);
    REQUIRE(refusal(beginning) == (size < 8 ? Status::not_a_model : Status::damaged_model));
  }
  Features features;
  CHECK(ss::load(nullptr, 0, features) == Status::not_a_model);
}

TEST_CASE("features file: no byte can change unnoticed") {
  const Bytes bytes = saved(some_features(5, rows));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const unsigned flip : {0x01u, 0x80u, 0xFFu}) {
      Bytes damaged = bytes;
      damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ flip);
      const Status expected = i < 8 ? Status::not_a_model : i < 12 ? Status::other_version : Status::damaged_model;
      REQUIRE(refusal(damaged) == expected);
    }
  }
  Bytes longer = bytes;
  longer.push_back(0);
  CHECK(refusal(longer) == Status::damaged_model);
}

TEST_CASE("features file: another descriptor's, a recognizer's, and a later version's are refused") {
  const Bytes bytes = saved(some_features(6, rows));
  ss::Features<ss::Ssh96> other;
  CHECK(ss::load(bytes.data(), bytes.size(), other) == Status::other_descriptor);
  using SameSize = ss::Ssh<ss::SphericalGrid<1, 4, 8>, ss::HardVoting>;
  static_assert(SameSize::size == D::size, "told apart by their names only");
  ss::Features<SameSize> hard;
  CHECK(ss::load(bytes.data(), bytes.size(), hard) == Status::other_descriptor);
  ss::Recognizer recognizer;
  CHECK(ss::load(bytes.data(), bytes.size(), ss::layout_of<D>(), recognizer) == Status::not_a_model);
  CHECK(refusal(changed(bytes, 8, 2, 4)) == Status::other_version);
  CHECK(refusal(bytes) == Status::ok);
}

TEST_CASE("features file: numbers that cannot be are refused although the checksum is right, and ask for no memory") {
  const Bytes bytes = saved(some_features(7, rows));
  for (const std::size_t at : {std::size_t{12}, at_row_size, at_count}) {
    const std::uint64_t right = bytes[at];
    for (const std::uint64_t value : {right - 1, right + 1, std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 62,
                                      std::uint64_t{1} << 32, std::uint64_t{bytes.size()}}) {
      CAPTURE(at);
      CAPTURE(value);
      const Status status = refusal(changed(bytes, at, value, 8));
      REQUIRE((status == Status::damaged_model || (at == 12 && status == Status::other_descriptor)));
    }
  }
  const std::uint64_t nan_bits = 0x7FC00000u;
  for (const std::size_t at : {at_values, at_values + rows * 32 * 4 - 4, at_frames, at_confidence, at_neighbors - 4}) {
    CHECK(refusal(changed(bytes, at, nan_bits, 4)) == Status::damaged_model);
  }
  CHECK(refusal(changed(bytes, at_status, ss::status_count, 1)) == Status::damaged_model);
  CHECK(refusal(changed(bytes, at_keypoints + 19, 4, 1)) == Status::damaged_model);
  CHECK(refusal(changed(bytes, at_keypoints, nan_bits, 4)) == Status::ok);  // a key point may be anywhere
}

TEST_CASE("features file: what cannot be saved") {
  const Features good = some_features(8, rows);
  std::vector<Features> bad(8, good);
  bad[0].values.pop_back();
  bad[1].keypoints.pop_back();
  bad[2].frames.pop_back();
  bad[3].frame_confidence.pop_back();
  bad[4].neighbors.pop_back();
  bad[5].values[40] = not_a_number;
  bad[6].frames[1].z[2] = infinity;
  bad[7].frame_confidence[5].x_margin = not_a_number;
  for (const Features& features : bad) {
    Bytes bytes(3);
    CHECK(ss::save(features, bytes) == Status::bad_rows);
    CHECK(bytes.empty());
  }
}

TEST_CASE("features file: files") {
  const TemporaryFolder folder;
  const std::string path = folder / "view.features";
  Features features;
  CHECK(ss::load(path, features) == Status::no_file);
  const Features large = some_features(10, 300);  // more than one read
  REQUIRE(ss::save(large, path) == Status::ok);
  REQUIRE(ss::load(path, features) == Status::ok);
  CHECK(same(features, large));
  REQUIRE(ss::save(some_features(11, 2), path) == Status::ok);  // over a longer one
  REQUIRE(ss::load(path, features) == Status::ok);
  CHECK(same(features, some_features(11, 2)));
  Features bad = large;
  bad.status.pop_back();
  CHECK(ss::save(bad, path) == Status::bad_rows);
  CHECK(ss::save(large, folder / "no/folder") == Status::no_file);
  CHECK(bytes_of_file(path) == saved(features));
  CHECK(folder.files() == 1);
}

}  // namespace test_features_file
