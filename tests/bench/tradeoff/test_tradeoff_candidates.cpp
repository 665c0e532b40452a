// The candidates of the map: names, formats, and what is done to the clouds that they describe.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "tools/io/view_of_cloud.hpp"
#include "tools/scene/tabletop.hpp"
#include "tradeoff/candidate.hpp"
#include "tradeoff/cost.hpp"
#include "tradeoff/paint.hpp"
#include "tradeoff/pairs.hpp"

namespace test_tradeoff_candidates {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::tradeoff;

TEST_CASE("every entry has a name of its own, and the baselines are there") {
  for (const bool quick : {false, true}) {
    std::set<std::string> names;
    std::size_t entries = 0;
    for (const Candidate& c : candidates(quick)) {
      CHECK(c.storages.front().name == "float");
      for (const Storage& s : c.storages) {
        names.insert(entry_name(c, s));
        ++entries;
      }
    }
    CHECK(names.size() == entries);
    for (const char* baseline : {color_baseline, shape_baseline, plain_baseline}) CHECK(names.count(baseline) == 1);
    if (!quick) CHECK(names.count("h2x4x8-m2x4-c2x4-4bit") == 1);
  }
}

double squared(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2);
  return sum;
}

TEST_CASE("squared distances of codes are the format's own, in its steps or bits") {
  std::mt19937 random(1);
  const auto values = [&] {
    std::vector<float> v(shortshot::ShapeColor95::size);
    for (float& x : v) x = static_cast<float>(random() % 1000) / 2500.0f;
    return v;
  };
  using Nibbles = shortshot::NibbleDescriptor<shortshot::ShapeColor95>;
  using Bits = shortshot::BinaryDescriptor<shortshot::ShapeColor95>;
  const Storage nibbles = packed_storage<Nibbles>("4bit", 190);
  const Storage bits = packed_storage<Bits>("bshot", 190);
  CHECK(nibbles.size_bytes == 95);
  CHECK(bits.size_bytes == 24);
  using Sums = shortshot::SumBits<shortshot::ShapeColor95>;
  const Storage sums = packed_storage<Sums>("sums44", 352);
  CHECK(sums.size_bytes == 44);
  for (int round = 0; round < 20; ++round) {
    const std::vector<float> a = values();
    const std::vector<float> b = values();
    const auto code = [](const Storage& storage, const std::vector<float>& v) {
      std::vector<unsigned char> bytes(storage.size_bytes);
      std::vector<float> codes(storage.code_size);
      storage.pack(v.data(), bytes.data());
      storage.unpack(bytes.data(), codes.data());
      return codes;
    };
    Nibbles of_a, of_b;
    shortshot::quantize(a.data(), of_a);
    shortshot::quantize(b.data(), of_b);
    CHECK(squared(code(nibbles, a), code(nibbles, b)) == shortshot::squared_distance(of_a, of_b));
    Bits bits_of_a, bits_of_b;
    shortshot::binarize(a.data(), bits_of_a);
    shortshot::binarize(b.data(), bits_of_b);
    CHECK(squared(code(bits, a), code(bits, b)) == shortshot::hamming_distance(bits_of_a, bits_of_b));
    Sums sums_of_a, sums_of_b;
    shortshot::binarize(of_a, sums_of_a);
    shortshot::binarize(of_b, sums_of_b);
    CHECK(squared(code(sums, a), code(sums, b)) == shortshot::hamming_distance(sums_of_a, sums_of_b));
  }
}

RgbdCloud small_scene() {
  TabletopOptions options;
  options.width = 160;
  options.height = 120;
  return make_tabletop(options);
}

