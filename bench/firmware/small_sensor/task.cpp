#include "firmware/small_sensor/task.hpp"

#include <algorithm>

#include "firmware/small_sensor/depth_sensor.hpp"
#include "firmware/small_sensor/things.hpp"
#include "tools/io/require_ok.hpp"

namespace shortshot_bench::firmware {
namespace {

namespace ss = shortshot;
using small_sensor::Stored;
using Points = small_sensor::Points<small_sensor::most_points>;

const ss::RecognizerOptions recognizer_options{0.03f, small_sensor::activated, 8};

Points points_of(const Frame& frame, const small_sensor::Sensor& sensor) {
  Points points{};
  small_sensor::to_points(frame.depths.data(), sensor, points);
  return points;
}

ss::StoredFeatures<Stored> described(const Points& points, const small_sensor::Sensor& sensor) {
  ss::StoredFeatures<Stored> features;
  features.descriptors.resize(1);
  features.keypoints.resize(1);
  features.keypoints[0].position = points.middle;
  features.frames = {small_sensor::own_axes};
  ss::Workspace<small_sensor::most_points> workspace;
  Stored& out = features.descriptors[0];
  features.status = {sensor.has_few_points ? small_sensor::describe<true>(points, workspace, out)
                                           : small_sensor::describe<false>(points, workspace, out)};
  return features;
}

}  // namespace

std::vector<Frame> draw_frames(const small_sensor::Sensor& sensor, const FrameDraw& draw) {
  const DepthSensor zones{sensor.width, sensor.height, static_cast<double>(sensor.half_width)};
  std::vector<Frame> frames;
  for (std::uint32_t view = 0; view < draw.views; ++view) {
    for (std::uint32_t thing_class = 0; thing_class < thing_class_count; ++thing_class) {
      const std::uint32_t seed = draw.seed + 1000 * view + thing_class;
      Random random(seed);
      Random noise(seed + 777777);
      const double distance = random.uniform(draw.nearest, draw.farthest);
      frames.push_back({measured(zones, draw_view(random, thing_class, distance), noise), thing_class, distance});
    }
  }
  return frames;
}

SensorTask sensor_task(const small_sensor::Sensor& sensor) {
  return {sensor, draw_frames(sensor, training_frames), draw_frames(sensor, test_frames)};
}

ss::Recognizer train_stored(const SensorTask& task) {
  ss::Recognizer recognizer(recognizer_options);
  for (const Frame& frame : task.training) {
    const Points points = points_of(frame, task.sensor);
    require(ss::train(recognizer, described(points, task.sensor), points.middle, thing_classes[frame.thing_class],
                      thing_classes[frame.thing_class]));
  }
  return recognizer;
}

namespace {

ss::Features<ss::Shot352> shot_of(const Points& points) {
  constexpr std::size_t keypoints = 16;
  constexpr float normal_radius = 0.05f;
  ss::CloudView cloud = ss::view_xyz(points.xyz, points.size);
  const ss::BruteSearch search(cloud);
  std::vector<ss::SurfaceNormal> normals;
  require(ss::estimate_normals(cloud, search, normal_radius, ss::Viewpoint::towards({}), normals));
  cloud = ss::with_normals(cloud, normals.data());
  std::vector<std::uint32_t> chosen;
  const std::size_t stride = (points.size + keypoints - 1) / keypoints;
  for (std::size_t i = stride / 2; i < points.size; i += stride) chosen.push_back(static_cast<std::uint32_t>(i));
  ss::Support support = small_sensor::radius;
  support.viewpoint = ss::Viewpoint::towards({});
  ss::Features<ss::Shot352> features;
  require(ss::extract<ss::Shot352>(cloud, search, chosen, support, features));
  return features;
}

}  // namespace

std::size_t right_with_shot(const SensorTask& task) {
  ss::Recognizer recognizer(recognizer_options);
  for (const Frame& frame : task.training) {
    const Points points = points_of(frame, task.sensor);
    require(ss::train(recognizer, shot_of(points), points.middle, thing_classes[frame.thing_class],
                      thing_classes[frame.thing_class]));
  }
  std::size_t right = 0;
  for (const Frame& frame : task.test) {
    std::vector<ss::Hypothesis> found;
    require(ss::recognize(recognizer, shot_of(points_of(frame, task.sensor)), found));
    right += !found.empty() && recognizer.instance_name(found[0].instance) == thing_classes[frame.thing_class] ? 1 : 0;
  }
  return right;
}

std::string frames_of(const SensorTask& task) {
  std::string bytes;
  const auto number = [&](std::size_t value, int bits) {
    for (int shift = 0; shift < bits; shift += 8) bytes += static_cast<char>(value >> shift & 255u);
  };
  number(task.test.size(), 32);
  for (const Frame& frame : task.test) {
    number(frame.thing_class, 32);
    number(static_cast<std::size_t>(1000.0 * frame.distance + 0.5), 32);
    for (const std::uint16_t depth : frame.depths) number(depth, 16);
  }
  return bytes;
}

}  // namespace shortshot_bench::firmware
