// Recognition without a heap: the hypotheses of recognize() with the same model, bit for bit, of codes and bits; what
// it refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "stored_views.hpp"

namespace test_micro_recognizer {
namespace {

using namespace unit;
using ss::Status;

using D = ss::ShapeColor32;
constexpr std::size_t keypoints = 40;

/// Twelve objects of three classes; every fourth one is known twice, by two names: its votes are as heavy.
template <class Stored>
ss::Recognizer trained(const ss::RecognizerOptions& options) {
  ss::Recognizer recognizer(options);
  for (std::uint32_t object = 1; object <= 12; ++object) {
    const std::string name = std::to_string(object);
    const ss::Point center{0.01f * static_cast<float>(object), 0.0f, -0.02f};
    const auto view = stored<Stored>(view_of<D>(object, no_motion, object));
    REQUIRE(ss::train(recognizer, view, center, "class " + std::to_string(object % 3), name) == Status::ok);
    if (object % 4 == 0) {
      REQUIRE(ss::train(recognizer, view, center, "class " + std::to_string(object % 3), name + " again") ==
              Status::ok);
    }
  }
  return recognizer;
}

template <class Stored>
ss::StoredFeatures<Stored> scene(std::uint32_t seed) {
  Random random(seed);
  ss::StoredFeatures<Stored> all;
  for (int part = 0; part < 3; ++part) {
    const auto object = 1 + static_cast<std::uint32_t>(random.between(0.0f, 11.9f));
    const auto one = stored<Stored>(view_of<D>(object, random_motion(random), seed));
    for (std::size_t i = 0; i < one.size(); ++i) {
      all.descriptors.push_back(one.descriptors[i]);
      all.status.push_back(one.status[i]);
      all.keypoints.push_back(one.keypoints[i]);
      all.frames.push_back(one.frames[i]);
      all.frame_confidence.push_back({});
      all.neighbors.push_back(10);
    }
  }
  return all;
}

template <class Stored>
void check_same(const ss::RecognizerOptions& options) {
  CAPTURE(ss::storage_layout<Stored>());
  CAPTURE(options.neighbors);
  std::vector<std::uint8_t> bytes;
  REQUIRE(ss::save_for_flash<Stored>(trained<Stored>(options), bytes) == Status::ok);
  ss::ModelView<Stored> model;
  REQUIRE(model.open(bytes.data(), bytes.size()) == Status::ok);
  ss::Recognizer hosted;
  REQUIRE(ss::load_from_flash<Stored>(bytes.data(), bytes.size(), hosted) == Status::ok);

  ss::MicroRecognizer<Stored, keypoints, 64, 3> recognizer;
  std::size_t hypotheses = 0;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    const auto view = scene<Stored>(seed);
    std::vector<ss::Hypothesis> expected;
    REQUIRE(ss::recognize(hosted, view, expected) == Status::ok);
    recognizer.start(model);
    for (std::size_t i = 0; i < view.size(); ++i) {
      if (view.status[i] != Status::ok) continue;
      REQUIRE(recognizer.add(view.descriptors[i], view.keypoints[i].position, view.frames[i]) == Status::ok);
    }
    ss::Hypothesis found[16];
    const std::size_t count = recognizer.finish(found);
    expected.resize(std::min<std::size_t>(16, expected.size()));
    CHECK(same_bits({found, found + count}, expected));
    ss::Hypothesis first[1];
    REQUIRE(recognizer.finish(first) == 1);
    CHECK(same_bits({first, first + 1}, {expected[0]}));
    hypotheses += count;
  }
  CHECK(hypotheses > 8);
}

TestCloud patch() { return curved_surface(7, 3000); }

}  // namespace

TEST_CASE("micro recognizer: the hypotheses of recognize(), bit for bit, of codes and of bits") {
  check_same<ss::NibbleDescriptor<D>>({0.03f, 1, 8});
  check_same<ss::CodedDescriptor<D, 3>>({0.01f, 1, 8});
  check_same<ss::SumBits<D, 256>>({0.05f, 1, 8});
}

TEST_CASE("micro recognizer: also with several codewords, fewer hypotheses, and wide and narrow densities") {
  for (const float bandwidth : {0.001f, 0.03f, 0.3f}) {
    check_same<ss::NibbleDescriptor<D>>({bandwidth, 2, 8});
    check_same<ss::NibbleDescriptor<D>>({bandwidth, 3, 100});
    check_same<ss::SumBits<D, 256>>({bandwidth, 3, 2});
  }
}

