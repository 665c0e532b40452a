// Key-point matching as the paper measures it: figures of a known motion, and that a wrong one does not pass.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "paper/figures.hpp"
#include "paper/matching.hpp"
#include "paper/matching_experiment.hpp"
#include "relief.hpp"

namespace test_paper_matching {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::paper;
using paper_test::turned;

datasets::ViewPair pair_turned(double angle, const datasets::RigidMotion& claimed) {
  datasets::ViewPair pair;
  pair.source = paper_test::view_of({}, turned(0.0), 1);
  pair.target = paper_test::view_of({}, turned(angle, 0.1), 2);
  pair.truth = claimed;
  return pair;
}

std::vector<Matching> matched(const datasets::ViewPair& pair, const std::vector<std::string>& names) {
  return match_pair(pair, matching_settings("object-scene"), configurations_named(names));
}

double precision(const Matching& m) { return static_cast<double>(m.correct) / static_cast<double>(m.reciprocal); }

/// One pair's result as a whole experiment's.
Findings report_on(const std::vector<Matching>& matchings, const std::string& directory) {
  const nlohmann::ordered_json parameters = {
      {"experiment", "matching"},
      {"quick", true},
      {"descriptors", to_json(configurations_named({"cshot1344", "scsh336"}))},
      {"sets",
       {{{"name", "reliefs"}, {"kind", "views"}, {"pairs", {{{"key", "a"}, {"group", "a"}, {"rotation_deg", 20.0}}}}}}},
      {"units", {"a"}}};
  return matching_report(parameters, {{"a", to_json(matchings)}}, directory);
}

}  // namespace

TEST_CASE("matching: equation 9 is the norm of the difference of the matrices") {
  const datasets::RigidMotion one = turned(0.0);
  datasets::RigidMotion other = one;
  other[3] += 3.0;
  other[7] -= 4.0;
  CHECK(t_diff(one, one) == 0.0);
  CHECK(t_diff(one, other) == doctest::Approx(5.0));
}

TEST_CASE("matching: a known motion is found, by every descriptor") {
  const datasets::ViewPair pair = pair_turned(0.4, turned(0.4, 0.1));
  const std::vector<std::string> names{"cshot1344", "shot352", "scsh336", "scsh696", "ssh96", "ssh32"};
  const std::vector<Matching> matchings = matched(pair, names);
  REQUIRE(matchings.size() == names.size());
  for (const Matching& m : matchings) {
    CAPTURE(m.descriptor);
    CHECK(m.keypoints > 150);
    CHECK(m.matchable > m.keypoints / 2);
    CHECK(m.correct_nearest <= m.matchable);
    CHECK(m.correct <= m.reciprocal);
    CHECK(precision(m) > 0.3);
    REQUIRE(m.trials.size() == 3);
    for (const Trial& trial : m.trials) {
      CHECK(trial.found);
      CHECK(trial.rotation_deg < 5.0);
      CHECK(trial.translation_m < 0.02);
      CHECK(trial.t_diff < 0.1);
      CHECK(trial.inliers <= m.reciprocal);
    }
  }
}

TEST_CASE("matching: against a wrong motion nothing is correct, and the bands say so") {
  const std::vector<std::string> names{"cshot1344", "scsh336"};
  const std::vector<Matching> right = matched(pair_turned(0.4, turned(0.4, 0.1)), names);
  const std::vector<Matching> wrong = matched(pair_turned(0.4, turned(0.4, 0.13)), names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    CHECK(precision(wrong[i]) < 0.1);
    CHECK(wrong[i].trials[0].translation_m > 0.02);
  }
  const nlohmann::ordered_json bands = {
      {{"data", "reliefs"}, {"descriptor", "scsh336"}, {"figure", "precision"}, {"at_least", 0.3}, {"at_most", 1.0}},
      {{"data", "reliefs"}, {"descriptor", "cshot1344"}, {"figure", "success"}, {"at_least", 0.9}, {"at_most", 1.0}}};
  const std::string directory = std::string(SHORTSHOT_TEST_OUTPUT);
  CHECK(broken_bands(report_on(right, directory).figures, bands).empty());
  CHECK(broken_bands(report_on(wrong, directory).figures, bands).size() == 2);
}

TEST_CASE("matching: without colors those that need none are compared") {
  datasets::ViewPair pair = pair_turned(0.2, turned(0.2, 0.1));
  pair.target.rgb.clear();
  const std::vector<Matching> matchings = matched(pair, {"cshot1344", "ssh96"});
  REQUIRE(matchings.size() == 1);
  CHECK(matchings[0].descriptor == "ssh96");
}

TEST_CASE("matching: results come back from their JSON") {
  const std::vector<Matching> matchings = matched(pair_turned(0.2, turned(0.2, 0.1)), {"ssh32"});
  const std::vector<Matching> again = matchings_of(nlohmann::ordered_json::parse(to_json(matchings).dump()));
  REQUIRE(again.size() == 1);
  CHECK(to_json(again) == to_json(matchings));
  CHECK(again[0].trials[2].t_diff == matchings[0].trials[2].t_diff);
}

TEST_CASE("matching: descriptors that do not exist are named") {
  CHECK_THROWS_WITH(static_cast<void>(configurations_named({"scsh336", "x"})),
                    "no descriptor \"x\"; there are cshot1344, shot352, scsh336, scsh696, ssh96, ssh32, shapecolor95, "
                    "shapecolor32, roomcolor95, heightshape96, colorrings27");
}

}  // namespace test_paper_matching
