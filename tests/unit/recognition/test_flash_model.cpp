// Models in flash: what is in them, damage of every byte, and contents that cannot be behind a right checksum.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "stored_views.hpp"
#include "with_checksum.hpp"

namespace test_flash_model {
namespace {

using namespace unit;
using ss::Status;

using D = ss::ShapeColor32;
using Stored = ss::NibbleDescriptor<D>;
using Bytes = std::vector<std::uint8_t>;

ss::Recognizer trained() {
  ss::Recognizer recognizer({0.02f, 2, 5});
  REQUIRE(ss::train(recognizer, stored<Stored>(view_of<D>(1, no_motion, 1)), {0.0f, 0.1f, 0.2f}, "mug", "red") ==
          Status::ok);
  REQUIRE(ss::train(recognizer, stored<Stored>(view_of<D>(2, no_motion, 2)), {0.1f, 0.0f, -0.1f}, "cup", "") ==
          Status::ok);
  REQUIRE(ss::train(recognizer, stored<Stored>(view_of<D>(3, no_motion, 2)), {0.1f, 0.0f, -0.1f}, "mug", "blue") ==
          Status::ok);
  return recognizer;
}

Bytes model_bytes() {
  Bytes bytes;
  REQUIRE(ss::save_for_flash<Stored>(trained(), bytes) == Status::ok);
  return bytes;
}

/// Whatever the bytes say, everything that can be asked is answered: under sanitizers nothing else is read.
void use(const ss::ModelView<Stored>& model) {
  unsigned sum = 0;
  for (std::uint32_t i = 0; i < model.class_count(); ++i)
    sum += static_cast<unsigned>(std::strlen(model.class_name(i)));
  for (std::uint32_t i = 0; i < model.instance_count(); ++i) {
    sum += static_cast<unsigned>(std::strlen(model.instance_name(i)));
    CHECK(model.class_of(i) < model.class_count());
  }
  for (std::uint32_t i = 0; i < model.codeword_count(); ++i) {
    CHECK(model.instance_of(i) < model.instance_count());
    CHECK(std::isfinite(model.center_of(i).x));
    sum += model.descriptor(i).bytes[Stored::size_bytes - 1];
  }
  CHECK(sum < 100'000);
  const auto view = stored<Stored>(view_of<D>(2, no_motion, 3));
  ss::MicroRecognizer<Stored, 16, 5, 2> recognizer;
  recognizer.start(model);
  for (std::size_t i = 0; i < view.size(); ++i) {
    (void)recognizer.add(view.descriptors[i], view.keypoints[i].position, view.frames[i]);
  }
  ss::Hypothesis found[4];
  CHECK(recognizer.finish(found) <= 4);
}

}  // namespace

TEST_CASE("flash model: what was trained is read in place") {
  const ss::Recognizer recognizer = trained();
  const Bytes bytes = model_bytes();
  CHECK(bytes.size() % 4 == 0);
  ss::ModelView<Stored> model;
  CHECK(model.codeword_count() == 0);
  REQUIRE(model.open(bytes.data(), bytes.size()) == Status::ok);
  CHECK((model.options().bandwidth == 0.02f && model.options().neighbors == 2 && model.options().most == 5));
  CHECK((model.codeword_count() == 33 && model.instance_count() == 3 && model.class_count() == 2));
  CHECK((model.class_name(0) == std::string("mug") && model.class_name(1) == std::string("cup")));
  CHECK((model.instance_name(0) == std::string("red") && model.instance_name(1) == std::string()));
  CHECK((model.instance_name(2) == std::string("blue") && model.class_of(2) == 0 && model.class_of(1) == 1));
  CHECK((model.instance_of(0) == 0 && model.instance_of(11) == 1 && model.instance_of(32) == 2));

  const auto& codebook = ss::detail::RecognizerAccess::codebook(recognizer);
  const float unit = ss::detail::unit_of_centers(codebook.codewords);
  float farthest = 0.0f;
  for (std::uint32_t i = 0; i < model.codeword_count(); ++i) {
    const ss::Point& exact = codebook.codewords[i].center;
    const ss::Point center = model.center_of(i);
    farthest = std::max({farthest, std::fabs(exact.x), std::fabs(exact.y), std::fabs(exact.z)});
    CHECK(std::fabs(center.x - exact.x) <= 0.5f * unit);
    CHECK(std::fabs(center.y - exact.y) <= 0.5f * unit);
    CHECK(std::fabs(center.z - exact.z) <= 0.5f * unit);
    const Stored descriptor = model.descriptor(i);
    CHECK(std::memcmp(&descriptor, codebook.packed.data() + i * sizeof(Stored), sizeof(Stored)) == 0);
  }
  CHECK(unit < farthest / 16'383.0f);

  ss::Recognizer loaded;
  REQUIRE(ss::load_from_flash<Stored>(bytes.data(), bytes.size(), loaded) == Status::ok);
  Bytes again;
  REQUIRE(ss::save_for_flash<Stored>(loaded, again) == Status::ok);
  CHECK(again == bytes);
  CHECK(ss::flash_model_header({1, 2, 255}, "cups")
            .find("alignas(4) inline constexpr unsigned char cups[] = {\n    1, 2, 255,\n}") != std::string::npos);
}

TEST_CASE("flash model: anything else is refused, by a status that says what it is") {
  const Bytes bytes = model_bytes();
  ss::ModelView<Stored> model;
  CHECK(model.open(nullptr, 0) == Status::not_a_model);
  CHECK(model.open(bytes.data(), 7) == Status::not_a_model);
  ss::ModelView<ss::ByteDescriptor<D>> of_bytes;
  CHECK(of_bytes.open(bytes.data(), bytes.size()) == Status::other_descriptor);
  ss::ModelView<ss::NibbleDescriptor<ss::ColorRings27>> of_rings;
  CHECK(of_rings.open(bytes.data(), bytes.size()) == Status::other_descriptor);
  Bytes other = bytes;
  other[8] = 2;
  other = with_checksum(other);
  CHECK(model.open(other.data(), other.size()) == Status::other_version);
  CHECK(model.codeword_count() == 0);
  ss::Recognizer loaded;
  CHECK(ss::load_from_flash<ss::ByteDescriptor<D>>(bytes.data(), bytes.size(), loaded) == Status::other_descriptor);

  Bytes out{1};
  CHECK(ss::save_for_flash<Stored>(ss::Recognizer(), out) == Status::not_trained);
  CHECK(out.empty());
  ss::Recognizer floats;
  REQUIRE(ss::train(floats, view_of<D>(1, no_motion, 1), {0.0f, 0.0f, 0.0f}, "a", "b") == Status::ok);
  CHECK(ss::save_for_flash<Stored>(floats, out) == Status::other_descriptor);
  ss::Recognizer zero;
  REQUIRE(ss::train(zero, stored<Stored>(view_of<D>(1, no_motion, 1)), {0.0f, 0.0f, 0.0f}, "a", std::string(1, '\0')) ==
          Status::ok);
  CHECK(ss::save_for_flash<Stored>(zero, out) == Status::bad_rows);
  ss::Recognizer far;
  REQUIRE(ss::train(far, stored<Stored>(view_of<D>(1, no_motion, 1)), {3e37f, 0.0f, 0.0f}, "a", "b") == Status::ok);
  CHECK(ss::save_for_flash<Stored>(far, out) == Status::bad_rows);
}

TEST_CASE("flash model: every byte that is wrong, and every end that is too early, is noticed") {
  const Bytes bytes = model_bytes();
  ss::ModelView<Stored> model;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    REQUIRE(model.open(cut.data(), cut.size()) != Status::ok);
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const unsigned flipped : {1u, 128u, 255u}) {
      Bytes damaged = bytes;
      damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ flipped);
      REQUIRE(model.open(damaged.data(), damaged.size()) != Status::ok);
    }
  }
  CHECK(model.codeword_count() == 0);
}