TEST_CASE("a painted cloud has one hue, brighter towards the lamp") {
  const RgbdCloud scene = small_scene();
  const RgbdCloud red = painted(scene, {{200.0, 0.0, 0.0}, {0.0f, 0.0f, 0.0f}, 1});
  CHECK(red.xyz.size() == scene.xyz.size());
  double mean[3] = {};
  for (std::size_t i = 0; i < red.rgb.size(); ++i) mean[i % 3] += static_cast<double>(red.rgb[i]);
  for (double& m : mean) m /= static_cast<double>(red.size());
  CHECK(mean[0] > 0.3 * 200.0);
  CHECK(mean[0] < 200.0);
  CHECK(mean[1] < 4.0);  // half of the noise is cut off at 0
  const RgbdCloud from_behind = painted(scene, {{200.0, 0.0, 0.0}, {0.0f, 0.0f, 100.0f}, 1});
  double dark = 0.0;
  for (std::size_t i = 0; i < from_behind.size(); ++i) dark += static_cast<double>(from_behind.rgb[3 * i]);
  CHECK(dark / static_cast<double>(red.size()) < 0.6 * mean[0]);
}

TEST_CASE("another gain changes colors and nothing else, and a seed says how") {
  const RgbdCloud scene = small_scene();
  const RgbdCloud one = amplified(scene, 1);
  CHECK(one.rgb != scene.rgb);
  CHECK(one.rgb == amplified(scene, 1).rgb);
  CHECK(one.rgb != amplified(scene, 2).rgb);
  CHECK(std::equal(one.xyz.begin(), one.xyz.end(), scene.xyz.begin(),
                   [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }));
}

TEST_CASE("a cloud matches itself; shifted truth finds nothing") {
  datasets::ViewPair pair;
  pair.name = "itself";
  pair.source = pair.target = small_scene();
  pair.truth = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  PairLook look;
  look.view.leaf = 0.05f;
  look.view.radius = 0.1f;
  look.view.normal_radius = 0.03f;
  look.view.points_of_cloud = true;
  const std::vector<Candidate> some = candidates(true);
  const std::vector<Item> items = match_pair(pair, "group", look, "views", some);
  REQUIRE(items.size() == 1);
  for (const auto& [entry, count] : items.front().counts) {
    CAPTURE(entry);
    CHECK(count.denominator > 50.0);
    CHECK(count.numerator >= 0.75 * count.denominator);  // some rows are not ok, some have the same bits
  }
  pair.truth[3] = 0.05;  // meters
  const std::vector<Item> shifted = match_pair(pair, "group", look, "views", some);
  for (const auto& [entry, count] : shifted.front().counts) {
    CAPTURE(entry);
    CHECK(count.numerator <= 0.3 * count.denominator);
  }
}

TEST_CASE("many pairs of few clouds: as pair by pair, with a reciprocal match in the place of a nearest one, too") {
  const RgbdCloud scene = small_scene();
  const RgbdCloud other = amplified(scene, 3);
  const datasets::RigidMotion at_rest{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  datasets::PairSet set;
  set.pair_names = {"unused", "itself", "other"};
  set.groups = {"", "a", "a"};
  set.sources = {1, 0, 0};
  set.targets = {0, 0, 1};
  set.truths = {at_rest, at_rest, at_rest};
  PairLook look;
  look.view.leaf = 0.1f;
  look.view.radius = 0.06f;
  look.view.normal_radius = 0.02f;
  look.view.points_of_cloud = true;
  const paper::Views views(
      2, [&](std::size_t i) { return i == 0 ? scene : other; }, look.view);
  for (const bool reciprocal : {false, true}) {
    look.reciprocal = reciprocal;
    for (const Candidate& candidate : candidates(true)) {
      const std::vector<Item> items = match_pairs(set, {1, 2}, views, look, "m", candidate);
      REQUIRE(items.size() == 2);
      const datasets::ViewPair pairs[] = {{"itself", scene, scene, at_rest}, {"other", scene, other, at_rest}};
      for (std::size_t i = 0; i < 2; ++i) {
        const Item alone = match_pair(pairs[i], "a", look, "m", {candidate}).front();
        CHECK(items[i].name == alone.name);
        for (const auto& [entry, count] : alone.counts) {
          CAPTURE(entry);
          CHECK(items[i].counts.at(entry).numerator == count.numerator);
          CHECK(items[i].counts.at(entry).denominator == count.denominator);
          CHECK((count.denominator == 1.0) == reciprocal);
        }
      }
    }
  }
}

}  // namespace

}  // namespace test_tradeoff_candidates
