// What a small depth sensor sees of things that are held in front of it, as millimeters, as points and as a descriptor.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "firmware/programs/small_sensor.hpp"
#include "firmware/small_sensor/depth_sensor.hpp"
#include "firmware/small_sensor/task.hpp"
#include "firmware/small_sensor/things.hpp"

namespace test_small_sensor {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::firmware;
using Points = small_sensor::Points<small_sensor::most_points>;

const View straight_on{{{}, {}}, {0.0, -0.3, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}};

View view_of_capsule(const Capsule& capsule) {
  View view = straight_on;
  view.thing.capsules.push_back(capsule);
  return view;
}

bool are_near(float a, float b) { return std::abs(a - b) < 1e-5f; }

std::size_t measurements(const std::vector<std::uint16_t>& depths) {
  return depths.size() - static_cast<std::size_t>(std::count(depths.begin(), depths.end(), 0));
}

}  // namespace

TEST_CASE("small sensor: rays meet the side and the ends of a capsule, and pass it by") {
  const Thing thing{{}, {{{-0.1, 0.0, 0.0}, {0.1, 0.0, 0.0}, 0.05}}};
  const Vec3 ahead{0.0, 1.0, 0.0};
  CHECK(cast_ray(thing, {0.0, -0.5, 0.0}, ahead) == doctest::Approx(0.45));
  CHECK(cast_ray(thing, {0.13, -0.5, 0.0}, ahead) == doctest::Approx(0.46));
  CHECK(cast_ray(thing, {-0.13, -0.5, 0.0}, ahead * 2.0) == doctest::Approx(0.23));
  CHECK(cast_ray(thing, {0.3, 0.0, 0.0}, {-1.0, 0.0, 0.0}) == doctest::Approx(0.15));  // along its axis
  CHECK(cast_ray(thing, {0.151, -0.5, 0.0}, ahead) > 100.0);
  CHECK(cast_ray(thing, {0.0, -0.5, 0.051}, ahead) > 100.0);
  CHECK(cast_ray(thing, {0.0, 0.5, 0.0}, ahead) > 100.0);  // behind the sensor
}

TEST_CASE("small sensor: a ball straight ahead, with noise of one percent, and nothing beside it or beyond the range") {
  const View view = view_of_capsule({{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.04});
  const DepthSensor sensor{32, 24, 0.5};
  Random noise(1);
  const auto depths = measured(sensor, view, noise);
  REQUIRE(depths.size() == 32 * 24);
  CHECK((depths[0] == 0 && measurements(depths) > 40 && measurements(depths) < 90));
  double sum = 0.0;
  int count = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const auto depth = measured(sensor, view, noise)[12 * 32 + 16];
    if (depth == 0) continue;
    sum += depth;
    ++count;
    CHECK(std::abs(depth - 260.0) < 16.0);
  }
  CHECK((count > 180 && count < 200));  // two in a hundred are missing
  CHECK(sum / count == doctest::Approx(260.0).epsilon(0.005));
  View far = view;
  far.eye.y = -0.8;
  CHECK(measurements(measured(sensor, far, noise)) == 0);
}

TEST_CASE("small sensor: millimeters become points of a pinhole camera around their middle") {
  std::vector<std::uint16_t> depths(64, 0);
  depths[0] = depths[7] = depths[56] = depths[63] = 200;
  Points points{};
  small_sensor::to_points(depths.data(), small_sensor::sensors[0], points);
  REQUIRE(points.size == 4);
  const float edge = 0.2f * 0.414f * 7.0f / 8.0f;
  CHECK((are_near(points.xyz[0], -edge) && are_near(points.xyz[1], -edge)));
  CHECK((are_near(points.xyz[9], edge) && are_near(points.xyz[10], edge)));
  CHECK(points.xyz[2] == 0.2f);
  CHECK((points.middle.x == 0.0f && points.middle.y == 0.0f && are_near(points.middle.z, 0.2f)));

  small_sensor::to_points(std::vector<std::uint16_t>(64, 0).data(), small_sensor::sensors[0], points);
  shortshot::CompactWorkspace<64> workspace;
  small_sensor::Stored stored;
  CHECK(points.size == 0);
  CHECK(small_sensor::describe<true>(points, workspace, stored) == shortshot::Status::empty_cloud);
}

TEST_CASE("small sensor: too many zones are averaged in blocks, those that miss more than half are left out") {
  const small_sensor::Sensor& sensor = small_sensor::sensors[3];
  std::vector<std::uint16_t> depths(64 * 48, 0);
  for (std::size_t i = 0; i < 384; ++i) depths[i] = 300;
  CHECK(small_sensor::side_of_blocks(depths.data(), sensor) == 1);
  depths[384] = 300;
  CHECK(small_sensor::side_of_blocks(depths.data(), sensor) == 2);
  std::fill(depths.begin(), depths.end(), std::uint16_t{300});
  CHECK(small_sensor::side_of_blocks(depths.data(), sensor) == 4);
  depths[0] = 460;                                                      // one of the 16
  for (std::size_t i = 4; i < 8; ++i) depths[i] = depths[64 + i] = 0;   // half of the second block
  for (std::size_t i = 8; i < 12; ++i) depths[i] = depths[64 + i] = 0;  // more than half of the third
  depths[2 * 64 + 8] = 0;
  Points points{};
  small_sensor::to_points(depths.data(), sensor, points);
  CHECK(points.size == 191);
  CHECK(are_near(points.xyz[2], 0.310f));
  CHECK(are_near(points.xyz[5], 0.300f));
  CHECK(are_near(points.xyz[6], 0.3f * 0.5f * (2.0f * 12.0f + 4.0f - 64.0f) / 64.0f));
}

TEST_CASE(
    "small sensor: the same seeds give the same frames; those of the test are others than those that are learned") {
  const small_sensor::Sensor& sensor = small_sensor::sensors[1];
  const std::vector<Frame> frames = draw_frames(sensor, {7, 2, 0.2, 0.3});
  REQUIRE(frames.size() == 2 * thing_class_count);
  const std::vector<Frame> again = draw_frames(sensor, {7, 2, 0.2, 0.3});
  const std::vector<Frame> others = draw_frames(sensor, {8, 2, 0.2, 0.3});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    CAPTURE(thing_classes[frames[i].thing_class]);
    CHECK((frames[i].depths == again[i].depths && frames[i].depths != others[i].depths));
    CHECK((measurements(frames[i].depths) > 10 && frames[i].distance > 0.2 && frames[i].distance < 0.3));
  }
  CHECK(training_frames.seed + 1000 * training_frames.views < test_frames.seed);
}

TEST_CASE("small sensor: what was learned is named in new frames, far more often than by chance") {
  const small_sensor::Sensor& sensor = small_sensor::sensors[1];
  const SensorTask task{sensor, draw_frames(sensor, {7, 12, 0.2, 0.3}), draw_frames(sensor, {900007, 4, 0.2, 0.3})};
  const shortshot::Recognizer recognizer = train_stored(task);
  CHECK(recognizer.codeword_count() == 12 * thing_class_count);
  CHECK(recognizer.instance_name(1) == "fist");
  CHECK(right_with_shot(task) > 16);  // of 32; 4 by chance
  const std::string bytes = frames_of(task);
  CHECK(bytes.size() == 4 + task.test.size() * (8 + 2 * 256));
  CHECK((bytes[0] == 32 && bytes[4] == 0 && bytes[4 + 8 + 512] == 1));
}

}  // namespace test_small_sensor
