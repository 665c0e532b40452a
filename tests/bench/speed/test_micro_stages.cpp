// What `micro` and `instructions` measure: the workload, the stages, and the counters of the benchmarks made of them.

#include <benchmark/benchmark.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "speed/micro/options.hpp"
#include "speed/micro/register.hpp"
#include "speed/spread_keypoints.hpp"
#include "speed/stages/stages.hpp"
#include "tools/scene/tabletop.hpp"

namespace test_micro_stages {
namespace {

using namespace shortshot_bench;

RgbdCloud small_scene() {
  TabletopOptions options;
  options.width = 160;
  options.height = 120;
  return make_tabletop(options);
}

const Workload& small_workload() {
  static const Workload workload = make_workload(small_scene(), {0.08f, 0.02f, 100});
  return workload;
}

/// The exit code of a command line, or -1 if micro would go on.
int exit_code_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "micro");
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  MicroOptions options;
  int exit_code = -2;
  return parse_options(static_cast<int>(pointers.size()), pointers.data(), options, exit_code) ? -1 : exit_code;
}

/// Works on descriptors or votes that are there already.
bool is_after_description(const Stage& stage) {
  return stage.name == "binarize Shot352" || stage.name == "hamming Shot352" || stage.name == "mean shift";
}

/// Keeps what Google Benchmark reports.
class Recorder : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& reported) override {
    runs.insert(runs.end(), reported.begin(), reported.end());
  }
  std::vector<Run> runs;
};

}  // namespace

TEST_CASE("micro's command line: its options and Google Benchmark's go on, help ends well, bad ones end with 2") {
  CHECK(exit_code_of({}) == -1);
  CHECK(exit_code_of({"a.pcd", "--radius", "0.1", "--benchmark_filter=frame", "b.ply", "--keypoints", "7"}) == -1);
  CHECK(exit_code_of({"--help"}) == 0);
  CHECK(exit_code_of({"--radius", "wide"}) == 2);
  CHECK(exit_code_of({"--keypoints", "0"}) == 2);
  CHECK(exit_code_of({"--no-such-option"}) == 2);
  CHECK(exit_code_of({"--benchmark_no_such_option=1"}) == 2);
}

TEST_CASE("options reach their places, and clouds are named by their files") {
  char program[] = "micro", radius[] = "--radius=0.25", leaf[] = "--leaf=0.5", keypoints[] = "--keypoints=7";
  char first[] = "some/where/one.pcd", second[] = "two.ply";
  char* arguments[] = {program, first, radius, leaf, keypoints, second};
  MicroOptions options;
  int exit_code = 0;
  REQUIRE(parse_options(6, arguments, options, exit_code));
  CHECK(options.clouds == std::vector<std::string>{"some/where/one.pcd", "two.ply"});
  CHECK(options.workload.radius == 0.25f);
  CHECK(options.workload.leaf == 0.5f);
  CHECK(options.workload.keypoints == 7);
  CHECK(cloud_name(options.clouds[0]) == "one");
  CHECK(cloud_name("") == "tabletop");
}

TEST_CASE("a workload holds what its stages need, and what it says of it is true") {
  const Workload& w = small_workload();
  CHECK(w.sampled.size() > 1000);
  CHECK(w.sampled_neighbors > w.sampled.size());
  REQUIRE(w.chosen.size() > 50);
  CHECK(w.chosen.size() <= 100);
  std::size_t neighbors = 0;
  std::uint32_t most = 0;
  for (const GatheredKeyPoint& k : w.chosen) {
    CHECK(k.neighborhood.size == k.neighborhood.found);
    CHECK(k.neighborhood.dx == k.memory.empty().dx);
    CHECK(shortshot::validate(k.frame) == shortshot::Status::ok);
    neighbors += k.neighborhood.size;
    most = std::max(most, k.neighborhood.size);
  }
  CHECK(w.chosen_neighbors == neighbors);
  CHECK(w.most_neighbors == most);
  CHECK(w.normal_radius == 0.02f);
  CHECK(w.frame_leaf == 0.01f);
  CHECK(w.normals.size() == w.cloud.size());
  CHECK(shortshot::has_normals(w.view()));
  const shortshot::BruteSearch everything{w.view()};
  std::size_t normal_neighbors = 0;
  for (std::size_t i = 0; i < w.cloud.size(); ++i) {
    shortshot::Neighborhood n{};
    static_cast<void>(everything.gather(shortshot::point(w.view(), i), w.normal_radius, n));
    normal_neighbors += n.found;
  }
  CHECK(w.normal_neighbors == normal_neighbors);
}

TEST_CASE("key points are kept evenly spread, in their order, and all where there are not more") {
  std::vector<std::uint32_t> keypoints{1, 2, 3, 5, 8, 13, 21, 34, 55};
  keep_spread(keypoints, 20);
  CHECK(keypoints.size() == 9);
  keep_spread(keypoints, 9);
  CHECK(keypoints.size() == 9);
  keep_spread(keypoints, 3);
  CHECK(keypoints == std::vector<std::uint32_t>{2, 8, 34});
  keep_spread(keypoints, 1);
  CHECK(keypoints == std::vector<std::uint32_t>{8});
}

TEST_CASE("a workload that cannot be is refused in the library's words") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  CHECK_THROWS_WITH(make_workload({}, {}), shortshot::message(shortshot::Status::empty_cloud));
  for (const float bad : {0.0f, -1.0f, nan}) {
    CHECK_THROWS_WITH(make_workload(small_scene(), {bad, 0.02f, 10}),
                      shortshot::message(shortshot::Status::bad_radius));
    CHECK_THROWS_WITH(make_workload(small_scene(), {0.04f, bad, 10}), shortshot::message(shortshot::Status::bad_leaf));
  }
  CHECK_THROWS_WITH(make_workload(small_scene(), {1e-4f, 0.02f, 10}),
                    "no key point has a frame and normals: is the radius in the cloud's unit?");
}

