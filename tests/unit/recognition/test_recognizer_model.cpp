// Saved recognizers come back as they were; whatever else the bytes are is refused.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "synthetic_objects.hpp"
#include "with_checksum.hpp"

namespace test_recognizer_model {
namespace {

using namespace unit;
using ss::Status;
using Bytes = std::vector<std::uint8_t>;

const View cup = synthetic_object(21, 3);
const View mug = synthetic_object(22, 4);

ss::Recognizer trained() {
  ss::Recognizer recognizer({0.025f, 2, 5});
  REQUIRE(ss::train(recognizer, cup.rows(), synthetic_layout, {0.0f, 0.0f, 0.5f}, "cup", "a") == Status::ok);
  REQUIRE(ss::train(recognizer, mug.rows(), synthetic_layout, {0.0f, 0.0f, 0.0f}, "mug", "red") == Status::ok);
  REQUIRE(ss::train(recognizer, cup.rows(), synthetic_layout, {0.1f, 0.0f, 0.0f}, "mug", "") == Status::ok);
  return recognizer;
}

Bytes saved(const ss::Recognizer& recognizer) {
  Bytes bytes(7);
  REQUIRE(ss::save(recognizer, bytes) == Status::ok);
  return bytes;
}

// Where things are in the model.
constexpr std::size_t at_version = 8;
constexpr std::size_t at_layout = 12;
const std::size_t at_row_size = at_layout + 8 + synthetic_layout.size();
const std::size_t at_bandwidth = at_row_size + 8;
const std::size_t at_classes = at_bandwidth + 12;
const std::size_t at_instances = at_classes + 8 + 2 * (8 + 3);
const std::size_t at_codewords = at_instances + 8 + 3 * (4 + 8) + 1 + 3;
const std::size_t at_values = at_codewords + 8 + 10 * 16;

/// Another number, and a checksum that is right.
Bytes changed(Bytes bytes, std::size_t at, std::uint64_t value, std::size_t size) {
  for (std::size_t k = 0; k < size; ++k) bytes[at + k] = static_cast<std::uint8_t>(value >> (8 * k) & 0xFFu);
  return with_checksum(bytes);
}

/// What load() says; the recognizer that was there before must still be.
Status refusal(const Bytes& bytes, const std::string& layout = synthetic_layout) {
  static const ss::Recognizer before = trained();
  static const Bytes before_bytes = saved(before);
  ss::Recognizer recognizer = before;
  const Status status = ss::load(bytes.data(), bytes.size(), layout, recognizer);
  if (status != Status::ok) CHECK(saved(recognizer) == before_bytes);
  return status;
}

struct TemporaryFile {
  std::filesystem::path path = std::filesystem::temp_directory_path() / ("shortshot_model_" + std::to_string(number()));
  static unsigned number() {
    static std::random_device device;
    return device();
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
};

}  // namespace

TEST_CASE("model: a recognizer comes back as it was, bit for bit") {
  const ss::Recognizer before = trained();
  const Bytes bytes = saved(before);
  ss::Recognizer after;
  REQUIRE(ss::load(bytes.data(), bytes.size(), synthetic_layout, after) == Status::ok);
  CHECK(saved(after) == bytes);
  CHECK(after.layout() == synthetic_layout);
  CHECK(after.row_size() == synthetic_size);
  CHECK(after.options().bandwidth == 0.025f);
  CHECK(after.options().neighbors == 2);
  CHECK(after.options().most == 5);
  REQUIRE(after.instance_count() == 3);
  CHECK(after.class_name(after.class_of(1)) == "mug");
  CHECK(after.instance_name(2).empty());

  View scene = moved(mug, no_motion, 0.3f);
  scene.append(moved(cup, no_motion, 0.3f));
  std::vector<ss::Hypothesis> expected, found;
  REQUIRE(ss::recognize(before, scene.rows(), synthetic_layout, expected) == Status::ok);
  REQUIRE(ss::recognize(after, scene.rows(), synthetic_layout, found) == Status::ok);
  CHECK_FALSE(expected.empty());
  CHECK(same_bits(found, expected));
  REQUIRE(ss::train(after, cup.rows(), synthetic_layout, {}, "cup", "b") == Status::ok);
  CHECK(after.instance_count() == 4);
}

TEST_CASE("model: the format is what recognizer_model.hpp says") {
  const Bytes bytes = saved(trained());
  REQUIRE(bytes.size() == at_values + 10 * synthetic_size * 4 + 8);
  const auto number_at = [&](std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < size; ++k) value += std::uint64_t{bytes[at + k]} << (8 * k);
    return value;
  };
  CHECK(std::memcmp(bytes.data(), "SSHOTREC", 8) == 0);
  CHECK(number_at(at_version, 4) == 1);
  CHECK(number_at(at_layout, 8) == synthetic_layout.size());
  CHECK(number_at(at_row_size, 8) == synthetic_size);
  CHECK(number_at(at_bandwidth, 4) == 0x3CCCCCCDu);  // 0.025
  CHECK(number_at(at_classes, 8) == 2);
  CHECK(number_at(at_instances, 8) == 3);
  CHECK(number_at(at_codewords, 8) == 10);
  CHECK(number_at(at_codewords + 8 + 3 * 16, 4) == 1);  // the instance of the fourth codeword
  CHECK(number_at(at_values, 4) == ss::extend::math::bits_of(cup.values[0]));
  const Bytes letter{'a'};
  CHECK(ss::detail::checksum(letter.data(), 1) == 0xAF63DC4C8601EC8Cu);  // a published example of FNV-1a
}

TEST_CASE("model: no beginning of one is one") {
  const Bytes bytes = saved(trained());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Bytes beginning(bytes.data(), bytes.data() + size);
    REQUIRE(refusal(beginning) == (size < 8 ? Status::not_a_model : Status::damaged_model));
  }
  ss::Recognizer recognizer;
  CHECK(ss::load(nullptr, 0, synthetic_layout, recognizer) == Status::not_a_model);
}

