// Scaling curves: their measurement, their file and their plots.

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <exception>
#include <string>
#include <vector>

#include "cloud_file_samples.hpp"
#include "speed/scaling/allocated.hpp"
#include "speed/scaling/curve_point.hpp"
#include "speed/scaling/frame.hpp"
#include "speed/scaling/measure.hpp"
#include "speed/scaling/plots.hpp"
#include "speed/scaling/stages.hpp"
#include "tools/plot/axis.hpp"

namespace test_scaling_curves {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::scaling;

std::vector<CurvePoint> two_series() {
  return {{"points", 1e4, "points", "build", 0.5, "ms", 1e6, 3},
          {"points", 1e4, "points", "kernel", 2.0, "ms", 0.0, 3},
          {"points", 1e7, "points", "build", 512.0, "ms", 3e6, 3},
          {"points", 1e7, "points", "kernel", 4.0, "ms", 0.0, 3}};
}

}  // namespace

TEST_CASE("the median is the value in the middle") {
  CHECK(median({3.0}) == 3.0);
  CHECK(median({9.0, 1.0, 2.0}) == 2.0);
  CHECK(median({4.0, 1.0, 100.0, 2.0}) == 3.0);
}

TEST_CASE("peak memory counts from where it began, nested or not") {
  const PeakMemory outer;
  note_allocated(100);
  {
    const PeakMemory inner;
    CHECK(inner.extra_bytes() == 0);
    note_allocated(50);
    note_freed(50);
    note_allocated(30);
    CHECK(inner.extra_bytes() == 50);
    note_freed(30);
  }
  CHECK(outer.extra_bytes() == 150);
  {
    const PeakMemory inner;
    note_allocated(10);
    CHECK(inner.extra_bytes() == 10);
    note_freed(10);
  }
  CHECK(outer.extra_bytes() == 150);
  note_freed(100);
}

TEST_CASE("tasks take turns; the first turn tells the memory, the others the time") {
  std::string turns;
  int call = 0;
  const auto task = [&](double x, char name) {
    const auto run = [&turns, &call, name] {
      turns += name;
      ++call;
      return std::vector<Cost>{{1.0 * call, call == 1 ? 64.0 : 0.0}};
    };
    return Task{x, 1e3, {"work"}, run};
  };
  const auto points = measure({"points", "points", "ms", 3}, {task(10.0, 'a'), task(20.0, 'b')});
  CHECK(turns == "abababab");
  REQUIRE(points.size() == 2);
  CHECK(points[0].x == 10.0);
  CHECK(points[0].value == 5e3);  // calls 3, 5 and 7
  CHECK(points[1].value == 6e3);
  CHECK(points[0].extra_bytes == 64.0);
  CHECK(points[0].repetitions == 3);
}

TEST_CASE("the generated clouds have as many points as asked for, and key points are spread over them") {
  for (const std::size_t size : {2000u, 30000u}) {
    const ScalingCloud cloud(size);
    CHECK(std::fabs(static_cast<double>(cloud.valid.size()) / static_cast<double>(size) - 1.0) < 0.03);
    const auto keypoints = spread_keypoints(cloud, 100);
    REQUIRE(keypoints.size() == 100);
    CHECK(keypoints.front() < cloud.valid[cloud.valid.size() / 100]);
    CHECK(keypoints.back() > cloud.valid[cloud.valid.size() * 98 / 100]);
    for (std::size_t k = 1; k < keypoints.size(); ++k) CHECK(keypoints[k] > keypoints[k - 1]);
  }
}

