// Objects that are learned on the spot: the hypotheses of a hosted recognizer of the same codewords, bit for bit; names
// and numbers; what is refused.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "flash_simulator.hpp"
#include "stored_views.hpp"

namespace test_learned_objects {
namespace {

using namespace unit;
using ss::Status;

using D = ss::ShapeColor32;
using Nibbles = ss::NibbleDescriptor<D>;
using Bits = ss::SumBits<D, 256>;
constexpr ss::Point middle{0.01f, 0.0f, -0.02f};

template <class Stored>
std::vector<ss::StoredKeyPoint<Stored>> keys_of(const ss::Features<D>& features) {
  const auto view = stored<Stored>(features);
  std::vector<ss::StoredKeyPoint<Stored>> keys;
  for (std::size_t i = 0; i < view.size(); ++i) {
    if (view.status[i] == Status::ok) keys.push_back({view.descriptors[i], view.keypoints[i].position, view.frames[i]});
  }
  return keys;
}

/// Adds all key points of an object's view; the first status that is not ok.
template <class Learned, class Stored>
Status add_all(Learned& learned, const std::vector<ss::StoredKeyPoint<Stored>>& keys) {
  Status status = Status::ok;
  for (const auto& key : keys) {
    if (status == Status::ok) status = learned.add(key, middle);
  }
  return status;
}

template <class Learned>
void learn(Learned& learned, std::uint32_t object, const char* object_class, const char* instance) {
  using Stored = std::decay_t<decltype(learned.model().descriptor(0))>;
  REQUIRE(add_all(learned, keys_of<Stored>(view_of<D>(object, no_motion, object))) == Status::ok);
  REQUIRE(learned.commit(object_class, instance) == Status::ok);
}

template <class Stored>
std::vector<std::uint8_t> trained_model(const ss::RecognizerOptions& options) {
  ss::Recognizer recognizer(options);
  const auto train = [&](std::uint32_t object, const char* object_class, const char* instance) {
    REQUIRE(ss::train(recognizer, stored<Stored>(view_of<D>(object, no_motion, object)), middle, object_class,
                      instance) == Status::ok);
  };
  train(1, "mug", "red");
  train(2, "can", "red");
  train(3, "mug", "blue");
  std::vector<std::uint8_t> bytes;
  REQUIRE(ss::save_for_flash<Stored>(recognizer, bytes) == Status::ok);
  return bytes;
}

template <class Stored>
std::vector<ss::Hypothesis> ask(const ss::ModelView<Stored>& model, const ss::Features<D>& view) {
  static ss::MicroRecognizer<Stored, 40, 5, 3> recognizer;
  recognizer.start(model);
  for (const auto& key : keys_of<Stored>(view)) {
    REQUIRE(recognizer.add(key.descriptor, key.position, key.frame) == Status::ok);
  }
  ss::Hypothesis found[8];
  const std::size_t count = recognizer.finish(found);
  return {found, found + count};
}

template <class Stored>
std::string name_of(const ss::ModelView<Stored>& model, const ss::Hypothesis& hypothesis) {
  return std::string(model.class_name(hypothesis.object_class)) + " " + model.instance_name(hypothesis.instance);
}

template <class Stored, std::size_t UnitBytes>
void check_same(const ss::RecognizerOptions& options) {
  CAPTURE(ss::storage_layout<Stored>());
  CAPTURE(UnitBytes);
  const auto bytes = trained_model<Stored>(options);
  ss::ModelView<Stored> trained;
  REQUIRE(trained.open(bytes.data(), bytes.size()) == Status::ok);
  FlashSimulator<UnitBytes> flash(8192);
  ss::LearnedObjects<Stored, FlashSimulator<UnitBytes>> learned;
  REQUIRE(learned.open(trained, flash) == Status::ok);
  learn(learned, 4, "mug", "green");  // a known class
  learn(learned, 5, "box", "red");    // a new one
  learn(learned, 6, "mug", "red");    // another view of a known object
  learn(learned, 7, "box", "red");    // and of one that was learned
  const ss::ModelView<Stored>& model = learned.model();
  CHECK((model.class_count() == 3 && model.instance_count() == 5 && model.codeword_count() == 77));
  CHECK((model.instance_of(32) == 2 && model.instance_of(33) == 3 && model.instance_of(44) == 4));
  CHECK((model.instance_of(55) == 0 && model.instance_of(76) == 4));
  CHECK((model.class_of(3) == 0 && model.class_of(4) == 2));

  ss::Recognizer hosted;
  REQUIRE(ss::load_from_flash(model, hosted) == Status::ok);
  ss::LearnedObjects<Stored, FlashSimulator<UnitBytes>> again;
  REQUIRE(again.open(trained, flash) == Status::ok);
  CHECK(again.bytes_left() == learned.bytes_left());
  const char* const names[] = {"mug red", "can red", "mug blue", "mug green", "box red", "mug red", "box red"};
  Random random(9);
  for (std::uint32_t object = 1; object <= 7; ++object) {
    const auto view = view_of<D>(object, random_motion(random), 100 + object);
    std::vector<ss::Hypothesis> expected;
    REQUIRE(ss::recognize(hosted, stored<Stored>(view), expected) == Status::ok);
    const auto found = ask(model, view);
    REQUIRE(!found.empty());
    CHECK(same_bits(found, expected));
    CHECK(same_bits(ask(again.model(), view), expected));
    CHECK(name_of(model, found[0]) == names[object - 1]);
    CHECK(hosted.class_name(found[0].object_class) + " " + hosted.instance_name(found[0].instance) ==
          names[object - 1]);
    CHECK(hosted.class_of(found[0].instance) == found[0].object_class);
  }
  CHECK(flash.refused == 0);
}

}  // namespace

TEST_CASE("learned objects: the hypotheses of a hosted recognizer with the same codewords, bit for bit") {
  check_same<Nibbles, 8>({0.03f, 1, 8});
  check_same<Nibbles, 1>({0.03f, 3, 8});
  check_same<Bits, 32>({0.02f, 1, 8});
  check_same<Bits, 64>({0.05f, 2, 3});
  check_same<ss::CodedDescriptor<D, 3>, 4>({0.03f, 1, 8});
}

TEST_CASE("learned objects: centers are rounded by at most a 512th of the bandwidth") {
  ss::RamMemory<4096> memory;
  memory.erase();
  for (const float bandwidth : {0.0199f, 0.0156250f, 1000.0f}) {
    ss::LearnedObjects<Nibbles, ss::RamMemory<4096>> learned;
    REQUIRE(learned.open(ss::ModelView<Nibbles>({bandwidth, 1, 8}), memory) == Status::ok);
    const auto keys = keys_of<Nibbles>(view_of<D>(4, no_motion, 4));
    REQUIRE(add_all(learned, keys) == Status::ok);
    REQUIRE(learned.commit("mug", std::to_string(bandwidth).c_str()) == Status::ok);
    const std::uint32_t first = learned.model().codeword_count() - static_cast<std::uint32_t>(keys.size());
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
      const ss::Point exact = ss::detail::to_local(middle, keys[i].position, keys[i].frame);
      const ss::Point center = learned.model().center_of(first + i);
      CHECK(std::fabs(center.x - exact.x) <= bandwidth / 512.0f);
      CHECK(std::fabs(center.y - exact.y) <= bandwidth / 512.0f);
      CHECK(std::fabs(center.z - exact.z) <= bandwidth / 512.0f);
    }
  }
}