TEST_CASE("model: no byte can change unnoticed") {
  const Bytes bytes = saved(trained());
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

TEST_CASE("model: refused in this order: foreign bytes, another version, damage, another descriptor") {
  const Bytes bytes = saved(trained());
  const std::string text = "not a model, but long enough to be one of something else";
  CHECK(refusal(Bytes(text.begin(), text.end())) == Status::not_a_model);
  Bytes newer = bytes;
  newer[at_version] = 3;
  newer.resize(newer.size() / 2);
  CHECK(refusal(newer, "other") == Status::other_version);
  Bytes damaged = bytes;
  damaged[at_values] ^= 1u;
  CHECK(refusal(damaged, "other") == Status::damaged_model);
  CHECK(refusal(bytes, "other") == Status::other_descriptor);
  CHECK(refusal(bytes) == Status::ok);
}

TEST_CASE("model: numbers that cannot be are refused although the checksum is right, and ask for no memory") {
  const Bytes bytes = saved(trained());
  for (const std::size_t at : {at_layout, at_row_size, at_classes, at_classes + 8, at_instances, at_codewords}) {
    const std::uint64_t right = bytes[at];
    for (const std::uint64_t value : {right - 1, right + 1, std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 62,
                                      std::uint64_t{1} << 32, std::uint64_t{bytes.size()}}) {
      if (value == right) continue;
      CAPTURE(at);
      CAPTURE(value);
      REQUIRE(refusal(changed(bytes, at, value, 8)) == Status::damaged_model);
    }
  }
  const std::uint64_t nan_bits = 0x7FC00000u;
  CHECK(refusal(changed(bytes, at_bandwidth, nan_bits, 4)) == Status::damaged_model);
  CHECK(refusal(changed(bytes, at_bandwidth, 0, 4)) == Status::damaged_model);
  CHECK(refusal(changed(bytes, at_bandwidth + 4, 0, 4)) == Status::damaged_model);  // no neighbors
  CHECK(refusal(changed(bytes, at_bandwidth + 8, 0, 4)) == Status::damaged_model);  // no hypotheses
  CHECK(refusal(changed(bytes, at_instances + 8, 2, 4)) == Status::damaged_model);  // no such class
  CHECK(refusal(changed(bytes, at_codewords + 8, 3, 4)) == Status::damaged_model);  // no such instance
  CHECK(refusal(changed(bytes, at_codewords + 12, nan_bits, 4)) == Status::damaged_model);
  CHECK(refusal(changed(bytes, at_values + 4 * 239, nan_bits, 4)) == Status::damaged_model);
}

TEST_CASE("model: any other change of a byte leaves a model, or is refused") {
  const Bytes bytes = saved(trained());
  Random random(23);
  int loaded = 0;
  for (int round = 0; round < 20000; ++round) {
    Bytes other = bytes;
    other[at_layout + random.below(at_values + 40 - at_layout)] = random.byte();
    other = with_checksum(other);
    ss::Recognizer recognizer;
    const Status status = ss::load(other.data(), other.size(), synthetic_layout, recognizer);
    REQUIRE((status == Status::ok || status == Status::damaged_model || status == Status::other_descriptor));
    if (status != Status::ok) continue;
    ++loaded;
    REQUIRE(saved(recognizer) == other);
    std::vector<ss::Hypothesis> found;
    REQUIRE(ss::recognize(recognizer, cup.rows(), synthetic_layout, found) == Status::ok);
    for (const ss::Hypothesis& hypothesis : found) REQUIRE(ss::is_finite(hypothesis.center));
  }
  CHECK(loaded > 1000);
}

TEST_CASE("model: what cannot be saved") {
  Bytes bytes(3);
  CHECK(ss::save(ss::Recognizer(), bytes) == Status::not_trained);
  CHECK(bytes.empty());
  ss::Recognizer recognizer = trained();
  recognizer.set_options({0.0f, 1, 8});
  bytes.resize(3);
  CHECK(ss::save(recognizer, bytes) == Status::bad_option);
  CHECK(bytes.empty());
}

TEST_CASE("model: files") {
  const TemporaryFile file;
  const std::string path = file.path.string();
  ss::Recognizer recognizer;
  CHECK(ss::load(path, synthetic_layout, recognizer) == Status::no_file);
  CHECK(ss::save(ss::Recognizer(), path) == Status::not_trained);
  CHECK_FALSE(std::filesystem::exists(file.path));

  const View many = synthetic_object(24, 500);  // more than one read
  ss::Recognizer large = trained();
  REQUIRE(ss::train(large, many.rows(), synthetic_layout, {}, "cup", "b") == Status::ok);
  REQUIRE(ss::save(large, path) == Status::ok);
  REQUIRE(ss::load(path, synthetic_layout, recognizer) == Status::ok);
  CHECK(saved(recognizer) == saved(large));
  REQUIRE(ss::save(trained(), path) == Status::ok);  // over a longer one
  REQUIRE(ss::load(path, synthetic_layout, recognizer) == Status::ok);
  CHECK(saved(recognizer) == saved(trained()));
  CHECK(ss::load(path, "other", recognizer) == Status::other_descriptor);
  std::filesystem::resize_file(file.path, 100);
  CHECK(ss::load(path, synthetic_layout, recognizer) == Status::damaged_model);
  std::filesystem::resize_file(file.path, 0);
  CHECK(ss::load(path, synthetic_layout, recognizer) == Status::not_a_model);

  const std::string folder = std::filesystem::temp_directory_path().string();
  CHECK(ss::load(folder, synthetic_layout, recognizer) == Status::no_file);
  CHECK(ss::save(trained(), folder) == Status::no_file);
  CHECK(ss::save(trained(), path + "/in/no/folder") == Status::no_file);
}

}  // namespace test_recognizer_model