TEST_CASE("micro recognizer: from points to hypotheses as extract() and recognize()") {
  using Stored = ss::NibbleDescriptor<D>;
  const TestCloud cloud = patch();
  const ss::CloudView view = cloud.view();
  const ss::GridSearch search(view, 0.03f);
  std::vector<std::uint32_t> places;
  for (std::uint32_t i = 0; i < 30; ++i) places.push_back(97 * i);
  ss::Features<D> features;
  REQUIRE(ss::extract<D>(view, search, places, 0.03f, features) == Status::ok);
  ss::Recognizer trained;
  REQUIRE(ss::train(trained, stored<Stored>(features), {0.0f, 0.0f, 0.9f}, "patch", "one") == Status::ok);
  std::vector<std::uint8_t> bytes;
  REQUIRE(ss::save_for_flash<Stored>(trained, bytes) == Status::ok);
  ss::Recognizer hosted;
  REQUIRE(ss::load_from_flash<Stored>(bytes.data(), bytes.size(), hosted) == Status::ok);
  ss::ModelView<Stored> model;
  REQUIRE(model.open(bytes.data(), bytes.size()) == Status::ok);

  for (std::uint32_t& place : places) place += 11;
  REQUIRE(ss::extract<D>(view, search, places, 0.03f, features) == Status::ok);
  std::vector<ss::Hypothesis> expected;
  REQUIRE(ss::recognize(hosted, stored<Stored>(features), expected) == Status::ok);

  ss::MicroRecognizer<Stored, keypoints> recognizer;
  recognizer.start(model);
  for (std::size_t i = 0; i < places.size(); ++i) {
    CHECK(recognizer.add(view, search, places[i], 0.03f) == features.status[i]);
  }
  ss::Hypothesis found[8];
  const std::size_t count = recognizer.finish(found);
  CHECK(count > 0);
  CHECK(same_bits({found, found + count}, expected));
}

TEST_CASE("micro recognizer: what cannot be is a status, and casts no vote") {
  using Stored = ss::NibbleDescriptor<D>;
  const auto view = scene<Stored>(1);
  const auto add = [&](auto& recognizer) {
    return recognizer.add(view.descriptors[0], view.keypoints[0].position, view.frames[0]);
  };
  ss::MicroRecognizer<Stored, 2, 64> untrained;
  CHECK(add(untrained) == Status::not_trained);
  untrained.start(ss::ModelView<Stored>{});
  CHECK(add(untrained) == Status::not_trained);
  ss::Hypothesis found[2];
  CHECK(untrained.finish(found) == 0);

  std::vector<std::uint8_t> bytes;
  REQUIRE(ss::save_for_flash<Stored>(trained<Stored>({0.03f, 2, 8}), bytes) == Status::ok);
  ss::ModelView<Stored> model;
  REQUIRE(model.open(bytes.data(), bytes.size()) == Status::ok);
  ss::MicroRecognizer<Stored, 2, 64> of_one;
  of_one.start(model);
  CHECK(add(of_one) == Status::bad_option);
  ss::MicroRecognizer<Stored, 2, 64, 2> small;
  small.start(model);
  const ss::Point nowhere{not_a_number, 0.0f, 0.0f};
  ss::Frame broken = view.frames[0];
  broken.x[1] = 2.0f;
  CHECK(small.add(view.descriptors[0], nowhere, view.frames[0]) == Status::invalid_keypoint);
  CHECK(small.add(view.descriptors[0], view.keypoints[0].position, broken) == Status::bad_frame);
  const TestCloud cloud = patch();
  CHECK(small.add(cloud.view(), ss::BruteSearch{cloud.view()}, 0, 0.03f) == Status::too_many_neighbors);
  CHECK(small.add(cloud.view(), ss::BruteSearch{cloud.view()}, 3000, 0.005f) == Status::bad_keypoint);
  CHECK(small.finish(found) == 0);
  CHECK(add(small) == Status::ok);
  CHECK(add(small) == Status::ok);
  CHECK(add(small) == Status::out_of_memory);
  CHECK(small.finish(found) > 0);
  small.start(model);
  CHECK(small.finish(found) == 0);
  CHECK(add(small) == Status::ok);
}

}  // namespace test_micro_recognizer