TEST_CASE("learned objects: from nothing, and from points as describe() sees them") {
  const TestCloud cloud = curved_surface(7, 3000);
  const ss::CloudView view = cloud.view();
  const ss::GridSearch search(view, 0.03f);
  ss::RamMemory<4096> memory;
  memory.erase();
  ss::LearnedObjects<Nibbles, ss::RamMemory<4096>, 2> learned;
  REQUIRE(learned.open(ss::ModelView<Nibbles>({0.03f, 1, 8}), memory) == Status::ok);
  ss::MicroRecognizer<Nibbles, 40> recognizer;
  recognizer.start(learned.model());
  CHECK(recognizer.add(view, search, 0, 0.03f) == Status::not_trained);
  ss::StoredKeyPoint<Nibbles> key;
  std::size_t added = 0;
  for (std::size_t i = 0; i < 2000; i += 100) {
    if (recognizer.describe(view, search, i, 0.03f, key) != Status::ok) continue;
    CHECK(learned.add(key, {0.0f, 0.0f, 0.9f}) == Status::ok);
    ++added;
  }
  REQUIRE(added > 10);
  REQUIRE(learned.commit("patch", "one") == Status::ok);
  recognizer.start(learned.model());
  for (std::size_t i = 0; i < 2000; i += 100) static_cast<void>(recognizer.add(view, search, i, 0.03f));
  ss::Hypothesis found[1];
  REQUIRE(recognizer.finish(found) == 1);
  CHECK(found[0].score > 0.9f * static_cast<float>(added));
  CHECK(distance(found[0].center, {0.0f, 0.0f, 0.9f}) < 0.001f);
  CHECK(recognizer.describe(view, search, 3000, 0.03f, key) == Status::bad_keypoint);
  CHECK((key.position.z == 0.0f && key.frame.x[0] == 0.0f && key.descriptor.bytes[0] == 0));
}