TEST_CASE("flash model: behind a right checksum nothing wrong does harm") {
  const Bytes bytes = model_bytes();
  std::size_t refused = 0;
  for (std::size_t i = 0; i < bytes.size() - 8; ++i) {
    for (const unsigned value : {0u, 1u, 127u, 255u}) {
      Bytes damaged = bytes;
      damaged[i] = static_cast<std::uint8_t>(value);
      damaged = with_checksum(damaged);
      ss::ModelView<Stored> model;
      if (model.open(damaged.data(), damaged.size()) == Status::ok) {
        if (value == 255u || i < 80) use(model);
      } else {
        ++refused;
      }
    }
  }
  CHECK(refused > 60);
}

TEST_CASE("flash model: rows begin with what tells codewords apart; an order that is none does no harm") {
  Bytes bytes = model_bytes();
  ss::ModelView<Stored> model;
  REQUIRE(model.open(bytes.data(), bytes.size()) == Status::ok);
  const auto differences = [&](std::uint32_t number) {
    unsigned sum = 0;
    for (std::uint32_t i = 1; i < model.codeword_count(); ++i) {
      const auto at = [&](std::uint32_t codeword) {
        const Stored arranged = model.arranged(model.descriptor(codeword));
        return static_cast<int>(ss::detail::number_at<4>(arranged.bytes, number));
      };
      sum += static_cast<unsigned>((at(i) - at(i - 1)) * (at(i) - at(i - 1)));
    }
    return sum;
  };
  std::vector<bool> placed(model.number_count());
  for (std::uint32_t i = 0; i < model.number_count(); ++i) {
    CHECK_FALSE(placed[model.place_of(i)]);
    placed[model.place_of(i)] = true;
    if (i > 0) CHECK(differences(i) <= differences(i - 1));
  }

  const ss::detail::FlashLayout layout(sizeof(Stored), model.number_count(), model.codeword_count(),
                                       model.instance_count(), 0);
  bytes[layout.order] = bytes[layout.order + 2];
  bytes[layout.order + 1] = bytes[layout.order + 3];
  bytes = with_checksum(bytes);
  REQUIRE(model.open(bytes.data(), bytes.size()) == Status::ok);
  use(model);
  ss::Recognizer loaded;
  CHECK(ss::load_from_flash<Stored>(bytes.data(), bytes.size(), loaded) == Status::damaged_model);
}

}  // namespace test_flash_model