TEST_CASE("every build has the same stages, and they all run; the one that chooses has those that can") {
  const std::vector<StageBuild> builds = build_stages(small_workload());
  REQUIRE(builds.size() == (cpu_has_avx2() ? 3 : 1));
  const std::vector<Stage>& known = builds[0].stages;
  for (const StageBuild& build : builds) {
    CAPTURE(build.isa);
    REQUIRE(build.stages.size() == (build.isa == "baseline" ? 3 : 32));
    for (const Stage& stage : build.stages) {
      CAPTURE(stage.name);
      const auto same =
          std::find_if(known.begin(), known.end(), [&](const Stage& other) { return other.name == stage.name; });
      REQUIRE(same != known.end());
      CHECK(stage.neighbors == same->neighbors);
      CHECK((stage.points > 0) != (stage.keypoints > 0));
      const bool looks_at_neighbors = stage.points > 0 ? stage.name == "normals" : !is_after_description(stage);
      CHECK((stage.neighbors > 0) == looks_at_neighbors);
      CHECK(stage.run() == shortshot::Status::ok);
      CHECK(stage.run() == shortshot::Status::ok);
    }
  }
  if (builds.size() == 3) {
    CHECK(builds[1].isa == "avx2");
    CHECK(builds[2].isa == "baseline");
  }
  const Stage& frame = builds[0].stages.back();
  CHECK(frame.per_frame);
  CHECK(frame.name == "whole frame Scsh336");
  CHECK(frame.keypoints == frame_keypoints);
  CHECK(frame.neighbors > frame.keypoints);
  CHECK(frame.bytes == shortshot::Scsh336::size_bytes);
}

TEST_CASE("a cloud without colors and intensities has the stages that need none") {
  RgbdCloud scene = small_scene();
  scene.rgb.clear();
  scene.intensity.clear();
  const Workload workload = make_workload(std::move(scene), {});
  const std::vector<StageBuild> builds = build_stages(workload);
  CHECK(builds[0].stages.size() == 18);
  for (const Stage& stage : builds[0].stages) {
    CAPTURE(stage.name);
    CHECK(stage.name.find("Scsh") == std::string::npos);
    CHECK(stage.name.find("Cshot") == std::string::npos);
    CHECK(stage.name.find("Intensity") == std::string::npos);
    CHECK(stage.run() == shortshot::Status::ok);
  }
}

TEST_CASE("a cloud with intensities and no colors has their stages, too") {
  RgbdCloud scene = small_scene();
  scene.rgb.clear();
  const Workload workload = make_workload(std::move(scene), {});
  const std::vector<StageBuild> builds = build_stages(workload);
  CHECK(builds[0].stages.size() == 20);
  const auto is_intensity = [](const Stage& stage) { return stage.name == "kernel IntensityShape336"; };
  CHECK(std::count_if(builds[0].stages.begin(), builds[0].stages.end(), is_intensity) == 1);
}

TEST_CASE("benchmarks report time, neighbors and bytes; instructions where the CPU's counter can be read") {
  const InstructionCounter counter;
  register_stages("scene", small_workload(), counter);
  REQUIRE(exit_code_of({"--benchmark_filter=scene/(kernel_Shot352|normals|lab|binarize_Shot352)/",
                        "--benchmark_min_time=0.001"}) == -1);
  Recorder recorder;
  const std::size_t isas = cpu_has_avx2() ? 2 : 1;
  CHECK(benchmark::RunSpecifiedBenchmarks(&recorder) == 4 * isas);
  REQUIRE(recorder.runs.size() == 4 * isas);
  for (const auto& run : recorder.runs) {
    const std::string name = run.benchmark_name();
    CAPTURE(name);
    CHECK_FALSE(run.error_occurred);
    const auto is = [&](const char* stage) { return name.find(stage) != std::string::npos; };
    const auto value = [&](const std::string& counter_name) {
      const auto found = run.counters.find(counter_name);
      return found == run.counters.end() ? -1.0 : found->second.value;
    };
    const bool of_cloud = is("lab") || is("normals");
    const bool of_neighbors = is("kernel") || is("normals");
    const Workload& w = small_workload();
    const double mean = static_cast<double>(w.chosen_neighbors) / static_cast<double>(w.chosen.size());
    CHECK(value("neighbors") == (is("kernel") ? mean : -1.0));
    CHECK(value("bytes") == (of_cloud ? 12.0 * 160 * 120 : is("kernel") ? 4.0 * 352 : 44.0));
    CHECK((value("ns/point") > 0.0) == of_cloud);
    CHECK((value("ns/keypoint") > 0.0) != of_cloud);
    CHECK((value("ns/neighbor") > 0.0) == of_neighbors);
    if (is("kernel")) CHECK(value("ns/keypoint") == doctest::Approx(mean * value("ns/neighbor")));
    CHECK((value(of_cloud ? "instructions/point" : "instructions/keypoint") > 1.0) == counter.counts());
    CHECK((value("instructions/neighbor") > 1.0) == (counter.counts() && of_neighbors));
  }
}

TEST_CASE("the counter of instructions counts, or says why not") {
  const InstructionCounter counter;
  if (!counter.counts()) {
    CHECK(counter.why_not() != "");
    CHECK(counter.instructions() == 0);
    return;
  }
  const std::uint64_t before = counter.instructions();
  volatile int work = 0;
  for (int i = 0; i < 10000; ++i) work = work + i;
  CHECK(counter.instructions() - before > 10000);
}

}  // namespace test_micro_stages
