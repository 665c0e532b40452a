// Objects that are learned on the spot, when the power goes at any time, and when bytes of the memory change: what is
// known is what was known before, or all of what was learned, and learning goes on.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "flash_simulator.hpp"
#include "stored_views.hpp"

namespace test_learned_objects_survive {
namespace {

using namespace unit;
using ss::Status;

using D = ss::ShapeColor32;
using Stored = ss::SumBits<D, 256>;
template <std::size_t UnitBytes>
using Flash = FlashSimulator<UnitBytes>;
template <std::size_t UnitBytes>
using Learned = ss::LearnedObjects<Stored, Flash<UnitBytes>, 8>;
const ss::ModelView<Stored> nothing({0.03f, 1, 8});

/// Key points of made-up descriptors; those of object 0 are of bytes as erased memory has them.
ss::StoredKeyPoint<Stored> key_of(std::uint32_t object, std::uint32_t i) {
  ss::StoredKeyPoint<Stored> key{};
  for (std::size_t k = 0; k < sizeof key.descriptor.bytes; ++k) {
    key.descriptor.bytes[k] = static_cast<std::uint8_t>(object == 0 ? 0xFF : 31 * object + 7 * i + k * k);
  }
  key.frame.x[0] = key.frame.y[1] = key.frame.z[2] = 1.0f;
  key.position = {0.01f * static_cast<float>(i), 0.0f, 0.5f};
  return key;
}

constexpr std::uint32_t keys = 3;
constexpr ss::Point center{0.0f, 0.01f, 0.6f};

template <std::size_t UnitBytes>
Status learn(Learned<UnitBytes>& learned, std::uint32_t object) {
  for (std::uint32_t i = 0; i < keys; ++i) {
    const Status status = learned.add(key_of(object, i), center);
    if (status != Status::ok) return status;
  }
  return learned.commit("made", std::to_string(object).c_str());
}

/// All that is known is an object as it was learned; returns their names.
std::string known(const ss::ModelView<Stored>& model) {
  std::string names;
  CHECK(model.codeword_count() == keys * model.instance_count());
  for (std::uint32_t instance = 0; instance < model.instance_count(); ++instance) {
    names += model.instance_name(instance);
    CHECK(model.class_name(model.class_of(instance)) == std::string("made"));
  }
  for (std::uint32_t i = 0; i < model.codeword_count(); ++i) {
    CHECK(model.instance_of(i) == i / keys);
    const auto object = static_cast<std::uint32_t>(names[i / keys] - '0');
    const ss::StoredKeyPoint<Stored> key = key_of(object, i % keys);
    const Stored descriptor = model.descriptor(i);
    CHECK(std::memcmp(&descriptor, &key.descriptor, sizeof(Stored)) == 0);
    const ss::Point expected = ss::detail::to_local(center, key.position, key.frame);
    CHECK(distance(model.center_of(i), expected) < 0.0002f);
  }
  return names;
}

template <std::size_t UnitBytes>
std::string known_after_restart(Flash<UnitBytes>& flash) {
  Learned<UnitBytes> learned;
  REQUIRE(learned.open(nothing, flash) == Status::ok);
  return known(learned.model());
}

/// The power goes with a write of learning two objects, if there are so many; then a third one is learned. False if it
/// did not go.
template <std::size_t UnitBytes>
bool check_cut(std::size_t writes, std::uint32_t seed) {
  Flash<UnitBytes> flash(2048);
  flash.torn = Random(seed);
  flash.writes_left = writes;
  Learned<UnitBytes> learned;
  REQUIRE(learned.open(nothing, flash) == Status::ok);
  const Status first = learn(learned, 0);
  const Status second = learn(learned, 1);
  const bool is_cut = flash.writes_left == 0;
  flash.writes_left = Flash<UnitBytes>::forever;

  const std::string now = known_after_restart(flash);
  if (first != Status::ok) {
    REQUIRE((now.empty() || now == "0"));
  } else if (second != Status::ok) {
    REQUIRE((now == "0" || now == "01"));
  } else {
    REQUIRE(now == "01");
  }
  Learned<UnitBytes> later;
  REQUIRE(later.open(nothing, flash) == Status::ok);
  REQUIRE(learn(later, 2) == Status::ok);
  REQUIRE(known(later.model()) == now + "2");
  REQUIRE(known_after_restart(flash) == now + "2");
  REQUIRE(flash.refused == 0);
  return is_cut;
}

template <std::size_t UnitBytes>
void check_cuts(std::uint32_t seeds) {
  CAPTURE(UnitBytes);
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    std::size_t writes = 1;
    while (check_cut<UnitBytes>(writes, seed)) ++writes;
    CHECK(writes > 250 / UnitBytes);
  }
}

}  // namespace

TEST_CASE("learned objects: the power may go with every write") {
  check_cuts<1>(2);
  check_cuts<4>(3);
  check_cuts<8>(10);
  check_cuts<32>(20);
  check_cuts<64>(20);
}

