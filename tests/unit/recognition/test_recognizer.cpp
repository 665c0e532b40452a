// Recognizer: objects made by hand are found where they are, and nothing but a Status comes of bad input.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "synthetic_objects.hpp"
#include "thread_pool.hpp"

namespace test_recognizer {
namespace {

using namespace unit;
using ss::Status;

constexpr ss::Point origin{0.0f, 0.0f, 0.0f};
const View cup = synthetic_object(1, 40);
const View red_mug = synthetic_object(2, 40);
const View blue_mug = synthetic_object(3, 60);

ss::Recognizer trained(const ss::RecognizerOptions& options = {}) {
  ss::Recognizer recognizer(options);
  REQUIRE(ss::train(recognizer, cup.rows(), synthetic_layout, origin, "cup", "a") == Status::ok);
  REQUIRE(ss::train(recognizer, red_mug.rows(), synthetic_layout, origin, "mug", "red") == Status::ok);
  REQUIRE(ss::train(recognizer, blue_mug.rows(), synthetic_layout, origin, "mug", "blue") == Status::ok);
  return recognizer;
}

std::vector<ss::Hypothesis> recognized(const ss::Recognizer& recognizer, const View& view) {
  std::vector<ss::Hypothesis> found(3);
  REQUIRE(ss::recognize(recognizer, view.rows(), synthetic_layout, found) == Status::ok);
  return found;
}

std::string name_of(const ss::Recognizer& recognizer, const ss::Hypothesis& found) {
  REQUIRE(recognizer.class_of(found.instance) == found.object_class);
  return recognizer.class_name(found.object_class) + ' ' + recognizer.instance_name(found.instance);
}

}  // namespace

TEST_CASE("recognizer: names, and what it is for") {
  CHECK(ss::Recognizer().layout().empty());
  const ss::Recognizer recognizer = trained({0.05f, 2, 3});
  CHECK(recognizer.options().bandwidth == 0.05f);
  CHECK(recognizer.layout() == synthetic_layout);
  CHECK(recognizer.row_size() == synthetic_size);
  CHECK(recognizer.codeword_count() == 140);
  REQUIRE(recognizer.class_count() == 2);
  REQUIRE(recognizer.instance_count() == 3);
  CHECK(recognizer.class_name(1) == "mug");
  CHECK(recognizer.instance_name(2) == "blue");
  CHECK(recognizer.class_of(0) == 0);
  CHECK(recognizer.class_of(2) == 1);
}

TEST_CASE("recognizer: an instance is known by both of its names") {
  ss::Recognizer recognizer = trained();
  REQUIRE(ss::train(recognizer, cup.rows(), synthetic_layout, origin, "cup", "red") == Status::ok);
  REQUIRE(ss::train(recognizer, cup.rows(), synthetic_layout, origin, "cup", "a") == Status::ok);
  CHECK(recognizer.class_count() == 2);
  CHECK(recognizer.instance_count() == 4);
  CHECK(recognizer.codeword_count() == 220);
}

TEST_CASE("recognizer: names may be its own, which a new class moves in memory") {
  ss::Recognizer recognizer;
  REQUIRE(ss::train(recognizer, cup.rows(), synthetic_layout, origin, "cup", "a") == Status::ok);
  for (const char* name : {"b", "c", "d", "e", "f"}) {
    const std::string& first = recognizer.class_name(0);
    REQUIRE(ss::train(recognizer, cup.rows(), recognizer.layout(), origin, name, first) == Status::ok);
    CHECK(recognizer.instance_name(recognizer.instance_count() - 1) == "cup");
  }
}

TEST_CASE("recognizer: all votes of an object, wherever it was moved, land on its center") {
  const ss::Recognizer recognizer = trained();
  Random random(7);
  for (std::uint32_t k = 0; k < 10; ++k) {
    const Motion motion = random_motion(random);
    const std::vector<ss::Hypothesis> found = recognized(recognizer, moved(red_mug, motion, 0.02f, k));
    REQUIRE(found.size() == 1);
    CHECK(name_of(recognizer, found[0]) == "mug red");
    CHECK(distance(found[0].center, motion.translation) < 1e-5f);
    CHECK(found[0].score == doctest::Approx(40.0).epsilon(1e-5));
  }
}

TEST_CASE("recognizer: the center is where it was put in training, not the origin") {
  Random random(8);
  const Motion in_training = random_motion(random);
  const Motion now = random_motion(random);
  const ss::Point center{0.3f, -0.2f, 0.1f};
  ss::Recognizer recognizer;
  REQUIRE(ss::train(recognizer, moved(cup, in_training).rows(), synthetic_layout, in_training(center), "cup", "a") ==
          Status::ok);
  const std::vector<ss::Hypothesis> found = recognized(recognizer, moved(cup, now));
  REQUIRE(found.size() == 1);
  CHECK(distance(found[0].center, now(center)) < 1e-5f);
}

TEST_CASE("recognizer: objects of one scene are found one by one, the one with most votes first") {
  const ss::Recognizer recognizer = trained();
  Random random(9);
  const Motion motions[] = {random_motion(random), random_motion(random), random_motion(random)};
  View scene = moved(cup, motions[0]);
  scene.append(moved(blue_mug, motions[1]));
  scene.append(moved(cup, motions[2]));
  scene.status[0] = scene.status[1] = Status::too_few_neighbors;  // the first cup is seen less well
  const std::vector<ss::Hypothesis> found = recognized(recognizer, scene);
  REQUIRE(found.size() == 3);
  CHECK(name_of(recognizer, found[0]) == "mug blue");
  CHECK(distance(found[0].center, motions[1].translation) < 1e-5f);
  CHECK(distance(found[1].center, motions[2].translation) < 1e-5f);
  CHECK(distance(found[2].center, motions[0].translation) < 1e-5f);
  CHECK(found[2].score == doctest::Approx(38.0).epsilon(1e-5));

  ss::Recognizer modest = recognizer;
  modest.set_options({0.03f, 1, 2});
  std::vector<ss::Hypothesis> first_two = found;
  first_two.pop_back();
  CHECK(same_bits(recognized(modest, scene), first_two));
}

TEST_CASE("recognizer: votes for two instances of a class add up, and the heavier one gives the name") {
  const ss::Recognizer recognizer = trained();
  View both = red_mug;
  both.append(blue_mug);
  for (std::size_t i = 0; i < 25; ++i) both.status[40 + i] = Status::too_few_neighbors;  // 40 red, 35 blue
  std::vector<ss::Hypothesis> found = recognized(recognizer, both);
  REQUIRE(found.size() == 1);
  CHECK(name_of(recognizer, found[0]) == "mug red");
  CHECK(found[0].score == doctest::Approx(75.0).epsilon(1e-5));
  for (std::size_t i = 0; i < 6; ++i) both.status[i] = Status::too_few_neighbors;  // 34 red, 35 blue
  found = recognized(recognizer, both);
  CHECK(name_of(recognizer, found[0]) == "mug blue");
}

TEST_CASE("recognizer: maxima within a bandwidth are one, those beyond it are two") {
  const Motion by_5_cm{{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}, {0.05f, 0.0f, 0.0f}};
  View scene = cup;
  scene.append(moved(cup, by_5_cm));
  CHECK(recognized(trained({0.01f, 1, 8}), scene).size() == 2);
  const std::vector<ss::Hypothesis> merged = recognized(trained({0.04f, 1, 8}), scene);
  REQUIRE(merged.size() == 1);
  CHECK(distance(merged[0].center, {0.025f, 0.0f, 0.0f}) < 1e-4f);
  CHECK(merged[0].score == doctest::Approx(80.0 * std::exp(-0.5 * 0.390625)).epsilon(1e-4));
}

TEST_CASE("recognizer: more neighbors activate more codewords") {
  ss::Recognizer recognizer = trained({0.03f, 2, 8});
  REQUIRE(ss::train(recognizer, cup.rows(), synthetic_layout, origin, "cup", "a") == Status::ok);
  CHECK(recognized(recognizer, cup)[0].score == doctest::Approx(80.0).epsilon(1e-5));
  recognizer.set_options({0.03f, 1024, 8});  // more than there are
  View corner = cup;
  for (std::size_t i = 2; i < corner.size(); ++i) corner.status[i] = Status::too_few_neighbors;
  ss::ActivationShares shares;
  REQUIRE(ss::activation_shares(recognizer, corner.rows().descriptors, synthetic_layout, shares) == Status::ok);
  CHECK(same_bits(shares.instances, {160.0f / 360.0f, 80.0f / 360.0f, 120.0f / 360.0f}));
  CHECK_FALSE(recognized(recognizer, corner).empty());
}

TEST_CASE("recognizer: shares of activated codewords") {
  const ss::Recognizer recognizer = trained();
  View scene = cup;
  scene.append(blue_mug);
  scene.append(red_mug);
  for (std::size_t i = 100; i < 140; ++i) scene.status[i] = i < 120 ? Status::ok : Status::bad_keypoint;
  ss::ActivationShares shares;
  REQUIRE(ss::activation_shares(recognizer, scene.rows().descriptors, synthetic_layout, shares) == Status::ok);
  CHECK(same_bits(shares.classes, {40.0f / 120.0f, 80.0f / 120.0f}));
  CHECK(same_bits(shares.instances, {40.0f / 120.0f, 20.0f / 120.0f, 60.0f / 120.0f}));

  scene.status.assign(scene.size(), Status::bad_keypoint);
  REQUIRE(ss::activation_shares(recognizer, scene.rows().descriptors, synthetic_layout, shares) == Status::ok);
  CHECK(same_bits(shares.classes, {0.0f, 0.0f}));
  CHECK(same_bits(shares.instances, {0.0f, 0.0f, 0.0f}));
  CHECK(ss::activation_shares(recognizer, scene.rows().descriptors, "other", shares) == Status::other_descriptor);
  CHECK((shares.classes.empty() && shares.instances.empty()));
}

TEST_CASE("recognizer: a view without descriptors is no error: nothing is found in it, nothing learnt from it") {
  ss::Recognizer recognizer = trained();
  View view = cup;
  view.status.assign(view.size(), Status::too_few_neighbors);
  view.values.assign(view.values.size(), not_a_number);  // of rows that do not count
  CHECK(recognized(recognizer, view).empty());
  CHECK(recognized(recognizer, View{}).empty());
  CHECK(ss::train(recognizer, view.rows(), synthetic_layout, origin, "new", "new") == Status::ok);
  CHECK(recognizer.class_count() == 2);

  ss::Recognizer untrained;
  CHECK(ss::train(untrained, view.rows(), "never mind", origin, "new", "new") == Status::ok);
  std::vector<ss::Hypothesis> found(1);
  CHECK(ss::recognize(untrained, cup.rows(), synthetic_layout, found) == Status::not_trained);
  CHECK(found.empty());
  CHECK(ss::train(untrained, cup.rows(), synthetic_layout, origin, "cup", "a") == Status::ok);
  CHECK(untrained.layout() == synthetic_layout);
}

TEST_CASE("recognizer: the result does not depend on the number of threads") {
  const ss::Recognizer recognizer = trained({0.02f, 3, 20});
  Random random(10);
  View scene = moved(cup, random_motion(random), 0.3f);
  scene.append(moved(blue_mug, random_motion(random), 0.3f));
  const std::vector<ss::Hypothesis> found = recognized(recognizer, scene);
  CHECK(found.size() == 20);
  std::vector<ss::Hypothesis> again;
  for (const unsigned threads : {0u, 2u, 3u, 100u}) {
    REQUIRE(ss::recognize(recognizer, scene.rows(), synthetic_layout, again, threads) == Status::ok);
    CHECK(same_bits(again, found));
  }
  ThreadPool pool(3);
  REQUIRE(ss::recognize(recognizer, scene.rows(), synthetic_layout, again, pool) == Status::ok);
  CHECK(same_bits(again, found));
}

TEST_CASE("recognizer: the same bits on every machine") {
  Random random(12);
  View scene = moved(cup, random_motion(random), 0.3f);
  scene.append(moved(red_mug, random_motion(random), 0.3f));
  const std::vector<ss::Hypothesis> found = recognized(trained({0.05f, 3, 30}), scene);
  std::uint64_t hash = 0;
  const auto add = [&hash](std::uint32_t bits) { hash = (hash ^ bits) * 0x100000001B3u; };
  for (const ss::Hypothesis& hypothesis : found) {
    add(hypothesis.object_class);
    add(hypothesis.instance);
    for (std::size_t k = 0; k < 3; ++k) add(ss::extend::math::bits_of(ss::extend::coordinate(hypothesis.center, k)));
    add(ss::extend::math::bits_of(hypothesis.score));
  }
  CHECK(found.size() == 9);
  CHECK(hash == 0x2FF74FAE63AEE498u);
}

TEST_CASE("recognizer: with what extract() gives") {
  const TestCloud cloud = curved_surface(4, 3000);
  const ss::GridSearch grid(cloud.view(), 0.04f);
  std::vector<ss::KeyPoint> keypoints;
  for (std::size_t i = 0; i < cloud.size(); i += 60) keypoints.push_back(ss::keypoint(cloud.view(), i));
  ss::Features<ss::Scsh336> features;
  REQUIRE(ss::extract(cloud.view(), grid, keypoints, 0.04f, features) == Status::ok);
  ss::Recognizer recognizer;
  std::vector<ss::Hypothesis> found;
  ss::ActivationShares shares;
  REQUIRE(ss::train(recognizer, features, {0.0f, 0.0f, 0.9f}, "surface", "curved") == Status::ok);
  CHECK(recognizer.layout() == ss::layout_of<ss::Scsh336>());
  REQUIRE(ss::recognize(recognizer, features, found) == Status::ok);
  REQUIRE(found.size() == 1);
  CHECK(distance(found[0].center, {0.0f, 0.0f, 0.9f}) < 1e-5f);
  REQUIRE(ss::activation_shares(recognizer, features, shares) == Status::ok);
  CHECK(same_bits(shares.classes, {1.0f}));

  features.keypoints.pop_back();
  CHECK(ss::recognize(recognizer, features, found) == Status::bad_rows);
  ss::Features<ss::Scsh<ss::SphericalGrid<3, 4, 8>, ss::SphericalGrid<2, 2, 4>, 15, ss::HardVoting>> others;
  CHECK(ss::recognize(recognizer, others, found) == Status::other_descriptor);  // as many values
}

}  // namespace test_recognizer
