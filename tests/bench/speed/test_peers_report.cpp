// What the peers are compared by: the task, the ratios, the goals, and their JSON.

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "speed/peers/comparisons.hpp"
#include "speed/peers/goals.hpp"
#include "speed/peers/options.hpp"
#include "speed/peers/task.hpp"
#include "tools/scene/tabletop.hpp"

namespace test_peers_report {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::peers;

/// The exit code of a command line, or -1 if the program would go on.
int exit_code_of(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "peers");
  Options options;
  int exit_code = -2;
  return parse_options(static_cast<int>(arguments.size()), arguments.data(), options, exit_code) ? -1 : exit_code;
}

MeasuredContender measured(const Contender& what, double us_per_keypoint, double frame_ms, std::size_t peak_bytes) {
  return {what, us_per_keypoint, frame_ms, peak_bytes, 2, 3};
}

/// Ours takes 10 us and 20 ms.
CloudResult result_of(const std::string& cloud, double peer_us) {
  CloudResult result{cloud, 340'000, 1000, 0.04, 800.0};
  result.contenders.push_back(measured({"shortshot", "SCSH-336", "O2", "grid"}, 10.0, 20.0, 8'000'000));
  Contender peer{"PCL SHOTColor", "CSHOT-1344", {}, "FLANN"};
  peer.against = {"SCSH-336"};
  result.contenders.push_back(measured(peer, peer_us, 1000.0, 30'000'000));
  Contender other{"PCL SHOT", "SHOT-352", {}, "FLANN"};
  other.against = {"SSH-32", "SHOT-352"};
  result.contenders.push_back(measured(other, 300.0, 900.0, 30'000'000));
  result.contenders.push_back(measured({"shortshot", "SHOT-352", "O2", "grid"}, 12.5, 40.0, 9'000'000));
  result.steps = {{"naive: tree", {30.0, 1, 1}},
                  {"O2: grid", {2.0, 1, 1}},
                  {"O2: normals of the image", {10.0, 1, 1}},
                  {"PCL: normals of the image", {70.0, 1, 1}},
                  {"PCL: normals", {50.0, 1, 1}},
                  {"PCL: unsorted tree", {5.0, 1, 1}}};
  result.oracle_difference = {{"O2", 2e-6}};
  return result;
}

const Goal& goal_named(const std::string& part) {
  for (const Goal& goal : goals()) {
    if (goal.name.find(part) != std::string::npos) return goal;
  }
  throw std::runtime_error("no goal " + part);
}

}  // namespace

TEST_CASE("peers: command lines: good ones go on, help ends well, bad ones end with 2") {
  CHECK(exit_code_of({}) == -1);
  CHECK(exit_code_of({"a.pcd", "b.ply", "--radius", "0.1", "--leaf", "0.01", "--rounds", "2", "--no-fpfh"}) == -1);
  CHECK(exit_code_of({"--json", "a.json", "--goals", "b.json"}) == -1);
  CHECK(exit_code_of({"--help"}) == 0);
  CHECK(exit_code_of({"--rounds", "0"}) == 2);
  CHECK(exit_code_of({"--radius", "4cm"}) == 2);
  CHECK(exit_code_of({"--unknown"}) == 2);
}

TEST_CASE("peers: the task is the cloud's measured points and the same key points every time") {
  TabletopOptions options;
  options.width = 160;
  options.height = 120;
  const RgbdCloud cloud = make_tabletop(options);
  const Task task = make_task("a.pcd", cloud, 0.05f, 0.02f);
  CHECK(task.cloud == "a.pcd");
  CHECK(task.points.size() < cloud.size());
  CHECK(task.points.rgb.size() == task.points.xyz.size());
  for (const float value : task.points.xyz) REQUIRE(std::isfinite(value));
  CHECK(task.keypoints.size() == max_keypoints);
  CHECK(std::set<std::uint32_t>(task.keypoints.begin(), task.keypoints.end()).size() == max_keypoints);
  CHECK(task.mean_neighbors > 1.0);
  CHECK(task.keypoints == make_task("b.pcd", cloud, 0.05f, 0.02f).keypoints);
  CHECK(make_task("a.pcd", cloud, 0.05f, 0.5f).keypoints.size() < max_keypoints);

  CHECK_THROWS_AS(make_task("a.pcd", cloud, 0.0f, 0.02f), std::runtime_error);
  CHECK_THROWS_AS(make_task("a.pcd", cloud, std::numeric_limits<float>::quiet_NaN(), 0.02f), std::runtime_error);
  CHECK_THROWS_AS(make_task("a.pcd", cloud, 0.05f, -1.0f), std::runtime_error);
  RgbdCloud gray = cloud;
  gray.rgb.clear();
  CHECK_THROWS_AS(make_task("a.pcd", gray, 0.05f, 0.02f), std::runtime_error);
  CHECK_THROWS_AS(make_task("a.pcd", RgbdCloud{}, 0.05f, 0.02f), std::runtime_error);
}