TEST_CASE("learned objects: a checksum may end as erased memory does") {
  std::size_t such = 0;
  for (std::uint32_t trial = 0; trial < 2000; ++trial) {
    Flash<1> flash(1024);
    Learned<1> learned;
    REQUIRE(learned.open(nothing, flash) == Status::ok);
    ss::StoredKeyPoint<Stored> key = key_of(1, 0);
    key.position.y = 1e-4f * static_cast<float>(trial);
    REQUIRE(learned.add(key, center) == Status::ok);
    REQUIRE(learned.commit("made", "1") == Status::ok);
    if (flash.content[flash.size_bytes() - learned.bytes_left() - 1] != 0xFF) continue;
    ++such;
    REQUIRE(learn(learned, 2) == Status::ok);
    Learned<1> again;
    REQUIRE(again.open(nothing, flash) == Status::ok);
    REQUIRE(again.model().instance_count() == 2);
    REQUIRE(flash.refused == 0);
  }
  CHECK(such > 0);
}

TEST_CASE("learned objects: the power may go again and again, until the memory is full") {
  Random random(5);
  std::size_t longest = 0;
  for (int trial = 0; trial < 100; ++trial) {
    Flash<8> flash(4096);
    flash.torn = Random(static_cast<std::uint32_t>(trial) + 1);
    std::string before;
    Status status = Status::ok;
    while (status != Status::out_of_memory) {
      Learned<8> learned;
      flash.writes_left = 1 + static_cast<std::size_t>(random.between(0.0f, 60.0f));
      REQUIRE(learned.open(nothing, flash) == Status::ok);
      const auto object = static_cast<std::uint32_t>(before.size());
      status = learn(learned, object);
      flash.writes_left = Flash<8>::forever;
      const std::string now = known_after_restart(flash);
      if (status == Status::ok) REQUIRE(now == before + std::to_string(object));
      if (now != before) REQUIRE(now == before + std::to_string(object));
      before = now;
    }
    REQUIRE(flash.refused == 0);
    longest = std::max(longest, before.size());
  }
  CHECK(longest == 8);
}

TEST_CASE("learned objects: memory that does not take a write costs the object, and no other") {
  for (const bool is_refused : {false, true}) {
    for (std::size_t unit = 0; unit < 24; ++unit) {
      Flash<8> flash(2048);
      Learned<8> learned;
      REQUIRE(learned.open(nothing, flash) == Status::ok);
      REQUIRE(learn(learned, 1) == Status::ok);
      const std::size_t place = flash.size_bytes() - learned.bytes_left() + 8 * unit;
      if (is_refused) flash.is_programmed[place / 8] = true;
      if (!is_refused) flash.worn_out = place;
      REQUIRE(learn(learned, 2) == Status::not_written);
      REQUIRE(known(learned.model()) == "1");
      flash.worn_out = Flash<8>::forever;
      flash.is_programmed[place / 8] = false;
      REQUIRE(learn(learned, 3) == Status::ok);
      REQUIRE(known_after_restart(flash) == "13");
    }
  }
}

TEST_CASE("learned objects: whatever bytes change, what is known is as it was learned") {
  Flash<8> flash(1024);
  Learned<8> learned;
  REQUIRE(learned.open(nothing, flash) == Status::ok);
  for (std::uint32_t object = 1; object <= 3; ++object) REQUIRE(learn(learned, object) == Status::ok);
  std::size_t fewer = 0;
  for (std::size_t i = 0; i < flash.size_bytes(); ++i) {
    for (const unsigned flipped : {1u, 128u, 255u}) {
      Flash<8> damaged = flash;
      damaged.content[i] = static_cast<std::uint8_t>(damaged.content[i] ^ flipped);
      const std::string names = known_after_restart(damaged);
      REQUIRE((names == "123" || names == "12" || names == "13" || names == "23"));
      fewer += names == "123" ? 0 : 1;
    }
  }
  CHECK(fewer > 3 * 500);
  for (std::size_t size = 8; size < flash.size_bytes(); ++size) {
    Flash<8> cut = flash;
    cut.content.resize(size);
    cut.content.shrink_to_fit();
    const std::string names = known_after_restart(cut);
    REQUIRE(names == std::string("123").substr(0, names.size()));
  }
}

TEST_CASE("learned objects: a model of several objects, or of another size, is none that was learned") {
  ss::Recognizer recognizer;
  for (std::uint32_t object = 1; object <= 2; ++object) {
    REQUIRE(ss::train(recognizer, stored<Stored>(view_of<D>(object, no_motion, object)), center, "made",
                      std::to_string(object)) == Status::ok);
  }
  std::vector<std::uint8_t> bytes;
  REQUIRE(ss::save_for_flash<Stored>(recognizer, bytes) == Status::ok);
  Flash<4> flash(4096);
  std::memcpy(flash.content.data() + 64, bytes.data(), bytes.size());
  Learned<4> learned;
  REQUIRE(learned.open(nothing, flash) == Status::ok);
  CHECK(learned.model().codeword_count() == 0);
  CHECK(learned.bytes_left() <= 4096 - 64 - bytes.size() + 4);
  CHECK(learn(learned, 1) == Status::ok);
  CHECK(known_after_restart(flash) == "1");
}

}  // namespace test_learned_objects_survive
