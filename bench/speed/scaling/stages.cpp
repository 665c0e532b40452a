#include "speed/scaling/stages.hpp"

#include <algorithm>
#include <stdexcept>

namespace shortshot_bench::scaling {

namespace {

constexpr double neighbors_in_batch = 13000.0;  // 20 bytes each: a quarter of a megabyte

void add(Cost& total, const Cost& more) {
  total.seconds += more.seconds;
  total.extra_bytes = std::max(total.extra_bytes, more.extra_bytes);
}

}  // namespace

StageWork::StageWork(const ScalingCloud& cloud, const FrameWork& frame, float radius)
    : cloud_(cloud), index_(frame.index()), keypoints_(frame.described()), radius_(radius), lab_(cloud.cloud.size()) {
  if (frame.most_neighbors() > capacity) throw std::runtime_error("too many neighbors for the stages' workspaces");
  const double fitting = neighbors_in_batch / std::max(1.0, frame.mean_neighbors());
  batch_ = std::min(most_in_batch, std::max<std::size_t>(1, static_cast<std::size_t>(fitting)));
  require(shortshot::convert_colors<Measured::LabRule>(cloud.view, lab_.data()));
  for (std::size_t i = 0; i < batch_; ++i) workspaces_.emplace_back(new shortshot::Workspace<capacity>);
}

std::vector<Cost> StageWork::run() {
  std::vector<Cost> costs(series().size());
  for (std::size_t begin = 0; begin < keypoints_.size(); begin += batch_) {
    run_batch(begin, std::min(begin + batch_, keypoints_.size()), costs);
  }
  return costs;
}

void StageWork::run_batch(std::size_t begin, std::size_t end, std::vector<Cost>& costs) {
  std::array<shortshot::KeyPoint, most_in_batch> keys;
  std::array<shortshot::Neighborhood, most_in_batch> neighborhoods;
  std::array<shortshot::Frame, most_in_batch> frames;
  float descriptor[Measured::size];
  const std::size_t count = end - begin;
  for (std::size_t i = 0; i < count; ++i) {
    keys[i] = shortshot::keypoint(cloud_.view, keypoints_[begin + i]);
    neighborhoods[i] = shortshot::neighborhood_in(*workspaces_[i]);
  }
  const auto stage = [&](Cost& total, const auto& work) {
    bool all_ok = true;
    const auto each = [&] {
      for (std::size_t i = 0; i < count; ++i) all_ok = work(i) == shortshot::Status::ok && all_ok;
    };
    add(total, cost_of(Clock::thread_cpu, each));
    if (!all_ok) throw std::runtime_error("a key point of the generated scene cannot be described");
  };
  stage(costs[0], [&](std::size_t i) { return index_.gather(keys[i].position, radius_, neighborhoods[i]); });
  stage(costs[1], [&](std::size_t i) { return shortshot::estimate_frame(neighborhoods[i], radius_, frames[i]); });
  stage(costs[2], [&](std::size_t i) {
    const shortshot::LabColors colors{lab_.data(), shortshot::to_lab<Measured::LabRule>(keys[i].color)};
    return shortshot::describe<Measured>(neighborhoods[i], colors, frames[i], radius_, descriptor);
  });
}

}  // namespace shortshot_bench::scaling