TEST_CASE("learned objects: what cannot be is a status, and leaves what is known") {
  using Memory = ss::RamMemory<1024>;
  const ss::ModelView<Nibbles> nothing({0.02f, 1, 8});
  const auto keys = keys_of<Nibbles>(view_of<D>(4, no_motion, 4));
  Memory memory;
  ss::LearnedObjects<Nibbles, Memory, 2> learned;
  CHECK((learned.add(keys[0], middle) == Status::not_trained && learned.commit("a", "b") == Status::not_trained));
  CHECK((learned.bytes_left() == 0 && learned.model().codeword_count() == 0));
  learned.discard();
  CHECK(learned.open(ss::ModelView<Nibbles>(), memory) == Status::bad_option);
  FlashSimulator<8> none(0);
  ss::LearnedObjects<Nibbles, FlashSimulator<8>> homeless;
  CHECK(homeless.open(nothing, none) == Status::bad_view);
  REQUIRE(learned.open(nothing, memory) == Status::ok);  // of zeros, which are not erased
  CHECK((learned.add(keys[0], middle) == Status::out_of_memory && learned.bytes_left() == 0));

  memory.erase();
  REQUIRE(learned.open(nothing, memory) == Status::ok);
  ss::StoredKeyPoint<Nibbles> broken = keys[0];
  broken.position.y = not_a_number;
  CHECK(learned.add(broken, middle) == Status::invalid_keypoint);
  broken = keys[0];
  broken.frame.x[1] = 2.0f;
  CHECK(learned.add(broken, middle) == Status::bad_frame);
  CHECK(learned.add(keys[0], {0.0f, not_a_number, 0.0f}) == Status::invalid_keypoint);
  CHECK(learned.add(keys[0], {9.0f, 0.0f, 0.0f}) == Status::invalid_keypoint);
  CHECK(learned.add(keys[0], {3e38f, 3e38f, -3e38f}) == Status::invalid_keypoint);
  CHECK(learned.commit("a", "b") == Status::not_trained);

  CHECK(learned.add(keys[0], middle) == Status::ok);
  CHECK((learned.commit(nullptr, "b") == Status::bad_option && learned.commit("a", nullptr) == Status::bad_option));
  CHECK(learned.commit("a", std::string(2000, 'b').c_str()) == Status::out_of_memory);
  CHECK(learned.commit("a", std::string(1024 - 64 - 24 - 8 - 4 - 8, 'b').c_str()) == Status::out_of_memory);
  CHECK(learned.commit("", "") == Status::ok);
  CHECK((learned.model().instance_count() == 1 && learned.model().instance_name(0) == std::string()));

  CHECK(learned.add(keys[1], middle) == Status::ok);
  learned.discard();
  CHECK(learned.commit("c", "d") == Status::not_trained);
  CHECK((learned.add(keys[2], middle) == Status::ok && learned.commit("c", "d") == Status::ok));
  CHECK(learned.model().codeword_count() == 2);
  CHECK((learned.add(keys[3], middle) == Status::ok && learned.commit("e", "f") == Status::out_of_memory));
  Status status = Status::ok;
  std::size_t more = 0;
  for (; status == Status::ok && more < 100; ++more) status = learned.add(keys[3], middle);
  CHECK((status == Status::out_of_memory && more > 10));

  ss::LearnedObjects<Nibbles, Memory, 1> small;
  CHECK(small.open(nothing, memory) == Status::out_of_memory);
  CHECK((small.add(keys[0], middle) == Status::not_trained && small.model().instance_count() == 1));
  ss::LearnedObjects<Bits, Memory> other;
  CHECK(other.open(ss::ModelView<Bits>({0.02f, 1, 8}), memory) == Status::other_descriptor);
  ss::Recognizer hosted;
  CHECK(ss::load_from_flash(nothing, hosted) == Status::not_trained);
}

}  // namespace test_learned_objects
