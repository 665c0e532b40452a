#include "speed/scaling/frame.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "speed/spread_keypoints.hpp"
#include "tools/scene/tabletop.hpp"

namespace shortshot_bench::scaling {

ScalingCloud::ScalingCloud(std::size_t about_points) {
  constexpr double valid_share = 0.91;  // of the pixels of the scene
  const double pixels = static_cast<double>(about_points) / valid_share;
  TabletopOptions options;
  options.width = static_cast<std::size_t>(std::lround(std::sqrt(pixels * 4.0 / 3.0)));
  options.height = (3 * options.width + 2) / 4;
  cloud = make_tabletop(options);
  view = shortshot::view_xyz_rgb(cloud.xyz.data(), cloud.rgb.data(), cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (shortshot::is_finite(shortshot::point(view, i))) valid.push_back(static_cast<std::uint32_t>(i));
  }
}

std::vector<std::uint32_t> spread_keypoints(const ScalingCloud& cloud, std::size_t count) {
  std::vector<std::uint32_t> keypoints = cloud.valid;
  keep_spread(keypoints, count);
  return keypoints;
}

FrameWork::FrameWork(const ScalingCloud& cloud, std::size_t keypoints, float radius, unsigned threads)
    : cloud_(cloud), keypoints_(spread_keypoints(cloud, keypoints)), radius_(radius), threads_(threads) {
  features_.values.reserve(keypoints * static_cast<std::size_t>(Measured::size));
  features_.status.reserve(keypoints);
  features_.neighbors.reserve(keypoints);
}

std::vector<Cost> FrameWork::run(Clock clock) {
  Cost sample;
  Cost build;
  Cost extract;
  const Cost whole = cost_of(clock, [&] {
    sample = cost_of(clock, [&] { require(sampler_.sample_uniform(cloud_.view, scaling_leaf, sampled_)); });
    build = cost_of(clock, [&] { require(index_.build(cloud_.view, radius_)); });
    extract = cost_of(
        clock, [&] { require(extractor_.extract(cloud_.view, index_, keypoints_, radius_, features_, threads_)); });
  });
  return {sample, build, extract, whole};
}

std::vector<std::uint32_t> FrameWork::described() const {
  std::vector<std::uint32_t> found;
  for (std::size_t row = 0; row < features_.size(); ++row) {
    if (features_.status[row] == shortshot::Status::ok) found.push_back(keypoints_[row]);
  }
  if (found.empty()) throw std::runtime_error("no key point of the generated scene can be described");
  return found;
}

double FrameWork::mean_neighbors() const {
  double sum = 0.0;
  for (std::size_t row = 0; row < features_.size(); ++row) {
    if (features_.status[row] == shortshot::Status::ok) sum += features_.neighbors[row];
  }
  return sum / static_cast<double>(described().size());
}

std::uint32_t FrameWork::most_neighbors() const {
  return *std::max_element(features_.neighbors.begin(), features_.neighbors.end());
}

}  // namespace shortshot_bench::scaling