TEST_CASE("peers: a comparison is with the peers of the same descriptor, and JSON has its keys") {
  const CloudResult result = result_of("a.pcd", 260.0);
  const std::vector<Comparison> comparisons = compare(result);
  REQUIRE(comparisons.size() == 2);
  CHECK(comparisons[0].ratio_per_keypoint == doctest::Approx(26.0));
  CHECK(comparisons[0].ratio_frame == doctest::Approx(50.0));
  CHECK(comparisons[1].ratio_per_keypoint == doctest::Approx(24.0));

  const auto json = to_json(result);
  REQUIRE(json.size() == 2);
  CHECK(json[0]["cloud"] == "a.pcd");
  CHECK(json[0]["descriptor"] == "SCSH-336");
  CHECK(json[0]["peer"] == "PCL SHOTColor");
  CHECK(json[0]["build"] == "O2");
  CHECK(json[0]["search"] == "grid");
  CHECK(json[0]["us_per_keypoint"].get<double>() == doctest::Approx(10.0));
  CHECK(json[0]["peer_us_per_keypoint"].get<double>() == doctest::Approx(260.0));
  CHECK(json[0]["ratio_per_keypoint"].get<double>() == doctest::Approx(26.0));
  CHECK(json[0]["ratio_frame"].get<double>() == doctest::Approx(50.0));
  CHECK(json[0]["samples"] == 2);
}

TEST_CASE("peers: a goal is judged by its worst cloud, and one that was not measured is not judged") {
  const std::vector<CloudResult> good{result_of("a.pcd", 260.0), result_of("b.pcd", 251.0)};
  const std::vector<CloudResult> mixed{result_of("a.pcd", 260.0), result_of("b.pcd", 249.0)};
  REQUIRE(goals().size() == 15);
  const Goal& ratio = goals()[0];
  REQUIRE(worst_of(ratio, 0, good));
  CHECK(worst_of(ratio, 0, good)->met);
  CHECK(worst_of(ratio, 0, good)->cloud == "b.pcd");
  CHECK(worst_of(ratio, 0, good)->value == doctest::Approx(25.1));
  CHECK_FALSE(worst_of(ratio, 0, mixed)->met);
  CHECK_FALSE(worst_of(ratio, 1, good));

  CHECK(worst_of(goal_named("index build"), 0, good)->value == doctest::Approx(15.0));
  CHECK(worst_of(goal_named("index build"), 0, good)->met);
  CHECK(worst_of(goal_named("extra memory"), 0, good)->value == doctest::Approx(4.0));
  CHECK(worst_of(goal_named("extra memory"), 0, good)->met);
  CHECK_FALSE(worst_of(goal_named("oracle"), 0, good)->met);
  CHECK_FALSE(worst_of(goal_named("2 threads"), 0, good));
  CHECK(worst_of(goal_named("SHOT-352 per key point, PCL / ours"), 0, good)->value == doctest::Approx(24.0));
  CHECK_FALSE(worst_of(goal_named("CSHOT-1344"), 0, good));
  CHECK(worst_of(goal_named("normals of an image"), 0, good)->value == doctest::Approx(7.0));
  CHECK_FALSE(worst_of(goal_named("normals of an image"), 0, good)->met);
  CHECK(worst_of(goal_named("k = 10"), 0, good)->value == doctest::Approx(5.5));

  const auto json = goals_to_json(mixed);
  REQUIRE(json.size() == 30);
  CHECK(json[0]["met"] == false);
  CHECK(json[0]["worst_cloud"] == "b.pcd");
  CHECK(json[0]["measured"]["a.pcd"].get<double>() == doctest::Approx(26.0));
  CHECK_FALSE(json[1].contains("met"));
}

}  // namespace test_peers_report
