// Registration: figures of a known motion, forms of rows, precision-recall curves, and other programs' descriptors.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "paper/campaign/statistics.hpp"
#include "paper/registration.hpp"
#include "paper/registration_experiment.hpp"
#include "paper/registration_set.hpp"
#include "paper/storage.hpp"
#include "relief.hpp"

namespace test_paper_registration {
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

std::vector<Registration> registered(const datasets::ViewPair& pair, const std::vector<Contender>& contenders) {
  return register_pair(pair, matching_settings("object-scene"), contenders);
}

/// Rows of one number each.
Described rows_of(const std::vector<float>& values) {
  Described rows;
  rows.values = values;
  rows.status.assign(values.size(), shortshot::Status::ok);
  rows.frames.resize(values.size());
  rows.keypoints.resize(values.size());
  rows.size = 1;
  return rows;
}

/// A program for --peer: a shell script.
std::string script(const std::string& name, const std::string& commands) {
  const std::string path = std::string(SHORTSHOT_TEST_OUTPUT) + "/" + name;
  std::ofstream(path) << "#!/bin/sh\n" << commands << '\n';
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

}  // namespace

TEST_CASE("registration: a known motion is found, in every form of the rows") {
  const std::vector<std::string> names{"shot352", "shot352-root", "shot352-bshot", "shapecolor95-4bit",
                                       "shapecolor95-sums32"};
  const auto right = registered(pair_turned(0.4, turned(0.4, 0.1)), contenders_named(names));
  const auto wrong = registered(pair_turned(0.4, turned(0.4, 0.13)), contenders_named(names));
  REQUIRE(right.size() == names.size());
  const std::size_t bytes[] = {1408, 1408, 44, 95, 32};
  for (std::size_t i = 0; i < names.size(); ++i) {
    CAPTURE(names[i]);
    CHECK(right[i].descriptor == names[i]);
    CHECK(right[i].size_bytes == bytes[i]);
    CHECK(right[i].microseconds > 0.0);
    CHECK(right[i].inlier_ratio() > 0.3);
    CHECK(right[i].within(5.0, 0.02) == 1.0);
    CHECK(right[i].curve.area() > wrong[i].curve.area());
    CHECK(wrong[i].inlier_ratio() < 0.1);
    CHECK(wrong[i].within(5.0, 0.02) == 0.0);
    CHECK(wrong[i].within(5.0, 0.1) == 1.0);
  }
  CHECK(right[0].curve.right != right[1].curve.right);
}

TEST_CASE("registration: square roots are of each value's share, signs kept") {
  Described rows = rows_of({1.0f, -3.0f, 0.0f, 0.0f});
  rows.status.resize(2);
  rows.size = 2;
  CHECK(rooted(rows).values == std::vector<float>{0.5f, -std::sqrt(0.75f), 0.0f, 0.0f});
}

TEST_CASE("registration: precision and recall follow the ratio, and the area under them is the integral") {
  RatioCurve curve;
  curve.matchable = 10;
  for (std::size_t step = 10; step < ratio_steps; ++step) {
    curve.accepted[step] = step < 30 ? 2 : 8;
    curve.right[step] = step < 30 ? 2 : 4;
  }
  CHECK(std::isnan(curve.precision(0)));
  CHECK(curve.precision(10) == 1.0);
  CHECK(curve.recall(49) == doctest::Approx(0.4));
  CHECK(curve.area() == doctest::Approx(0.2 * 1.0 + 0.2 * 0.75));  // to recall .2 at 1, then down to 1/2
  RatioCurve twice = curve;
  twice += curve;
  CHECK(twice.accepted[49] == 16);
  CHECK(twice.area() == doctest::Approx(curve.area()));
  CHECK(RatioCurve{}.area() == 0.0);
  CHECK(ratio_curve_of(nlohmann::ordered_json::parse(to_json(curve).dump())).right == curve.right);
}

TEST_CASE(
    "registration: a nearest neighbor is accepted below its ratio, one as near as the second at the last step only") {
  View source(paper_test::view_of({}, turned(0.0), 1), ViewSettings{});
  const std::size_t count = source.keypoints().size();
  const Truth truth(turned(0.0), source, source, 1e-6f);
  std::vector<float> targets(count, 100.0f);
  targets[0] = 0.0f;
  targets[1] = 1.0f;
  std::vector<float> queries(count, 100.0f);  // all but two are as near to many
  queries[0] = 0.25f;                         // at .25, and .75 from the second: a third
  queries[1] = 0.5f;
  const RatioCurve curve = ratio_curve(rows_of(queries), rows_of(targets), truth);
  CHECK(curve.matchable == count);
  CHECK(curve.accepted[15] == 0);  // .32
  CHECK(curve.accepted[16] == 1);  // .34
  CHECK(curve.right[16] == 1);
  CHECK(curve.accepted[48] == 1);
  CHECK(curve.accepted[49] == count);
}

TEST_CASE("registration: pairs of one source are drawn together, and forms that a set has not are left out") {
  Registration good, bad;
  good.descriptor = bad.descriptor = "ssh32";
  good.reciprocal = bad.reciprocal = 10;
  good.correct = 10;
  const auto pair = [](const char* key, const char* group) {
    return nlohmann::ordered_json{{"key", key}, {"group", group}, {"rotation_deg", 1.0}};
  };
  const auto sets = [&](const char* group) {
    const nlohmann::ordered_json parameters = {
        {"descriptors", {{{"name", "cshot1344"}, {"method", "cshot1344"}}, {{"name", "ssh32"}, {"method", "ssh32"}}}},
        {"sets", {{{"name", "s"}, {"pairs", {pair("a", "g"), pair("b", group)}}}}}};
    return registration_sets(parameters, {{"a", to_json({good})}, {"b", to_json({bad})}});
  };
  const auto apart = sets("h"), together = sets("g");
  REQUIRE(apart.front().forms.size() == 1);
  const auto interval = [](const std::vector<RegistrationSet>& of) {
    return mean_of(of.front(), of.front().forms.front(), pair_figures::inlier_ratio);
  };
  CHECK(interval(apart).value == 0.5);
  CHECK(interval(apart).low == 0.0);
  CHECK(interval(together).low == 0.5);
}

TEST_CASE("registration: another program's rows are compared, and wrong answers are named") {
  const datasets::ViewPair pair = pair_turned(0.0, turned(0.0, 0.1));
  // A row for each key point: its first coordinate, from behind the points.
  const std::string program = script("peer.sh",
                                     "read points keypoints rest <\"$1\"\n"
                                     "{ echo \"$keypoints 3 7\"; tail -c $((keypoints * 12)) \"$1\"; } >\"$2\"");
  const auto registrations = registered(pair, {peer_contender("places=" + program)});
  REQUIRE(registrations.size() == 2);
  CHECK(registrations[0].descriptor == "places");
  CHECK(registrations[1].descriptor == "places-root");
  CHECK(registrations[0].size_bytes == 12);
  CHECK(registrations[0].reciprocal > 0);
  for (const char* commands : {"exit 1", "echo '1 3 7' >\"$2\"", ":"}) {
    CHECK_THROWS_AS(registered(pair, {peer_contender("x=" + script("wrong.sh", commands))}), std::runtime_error);
  }
  for (const char* peer : {"program", "=program", "name="}) {
    CHECK_THROWS_WITH(static_cast<void>(peer_contender(peer)), doctest::Contains("is not NAME=PROGRAM"));
  }
}

TEST_CASE("registration: forms that do not exist are named") {
  for (const char* name : {"shot353", "shot352-sums32", "shot352-", "-root", ""}) {
    CHECK_THROWS_WITH(static_cast<void>(contenders_named({name})),
                      doctest::Contains("; there are cshot1344, cshot1344-root"));
  }
  for (const bool quick : {false, true}) CHECK(contenders_named(registration_names(quick)).size() > 4);
}

TEST_CASE("a bootstrap of any statistic is that of the mean where it is the mean") {
  const std::vector<double> values{1.0, 2.0, 4.0, 9.0};
  const auto mean = [&](const std::vector<std::size_t>& drawn) -> std::optional<double> {
    double sum = 0.0;
    for (const std::size_t i : drawn) sum += values[i];
    return sum / static_cast<double>(drawn.size());
  };
  const campaign::Interval a = campaign::bootstrap_of(4, mean, 1);
  const campaign::Interval b = campaign::bootstrap(campaign::each_its_own_group(values), campaign::Statistic::mean, 1);
  CHECK(a.value == doctest::Approx(b.value));
  CHECK(a.low == doctest::Approx(b.low));
  CHECK(a.high == doctest::Approx(b.high));
}

}  // namespace test_paper_registration
