// Recognizers with fewer codewords: how many, whose, which; and what is recognized with them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "stored_views.hpp"

namespace test_thin {
namespace {

using namespace unit;
using ss::Status;

using D = ss::ShapeColor32;
using Nibbles = ss::NibbleDescriptor<D>;
using Bits = ss::SumBits<D, 256>;
using Bytes = std::vector<std::uint8_t>;
constexpr std::uint32_t objects = 8;

/// Views of eight objects: of the first one nine, of the second one seven, of the others three. Every second view is of
/// something else: its key points are as in no other view.
template <class Stored>
ss::Recognizer trained() {
  ss::Recognizer recognizer({0.02f, 1, 8});
  Random random(3);
  for (std::uint32_t object = 0; object < objects; ++object) {
    const std::string name = std::to_string(object);
    const std::uint32_t views = object == 0 ? 9u : object == 1 ? 7u : 3u;
    for (std::uint32_t view = 0; view < views; ++view) {
      const Motion motion = random_motion(random);
      const std::uint32_t shown = view % 2 == 0 ? object : 100 * object + view;
      REQUIRE(ss::train(recognizer, stored<Stored>(view_of<D>(shown, motion, 100 * object + view)), motion.translation,
                        "class " + std::to_string(object % 3), name) == Status::ok);
    }
  }
  return recognizer;
}

template <class Stored>
std::size_t right(const ss::Recognizer& recognizer) {
  Random random(7);
  std::size_t right = 0;
  for (std::uint32_t object = 0; object < objects; ++object) {
    const Motion motion = random_motion(random);
    std::vector<ss::Hypothesis> found;
    REQUIRE(ss::recognize(recognizer, stored<Stored>(view_of<D>(object, motion, 5000 + object)), found) == Status::ok);
    const bool is_named = !found.empty() && recognizer.instance_name(found[0].instance) == std::to_string(object);
    right += is_named && distance(found[0].center, motion.translation) < 0.01f ? 1 : 0;
  }
  return right;
}

template <class Stored>
Bytes model_of(const ss::Recognizer& recognizer) {
  Bytes bytes;
  REQUIRE(ss::save_for_flash<Stored>(recognizer, bytes) == Status::ok);
  return bytes;
}

std::vector<std::size_t> codewords_of_instances(const ss::Recognizer& recognizer) {
  std::vector<std::size_t> counts(recognizer.instance_count());
  for (const auto& codeword : ss::detail::RecognizerAccess::codebook(recognizer).codewords) ++counts[codeword.instance];
  return counts;
}

template <class Stored>
void check_thinned() {
  const ss::Recognizer all = trained<Stored>();
  REQUIRE((all.codeword_count() == 34 * 11 && right<Stored>(all) == objects));
  for (const std::size_t most : {373u, 200u, 88u, 40u, 8u}) {
    CAPTURE(most);
    ss::Recognizer thinned;
    REQUIRE(ss::thin<Stored>(all, most, thinned) == Status::ok);
    CHECK(thinned.codeword_count() == most);
    CHECK((thinned.class_count() == 3 && thinned.instance_count() == objects && thinned.layout() == all.layout()));
    CHECK((thinned.options().bandwidth == 0.02f && thinned.instance_name(3) == "3" && thinned.class_of(3) == 0));
    if (most >= 40) CHECK(right<Stored>(thinned) == objects);

    const std::vector<std::size_t> before = codewords_of_instances(all);
    const std::vector<std::size_t> after = codewords_of_instances(thinned);
    std::size_t largest = 0;
    for (const std::size_t count : after) largest = std::max(largest, count);
    for (std::size_t i = 0; i < objects; ++i) CHECK(after[i] >= std::min(before[i], largest - 1));

    ss::Recognizer again;
    REQUIRE(ss::thin<Stored>(all, most, again) == Status::ok);
    CHECK(model_of<Stored>(again) == model_of<Stored>(thinned));
  }
}

/// Is each of these codewords one of those, in their order?
bool is_part(const ss::Recognizer& part, const ss::Recognizer& whole) {
  const auto& some = ss::detail::RecognizerAccess::codebook(part);
  const auto& all = ss::detail::RecognizerAccess::codebook(whole);
  std::size_t k = 0;
  for (std::size_t i = 0; i < all.codewords.size() && k < some.codewords.size(); ++i) {
    const bool same_place = distance(some.codewords[k].center, all.codewords[i].center) <= 0.0f;
    const bool same_row = std::equal(&all.packed[i * all.row_size], &all.packed[i * all.row_size] + all.row_size,
                                     &some.packed[k * all.row_size]);
    if (same_place && same_row && some.codewords[k].instance == all.codewords[i].instance) ++k;
  }
  return k == some.codewords.size() && some.packed.size() == k * all.row_size;
}

}  // namespace

TEST_CASE("thin: as many as asked for, as many of each instance, and all objects are still known") {
  check_thinned<Nibbles>();
  check_thinned<Bits>();
}

TEST_CASE("thin: what is seen again stays, what was seen once goes") {
  const ss::Recognizer all = trained<Bits>();
  ss::Recognizer thinned;
  REQUIRE(ss::thin<Bits>(all, 88, thinned) == Status::ok);  // 11 of each, of 33 in three views
  CHECK(is_part(thinned, all));
  const auto& kept = ss::detail::RecognizerAccess::codebook(thinned);
  std::size_t seen_again = 0;
  for (const auto& codeword : kept.codewords) {
    if (codeword.instance < 2) continue;
    const std::uint32_t once = 100 * codeword.instance + 1;  // the view between two of the object
    bool is_once = false;
    const auto view = view_of<D>(once, no_motion, 1);
    for (std::size_t i = 0; i < view.size(); ++i) {
      const ss::Point center = ss::detail::to_local({}, view.keypoints[i].position, view.frames[i]);
      is_once = is_once || distance(center, codeword.center) < 0.0001f;
    }
    seen_again += is_once ? 0 : 1;
  }
  CHECK(seen_again == 6 * 11);
}

TEST_CASE("thin: who was seen more often can spare some, whose votes others cast as well") {
  ss::Recognizer all({0.001f, 1, 8});  // no two key points vote for the same place by chance
  for (const std::uint32_t shown : {1u, 1u, 1u, 1u, 2u, 2u}) {
    const auto seed = static_cast<std::uint32_t>(all.codeword_count()) + 1;
    REQUIRE(ss::train(all, stored<Bits>(view_of<D>(shown, no_motion, seed)), {}, "a", "b") == Status::ok);
  }
  ss::Recognizer thinned;
  REQUIRE(ss::thin<Bits>(all, 44, thinned) == Status::ok);  // 2 of 4 and 2 of 2 views of 11 key points
  const auto& whole = ss::detail::RecognizerAccess::codebook(all);
  const auto& kept = ss::detail::RecognizerAccess::codebook(thinned);
  CHECK(std::equal(kept.packed.end() - 22 * sizeof(Bits), kept.packed.end(), whole.packed.end() - 22 * sizeof(Bits)));
}

TEST_CASE("thin: a model is as large as it may be, and no larger") {
  const ss::Recognizer all = trained<Nibbles>();
  const std::size_t whole = model_of<Nibbles>(all).size();
  const std::size_t codeword = sizeof(Nibbles) + 8;
  ss::Recognizer thinned;
  REQUIRE(ss::thin<Nibbles>(all, objects, thinned) == Status::ok);
  const std::size_t least = model_of<Nibbles>(thinned).size();
  std::vector<std::size_t> budgets{2000, 5000, 7001};
  for (std::size_t i = 0; i < 60; ++i) budgets.push_back(least + i);
  for (std::size_t i = 0; i < 60; ++i) budgets.push_back(whole - 50 + i);
  for (const std::size_t most : budgets) {
    REQUIRE(ss::thin_for_flash<Nibbles>(all, most, thinned) == Status::ok);
    const std::size_t size = model_of<Nibbles>(thinned).size();
    REQUIRE(size <= most);
    if (thinned.codeword_count() < all.codeword_count()) {
      REQUIRE((size + codeword + 3) / 4 * 4 > most / 4 * 4);
    } else {
      REQUIRE((size == whole && is_part(all, thinned)));
    }
  }
  CHECK(thinned.codeword_count() == all.codeword_count());
}

TEST_CASE("thin: what cannot be is a status, and changes nothing") {
  const ss::Recognizer all = trained<Nibbles>();
  ss::Recognizer out;
  CHECK(ss::thin<Nibbles>(out, 10, out) == Status::not_trained);
  CHECK(ss::thin_for_flash<Nibbles>(out, 10, out) == Status::not_trained);
  CHECK(ss::thin<Nibbles>(all, objects - 1, out) == Status::bad_option);
  CHECK(ss::thin<Bits>(all, 100, out) == Status::other_descriptor);
  std::size_t least = 0;
  while (ss::thin_for_flash<Nibbles>(all, least, out) == Status::out_of_memory) ++least;
  CHECK((out.codeword_count() == objects && model_of<Nibbles>(out).size() == least));
  CHECK(ss::thin_for_flash<Bits>(all, 100000, out) == Status::other_descriptor);
  ss::Recognizer odd = all;
  odd.set_options({0.0f, 1, 8});
  CHECK(ss::thin<Nibbles>(odd, 100, out) == Status::bad_option);
  ss::Recognizer floats;
  REQUIRE(ss::train(floats, view_of<D>(1, no_motion, 1), {}, "a", "b") == Status::ok);
  CHECK(ss::thin<Nibbles>(floats, 100, out) == Status::other_descriptor);
  CHECK(out.codeword_count() == objects);
  ss::Recognizer same = all;
  REQUIRE(ss::thin<Nibbles>(same, 100, same) == Status::ok);
  CHECK(same.codeword_count() == 100);
}

}  // namespace test_thin
