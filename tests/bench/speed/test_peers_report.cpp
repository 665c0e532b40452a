// What the peers are compared by: the task, the ratios, the goals, and their JSON.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "speed/peers/comparisons.hpp"
#include "speed/peers/goals.hpp"
#include "speed/peers/instruction_goals.hpp"
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
CloudResult result_of(const std::string& cloud, double peer_frame_ms) {
  CloudResult result{cloud, 340'000, 1000, 0.04, 0.01, 800.0};
  result.contenders.push_back(measured({"shortshot", "SCSH-336", "O2", "nanoflann"}, 70.0, 90.0, 9'000'000));
  result.contenders.push_back(measured({"shortshot", "SCSH-336", "O2", "grid"}, 10.0, 20.0, 8'000'000));
  Contender peer{"PCL SHOTColor", "CSHOT-1344", {}, "FLANN"};
  peer.against = {"SCSH-336"};
  result.contenders.push_back(measured(peer, 260.0, 1000.0, 30'000'000));
  Contender other{"PCL SHOT", "SHOT-352", {}, "FLANN"};
  other.against = {"SSH-32", "SHOT-352"};
  result.contenders.push_back(measured(other, 300.0, peer_frame_ms, 30'000'000));
  other.implementation += with_fast_normals;
  other.against.push_back(std::string("SHOT-352") + with_fast_normals);
  result.contenders.push_back(measured(other, 300.0, 220.0, 50'000'000));
  result.contenders.push_back(measured({"shortshot", "SHOT-352", "O2", "grid"}, 12.5, 40.0, 9'000'000));
  Contender voxels{"PCL VoxelGrid", key_points_made, {}, "voxels"};
  voxels.against = {key_points_made};
  voxels.made = 9000;
  result.contenders.push_back(measured(voxels, 0.4, 6.0, 3'000'000));
  result.contenders.push_back(measured({"shortshot", key_points_made, "O2", "voxels"}, 0.2, 3.0, 600'000));
  result.steps = {{"naive: tree", {30.0, 1, 1}},
                  {"O2: grid", {2.0, 1, 1}},
                  {"O2: SCSH-336, grid: extract", {20.0, 1, 1}},
                  {"avx2: SCSH-336, grid: extract", {13.0, 1, 1}}};
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
  CHECK(task.sampled.size() > max_keypoints);
  CHECK(task.keypoints.size() == max_keypoints);
  CHECK(std::includes(task.sampled.begin(), task.sampled.end(), task.keypoints.begin(), task.keypoints.end()));
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
  const CloudResult result = result_of("a.pcd", 900.0);
  const std::vector<Comparison> comparisons = compare(result);
  REQUIRE(comparisons.size() == 5);
  CHECK(comparisons[0].ours->what.search == "nanoflann");
  CHECK(comparisons[1].ratio_per_keypoint == doctest::Approx(26.0));
  CHECK(comparisons[1].ratio_frame == doctest::Approx(50.0));
  CHECK(comparisons[2].ratio_per_keypoint == doctest::Approx(24.0));
  CHECK(comparisons[3].peer->what.implementation == "PCL SHOT, fast normals");
  CHECK(comparisons[3].ratio_frame == doctest::Approx(5.5));
  CHECK(comparisons[4].ratio_frame == doctest::Approx(2.0));

  const auto json = to_json(result);
  REQUIRE(json.size() == 5);
  CHECK(json[1]["cloud"] == "a.pcd");
  CHECK(json[1]["leaf"].get<double>() == doctest::Approx(0.01));
  CHECK(json[1]["descriptor"] == "SCSH-336");
  CHECK(json[1]["peer"] == "PCL SHOTColor");
  CHECK(json[1]["build"] == "O2");
  CHECK(json[1]["search"] == "grid");
  CHECK(json[1]["us_per_keypoint"].get<double>() == doctest::Approx(10.0));
  CHECK(json[1]["peer_us_per_keypoint"].get<double>() == doctest::Approx(260.0));
  CHECK(json[1]["ratio_per_keypoint"].get<double>() == doctest::Approx(26.0));
  CHECK(json[1]["ratio_frame"].get<double>() == doctest::Approx(50.0));
  CHECK(json[1]["samples"] == 2);
  CHECK(json[1]["peer_made"] == 1000);
  CHECK(json[4]["peer_made"] == 9000);
}

TEST_CASE("peers: a goal is judged by its worst cloud, and one that was not measured is not judged") {
  const std::vector<CloudResult> good{result_of("a.pcd", 400.0), result_of("b.pcd", 320.0)};
  const std::vector<CloudResult> mixed{result_of("a.pcd", 400.0), result_of("b.pcd", 319.0)};
  const Goal& exact = goal_named("SHOT-352, whole frame, PCL / ours, exact normals");
  REQUIRE(worst_of(exact, 0, good));
  CHECK(worst_of(exact, 0, good)->met);
  CHECK(worst_of(exact, 0, good)->cloud == "b.pcd");
  CHECK(worst_of(exact, 0, good)->value == doctest::Approx(8.0));
  CHECK_FALSE(worst_of(exact, 0, mixed)->met);
  CHECK_FALSE(worst_of(exact, 1, good));

  CHECK(worst_of(goal_named("index build"), 0, good)->value == doctest::Approx(15.0));
  CHECK(worst_of(goal_named("extra memory"), 0, good)->value == doctest::Approx(4.0));
  CHECK(worst_of(goal_named("extra memory"), 0, good)->met);
  CHECK_FALSE(worst_of(goal_named("oracle"), 0, good)->met);
  CHECK_FALSE(worst_of(goal_named("2 threads"), 0, good));
  CHECK(worst_of(goal_named("SHOT-352 per key point, PCL / ours"), 0, good)->value == doctest::Approx(24.0));
  CHECK_FALSE(worst_of(goal_named("CSHOT-1344 per key point"), 0, good));
  CHECK(worst_of(goal_named("PCL VoxelGrid / ours"), 0, good)->value == doctest::Approx(2.0));
  CHECK(worst_of(goal_named("SCSH-336, whole frame, PCL SHOTColor"), 0, good)->value == doctest::Approx(50.0));
  CHECK_FALSE(worst_of(goal_named("Open3D FPFH"), 0, good));

  const auto json = goals_to_json(mixed);
  for (const auto& entry : json) {
    if (entry["goal"] != exact.name) continue;
    CHECK(entry["bound"] == ">= 8");
    if (entry["build"] == "avx2") {
      CHECK_FALSE(entry.contains("met"));
      continue;
    }
    CHECK(entry["met"] == false);
    CHECK(entry["worst_cloud"] == "b.pcd");
    CHECK(entry["measured"]["a.pcd"].get<double>() == doctest::Approx(10.0));
  }
}

TEST_CASE("peers: the baseline binary is held against the same with AVX2, and only it") {
  const Goal& goal = goal_named("time with -mavx2 / of the baseline binary");
  const std::vector<CloudResult> results{result_of("a.pcd", 400.0)};
  CHECK(worst_of(goal, 0, results)->value == doctest::Approx(0.65));
  CHECK_FALSE(worst_of(goal, 0, results)->met);
  CHECK(applies(goal, 0));
  CHECK_FALSE(applies(goal, 1));
  std::size_t rows = 0;
  for (const auto& entry : goals_to_json(results)) rows += entry["goal"] == goal.name ? 1 : 0;
  CHECK(rows == 1);
}

TEST_CASE("peers: fast normals of PCL are held against fast ones of ours, and never against exact ones") {
  const Goal& goal = goal_named("fast normals on both sides");
  CloudResult result = result_of("a.pcd", 400.0);
  CHECK_FALSE(worst_of(goal, 0, {result}));
  result.contenders.push_back(
      measured({"shortshot", std::string("SHOT-352") + with_fast_normals, "O2", "grid"}, 12.5, 11.0, 9'000'000));
  CHECK(worst_of(goal, 0, {result})->value == doctest::Approx(20.0));
  CHECK(worst_of(goal, 0, {result})->met);
}

TEST_CASE("peers: instructions come from the committed figures, each of its unit") {
  const std::vector<CloudResult> any{result_of("a.pcd", 400.0)};
  for (const char* name :
       {"sample_uniform", "kernel SCSH-336", "kernel SSH-32", "kernel CSHOT-1344", "search + frame"}) {
    CAPTURE(name);
    const auto o2 = worst_of(goal_named(name), 0, any);
    const auto avx2 = worst_of(goal_named(name), 1, any);
    REQUIRE(o2);
    CHECK(o2->cloud == "tabletop");
    REQUIRE(avx2);
    CHECK(o2->value > avx2->value);
    CHECK(o2->value < 1000.0);
  }
  for (const char* name : {"CPU with AVX2", "CPU without AVX2", "mean shift"}) {  // in millions
    CAPTURE(name);
    REQUIRE(worst_of(goal_named(name), 0, any));
    CHECK(worst_of(goal_named(name), 0, any)->value > 1.0);
    CHECK(worst_of(goal_named(name), 0, any)->value < 1000.0);
  }
  CHECK_FALSE(committed_instructions("no such stage", "point", "O2"));
  CHECK_THROWS_AS(committed_instructions("sample", "parsec", "O2"), std::runtime_error);
}

}  // namespace test_peers_report
