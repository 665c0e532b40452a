// Recognizers of stored descriptors: the same hypotheses as of the floats that they stand for, saved and loaded.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stored_views.hpp"

namespace test_recognize_stored {
namespace {

using namespace unit;
using ss::Status;

using D = ss::ShapeColor32;

template <class Stored>
void check_recognizer() {
  Random random(5);
  const Motion motion = random_motion(random);
  ss::Recognizer recognizer({0.03f, 2, 4});
  REQUIRE(ss::train(recognizer, stored<Stored>(view_of<D>(1, no_motion, 1)), {0.0f, 0.0f, 0.0f}, "mug", "red") ==
          Status::ok);
  REQUIRE(ss::train(recognizer, stored<Stored>(view_of<D>(2, no_motion, 2)), {0.1f, 0.0f, 0.0f}, "cup", "") ==
          Status::ok);
  CHECK((recognizer.codeword_count() == 22 && recognizer.layout() == ss::storage_layout<Stored>()));

  std::vector<std::uint8_t> bytes;
  REQUIRE(ss::save(recognizer, bytes) == Status::ok);
  ss::Recognizer loaded;
  REQUIRE(ss::load(bytes.data(), bytes.size(), ss::storage_layout<Stored>(), loaded) == Status::ok);
  CHECK(ss::load(bytes.data(), bytes.size(), ss::layout_of<D>(), loaded) == Status::other_descriptor);
  for (std::size_t cut = 0; cut < bytes.size(); cut += 1 + cut / 20) {
    REQUIRE(ss::load(bytes.data(), cut, ss::storage_layout<Stored>(), loaded) != Status::ok);
  }

  const auto query = stored<Stored>(view_of<D>(2, motion, 3));
  for (const ss::Recognizer* const one : {&recognizer, &loaded}) {
    std::vector<ss::Hypothesis> found;
    REQUIRE(ss::recognize(*one, query, found, 2u) == Status::ok);
    REQUIRE(!found.empty());
    const ss::Point center = motion(ss::Point{0.1f, 0.0f, 0.0f});
    CHECK(one->class_name(found[0].object_class) == "cup");
    CHECK((std::fabs(found[0].center.x - center.x) < 0.01f && std::fabs(found[0].center.y - center.y) < 0.01f));
    ss::ActivationShares shares;
    REQUIRE(ss::activation_shares(*one, query, shares) == Status::ok);
    CHECK(shares.classes[1] >= 0.5f);
  }

  std::vector<ss::Hypothesis> found(3);
  CHECK(ss::recognize(recognizer, view_of<D>(2, motion, 3), found) == Status::other_descriptor);  // floats
  CHECK(found.empty());
  auto broken = query;
  broken.frames.pop_back();
  CHECK(ss::recognize(recognizer, broken, found) == Status::bad_rows);
  CHECK(ss::train(recognizer, broken, {0.0f, 0.0f, 0.0f}, "a", "b") == Status::bad_rows);
  broken = query;
  broken.frames[0].x[0] = not_a_number;
  CHECK(ss::recognize(recognizer, broken, found) == Status::bad_frame);
  ss::Recognizer of_floats;
  REQUIRE(ss::train(of_floats, view_of<D>(1, no_motion, 1), {0.0f, 0.0f, 0.0f}, "mug", "red") == Status::ok);
  CHECK(ss::train(of_floats, query, {0.0f, 0.0f, 0.0f}, "mug", "red") == Status::other_descriptor);
}

}  // namespace

TEST_CASE_TEMPLATE("recognizer: of every storage, saved and loaded", Stored, ss::HalfDescriptor<D>,
                   ss::ByteDescriptor<D>, ss::NibbleDescriptor<D>, ss::CodedDescriptor<D, 3>, ss::SumBits<D>,
                   ss::BinaryDescriptor<D>) {
  check_recognizer<Stored>();
}

TEST_CASE("recognizer: nibbles find what the floats find that they stand for") {
  using Stored = ss::NibbleDescriptor<D>;
  ss::Recognizer of_nibbles({0.05f, 3, 6}), of_floats({0.05f, 3, 6});
  const auto train_both = [&](std::uint32_t object, const char* name) {
    const auto nibbles = stored<Stored>(view_of<D>(object, no_motion, object));
    ss::Features<D> floats = view_of<D>(object, no_motion, object);
    for (std::size_t i = 0; i < nibbles.size(); ++i) {
      ss::dequantize(nibbles.descriptors[i], floats.values.data() + i * std::size_t{D::size});
    }
    REQUIRE(ss::train(of_nibbles, nibbles, {0.0f, 0.0f, 0.0f}, name, "") == Status::ok);
    REQUIRE(ss::train(of_floats, floats, {0.0f, 0.0f, 0.0f}, name, "") == Status::ok);
  };
  train_both(1, "a");
  train_both(2, "b");
  train_both(3, "c");
  Random random(8);
  const Motion motion = random_motion(random);
  const auto query = stored<Stored>(view_of<D>(2, motion, 9));
  ss::Features<D> floats = view_of<D>(2, motion, 9);
  for (std::size_t i = 0; i < query.size(); ++i) {
    ss::dequantize(query.descriptors[i], floats.values.data() + i * std::size_t{D::size});
  }
  std::vector<ss::Hypothesis> mine, theirs;
  REQUIRE(ss::recognize(of_nibbles, query, mine) == Status::ok);
  REQUIRE(ss::recognize(of_floats, floats, theirs) == Status::ok);
  REQUIRE((mine.size() == theirs.size() && mine.size() > 1));
  for (std::size_t i = 0; i < mine.size(); ++i) {
    CHECK((mine[i].object_class == theirs[i].object_class && mine[i].score == theirs[i].score &&
           mine[i].center.x == theirs[i].center.x));
  }
}

}  // namespace test_recognize_stored
