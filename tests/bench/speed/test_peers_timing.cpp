// The peers' clocks and samples, and what a run over suites does.

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "speed/peers/measure.hpp"
#include "speed/peers/timing.hpp"

namespace test_peers_timing {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::peers;

Samples samples_of(const std::vector<double>& times, double rate) {
  Samples samples;
  for (const double ms : times) samples.add(ms, rate);
  return samples;
}

}  // namespace

TEST_CASE("peers: the median of odd and even numbers of samples, in any order") {
  CHECK(samples_of({3.0}, 1.0).median_ms(0.0) == doctest::Approx(3.0));
  CHECK(samples_of({9.0, 1.0, 2.0}, 1.0).median_ms(0.0) == doctest::Approx(2.0));
  CHECK(samples_of({9.0, 1.0, 2.0, 4.0}, 1.0).median_ms(0.0) == doctest::Approx(3.0));
}

TEST_CASE("peers: samples from a disturbed core do not count, unless there are no others") {
  Samples samples = samples_of({10.0, 12.0, 14.0}, 5.0);
  samples.add(90.0, 2.5);
  samples.add(80.0, 2.6);
  CHECK(samples.taken() == 5);
  CHECK(samples.kept(4.5) == 3);
  CHECK(samples.median_ms(4.5) == doctest::Approx(12.0));
  CHECK(samples.best_rate() == doctest::Approx(5.0));
  CHECK(samples.last_ms() == doctest::Approx(80.0));
  CHECK(samples.kept(6.0) == 0);
  CHECK(samples.median_ms(6.0) == doctest::Approx(14.0));
}

TEST_CASE("peers: the probe measures a rate, and clocks go forward") {
  for (const Clock clock : {Clock::thread_cpu, Clock::wall}) {
    const double start = now_seconds(clock);
    CHECK(add_rate() > 1e-3);
    CHECK(now_seconds(clock) > start);
  }
}

TEST_CASE("peers: every step runs once per round after the warm-up, suites in turn, each from its first step") {
  std::string log;
  std::vector<Suite> suites{{"one"}, {"two"}};
  const auto write = [&log](char c) { return [&log, c] { log += c; }; };
  const std::size_t tree = suites[0].add("tree", write('t'));
  const std::size_t describe = suites[0].add("describe", write('d'));
  suites[0].contenders.push_back({"ours", "D", "O2", "grid", describe, {tree, describe}, 100});
  suites[0].release = write('r');
  Contender many{"peer", "key points", {}, "voxels", suites[1].add("work", write('w'))};
  many.made = 10;
  suites[1].contenders.push_back(many);
  suites[1].release = write('r');
  Task task;
  task.keypoints = {1, 2, 3, 4};

  const CloudResult result = measure(task, suites, 3, [&](const auto& work) {
    work();
    log += 'p';
    return std::size_t{150};
  });
  CHECK(log ==
        "rtdpr"
        "rpr"
        "tdw"
        "wtd"
        "tdw");
  REQUIRE(result.contenders.size() == 2);
  const MeasuredContender& m = result.contenders[0];
  CHECK(m.peak_bytes == 50);
  CHECK(m.taken == 3);
  CHECK(m.us_per_keypoint == doctest::Approx(1e3 * result.steps.at("one: describe").ms / 4.0));
  CHECK(result.contenders[1].us_per_keypoint == doctest::Approx(1e3 * result.steps.at("two: work").ms / 10.0));
  CHECK(m.frame_ms == doctest::Approx(result.steps.at("one: describe").ms + result.steps.at("one: tree").ms));
  CHECK(result.steps.count("two: work") == 1);
  CHECK(result.taken == 9);
  CHECK(result.kept <= result.taken);
}

}  // namespace test_peers_timing
