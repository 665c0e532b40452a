#include "speed/scaling/curves.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>

#include "speed/scaling/frame.hpp"
#include "speed/scaling/measure.hpp"
#include "speed/scaling/stages.hpp"

namespace shortshot_bench::scaling {
namespace {

constexpr std::size_t camera_points = 280000;  // of 640 x 480 pixels
constexpr std::size_t many_keypoints = 1000;

Task frame_task(double x, const std::shared_ptr<FrameWork>& work, Clock clock = Clock::thread_cpu) {
  return {x, 1e3, FrameWork::series(), [work, clock] { return work->run(clock); }};
}

Task lab_task(double x, const ScalingCloud& cloud) {
  const auto lab = std::make_shared<std::vector<shortshot::Lab>>();
  const auto convert = [&cloud, lab] {
    lab->resize(cloud.cloud.size());
    require(shortshot::convert_colors<Measured::LabRule>(cloud.view, lab->data()));
  };
  return {x, 1e3, {"Lab"}, [convert] { return std::vector<Cost>{cost_of(Clock::thread_cpu, convert)}; }};
}

/// A radius within which key points have about that many neighbors: their number grows with its square, nearly.
float radius_for(const ScalingCloud& cloud, double neighbors) {
  float radius = scaling_radius;
  for (int step = 0; step < 4; ++step) {
    FrameWork work(cloud, 200, radius);
    work.run(Clock::thread_cpu);
    radius *= static_cast<float>(std::sqrt(neighbors / work.mean_neighbors()));
  }
  return radius;
}

}  // namespace

std::vector<CurvePoint> measure_points(bool quick) {
  std::vector<double> sizes{1e4, 3e4, 1e5, 3e5};
  if (!quick) sizes.insert(sizes.end(), {1e6, 3e6, 1e7});
  std::vector<std::unique_ptr<ScalingCloud>> clouds;
  std::vector<Task> tasks;
  for (const double size : sizes) {
    std::fprintf(stderr, "generating a cloud of %.0f points\n", size);
    clouds.push_back(std::make_unique<ScalingCloud>(static_cast<std::size_t>(size)));
    const ScalingCloud& cloud = *clouds.back();
    const auto points = static_cast<double>(cloud.valid.size());
    tasks.push_back(frame_task(points, std::make_shared<FrameWork>(cloud, many_keypoints, scaling_radius)));
    tasks.push_back(lab_task(points, cloud));
  }
  return measure({"points", "points", "ms", quick ? 3 : 7}, tasks);
}

std::vector<CurvePoint> measure_neighbors(bool quick) {
  const ScalingCloud cloud(camera_points);
  std::vector<double> targets{50, 100, 200, 500, 1000, 2000, 5000, 10000};
  if (quick) targets = {50, 500, 5000};
  std::vector<Task> tasks;
  for (const double target : targets) {
    const float radius = radius_for(cloud, target);
    const auto frame = std::make_shared<FrameWork>(cloud, many_keypoints, radius);
    frame->run(Clock::thread_cpu);
    const auto stages = std::make_shared<StageWork>(cloud, *frame, radius);
    const auto fresh = std::make_shared<FrameWork>(cloud, many_keypoints, radius);  // its first run counts the memory
    tasks.push_back(
        {frame->mean_neighbors(), 1e6 / static_cast<double>(many_keypoints), {FrameWork::series().back()}, [fresh] {
           return std::vector<Cost>{fresh->run(Clock::thread_cpu).back()};
         }});
    tasks.push_back({frame->mean_neighbors(), 1e6 / static_cast<double>(stages->keypoints()), StageWork::series(),
                     [frame, stages] { return stages->run(); }});
  }
  return measure({"neighbors", "neighbors per key point", "us per key point", quick ? 3 : 9}, tasks);
}

std::vector<CurvePoint> measure_keypoints(bool quick) {
  const ScalingCloud cloud(camera_points);
  std::vector<std::size_t> counts{10, 30, 100, 300, 1000, 3000, 10000};
  if (!quick) counts.insert(counts.end(), {30000, 100000});
  std::vector<Task> tasks;
  for (const std::size_t count : counts) {
    tasks.push_back(frame_task(static_cast<double>(count), std::make_shared<FrameWork>(cloud, count, scaling_radius)));
  }
  return measure({"keypoints", "key points", "ms", quick ? 3 : 7}, tasks);
}

std::vector<CurvePoint> measure_threads(bool quick) {
  const ScalingCloud cloud(camera_points);
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  std::vector<Task> tasks;
  for (unsigned threads = 1; threads <= 2 * cores; threads += threads < cores ? 1 : cores) {
    const auto work = std::make_shared<FrameWork>(cloud, quick ? 1000 : 10000, scaling_radius, threads);
    tasks.push_back(frame_task(static_cast<double>(threads), work, Clock::wall));
  }
  return measure({"threads", "threads", "ms", quick ? 5 : 15}, tasks);
}

std::vector<CurvePoint> measure_curves(bool quick) {
  std::vector<CurvePoint> all;
  for (const auto curve : {measure_points, measure_neighbors, measure_keypoints, measure_threads}) {
    const std::vector<CurvePoint> points = curve(quick);
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

}  // namespace shortshot_bench::scaling
