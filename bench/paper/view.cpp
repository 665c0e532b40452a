#include "paper/view.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench::paper {
namespace {

using shortshot::KeyPoint;

RgbdCloud averaged(const RgbdCloud& cloud, float voxel) {
  std::vector<KeyPoint> means;
  require(shortshot::sample_centroids(view_of_cloud(cloud), voxel, means));
  RgbdCloud result;
  for (const KeyPoint& mean : means) {
    result.xyz.insert(result.xyz.end(), {mean.position.x, mean.position.y, mean.position.z});
    if (cloud.has_colors()) result.rgb.insert(result.rgb.end(), {mean.color.r, mean.color.g, mean.color.b});
  }
  result.width = result.size();
  result.height = 1;
  result.viewpoint = cloud.viewpoint;
  return result;
}

/// `count` of the key points at random; the same ones with every standard library.
void thin_out(std::vector<KeyPoint>& keypoints, std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const auto others = static_cast<std::uint64_t>(keypoints.size() - i);
    std::swap(keypoints[i], keypoints[i + static_cast<std::size_t>(random() * others >> 32)]);
  }
  keypoints.resize(count);
}

std::vector<KeyPoint> keypoints_of(const shortshot::CloudView& cloud, const ViewSettings& settings) {
  std::vector<KeyPoint> keypoints;
  if (!settings.points_of_cloud) {
    require(shortshot::sample_centroids(cloud, settings.leaf, keypoints));
  } else {
    std::vector<std::uint32_t> points;
    require(shortshot::sample_uniform(cloud, settings.leaf, points));
    for (const std::uint32_t i : points) keypoints.push_back(shortshot::keypoint(cloud, i));
  }
  if (settings.most_keypoints > 0 && keypoints.size() > settings.most_keypoints) {
    thin_out(keypoints, settings.most_keypoints, settings.seed);
  }
  return keypoints;
}

shortshot::Point center_of(const shortshot::CloudView& cloud) {
  double sum[3] = {};
  double count = 0.0;
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const shortshot::Point p = shortshot::point(cloud, i);
    if (!shortshot::is_finite(p)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum[axis] += static_cast<double>(shortshot::extend::coordinate(p, axis));
    count += 1.0;
  }
  const auto mean = [&](int axis) { return static_cast<float>(sum[axis] / count); };
  return {mean(0), mean(1), mean(2)};
}

}  // namespace

View::View(RgbdCloud cloud, const ViewSettings& settings)
    : cloud_(settings.voxel > 0.0f ? averaged(cloud, settings.voxel) : std::move(cloud)), settings_(settings) {
  const shortshot::CloudView view = view_of_cloud(cloud_);
  keypoints_ = keypoints_of(view, settings_);
  const shortshot::GridSearch near(view, settings.normal_radius);
  require(shortshot::estimate_normals(view, near, settings.normal_radius, camera_of_cloud(cloud_), normals_));
  search_ = std::make_unique<shortshot::GridSearch>(view, settings.radius);
  require(search_->status());
  center_ = center_of(view);
}

Described View::describe(const Configuration& configuration) const {
  const shortshot::CloudView view = shortshot::with_normals(view_of_cloud(cloud_), normals_.data());
  shortshot::Support support(settings_.radius);
  if (configuration.wants_viewpoint) support.viewpoint = camera_of_cloud(cloud_);
  return configuration.describe(view, *search_, keypoints_, support, configuration.kept);
}

}  // namespace shortshot_bench::paper