TEST_CASE("a frame's stages add up to its key points, more neighbors cost more") {
  const ScalingCloud cloud(30000);
  FrameWork narrow(cloud, 200, 0.03f);
  FrameWork wide(cloud, 200, 0.12f);
  const auto frame = narrow.run(Clock::thread_cpu);
  REQUIRE(frame.size() == FrameWork::series().size());
  CHECK(FrameWork::series() == std::vector<std::string>{"sample", "index build", "extract", "whole frame"});
  double parts = 0.0;
  for (std::size_t part = 0; part + 1 < frame.size(); ++part) {
    CHECK(frame[part].seconds > 0.0);
    parts += frame[part].seconds;
  }
  CHECK(frame.back().seconds >= parts);  // they are parts of it
  wide.run(Clock::wall);
  CHECK(wide.mean_neighbors() > 5.0 * narrow.mean_neighbors());
  CHECK(wide.most_neighbors() > wide.mean_neighbors());
  StageWork narrow_stages(cloud, narrow, 0.03f);
  StageWork wide_stages(cloud, wide, 0.12f);
  CHECK(narrow_stages.keypoints() == narrow.described().size());
  narrow_stages.run();
  wide_stages.run();
  const auto few = narrow_stages.run();
  const auto many = wide_stages.run();
  REQUIRE(few.size() == StageWork::series().size());
  for (std::size_t stage = 0; stage < few.size(); ++stage) CHECK(few[stage].seconds > 0.0);
  CHECK(many[2].seconds > few[2].seconds);  // ten times the neighbors
}

TEST_CASE("curves are written and read back") {
  const cloud_file_test::TemporaryDirectory directory;
  write_curves(directory.file("curves.json"), two_series());
  const auto points = read_curves(directory.file("curves.json"));
  REQUIRE(points.size() == 4);
  CHECK(points[2].curve == "points");
  CHECK(points[2].x == 1e7);
  CHECK(points[2].series == "build");
  CHECK(points[2].value == 512.0);
  CHECK(points[2].extra_bytes == 3e6);
  CHECK(points[2].repetitions == 3);
}

TEST_CASE("a file that is no list of curve points is refused by its name and what is wrong") {
  const auto refusal_of = [](const std::string& text) {
    const cloud_file_test::TemporaryDirectory directory;
    const std::string path = directory.file("curves.json");
    cloud_file_test::write_bytes(path, text);
    try {
      read_curves(path);
    } catch (const std::exception& error) {
      const std::string what = error.what();
      return what.find(path + ": ") == 0 ? what.substr(path.size() + 2) : "no name: " + what;
    }
    return std::string("accepted");
  };
  CHECK(refusal_of("[").find("parse error") != std::string::npos);
  CHECK(refusal_of("{}") == "expected a list of one or more objects");
  CHECK(refusal_of("[]") == "expected a list of one or more objects");
  CHECK(refusal_of("[3]") == "entry 1: expected an object, found 3");
  CHECK(refusal_of("[{\"curve\": 1}]") == "entry 1: 'curve' must be text, not 1");
  CHECK(refusal_of("[{\"curve\": \"points\"}]") == "entry 1: 'x' is missing");
  CHECK_THROWS_WITH(read_curves("no/such.json"), "no/such.json: cannot open the file");
}

TEST_CASE("a plot's data: axes that fit, the same series in both blocks, no zeros") {
  const std::string data = plot_data(two_series());
  CHECK(data ==
        "curve = 'points'\nx_name = 'points'\nunit = 'ms'\n"
        "x_axis = 'set logscale x 10; set xrange [7585.78:1.31826e+07]; set xtics autofreq; "
        "set xtics (10000, 1e+07); '\n"
        "cost_axis = 'set logscale y 10; set yrange [0.378929:675.588]; set ytics autofreq; '\n"
        "memory_axis = 'unset logscale y; set yrange [0.92:3.08]; set ytics autofreq; '\n"
        "$cost << END\n\"build\"\n10000 0.5\n1e+07 512\n\n\n\"kernel\"\n10000 2\n1e+07 4\n\n\nEND\n"
        "$memory << END\n\"build\"\n10000 1\n1e+07 3\n\n\n\"kernel\"\nNaN NaN\n\n\nEND\n");
}

TEST_CASE("an axis of positive values: linear, with three ticks a decade, or with decades, and nothing empty") {
  CHECK(positive_axis("x", 4.0, 24.0) == "unset logscale x; set xrange [3.2:24.8]; set xtics autofreq; ");
  CHECK(positive_axis("y", 10.0, 10.0) == "unset logscale y; set yrange [9:11]; set ytics autofreq; ");
  CHECK(positive_axis("y", 1.5, 60.0).find("set ytics (2, 5, 10, 20, 50); ") != std::string::npos);
  CHECK(positive_axis("y", 1.0, 100.0) == "set logscale y 10; set yrange [0.831764:120.226]; set ytics autofreq; ");
}

}  // namespace test_scaling_curves
