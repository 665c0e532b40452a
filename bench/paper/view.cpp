#include "paper/view.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "tools/io/averaged_cloud.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench::paper {
namespace {

using shortshot::KeyPoint;

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

}  // namespace

View::View(RgbdCloud cloud, const ViewSettings& settings)
    : cloud_(settings.voxel > 0.0f ? averaged(cloud, settings.voxel) : std::move(cloud)), settings_(settings) {
  const shortshot::CloudView view = view_of_cloud(cloud_);
  keypoints_ = keypoints_of(view, settings_);
  const shortshot::GridSearch near(view, settings.normal_radius);
  require(shortshot::estimate_normals(view, near, settings.normal_radius, camera_of_cloud(cloud_), normals_));
  search_ = std::make_unique<shortshot::GridSearch>(view, settings.radius);
  require(search_->status());
  center_ = mean_point(view);
}

Described View::describe(const Configuration& configuration) const {
  const shortshot::CloudView view = shortshot::with_normals(view_of_cloud(cloud_), normals_.data());
  shortshot::Support support(settings_.radius);
  if (configuration.wants_viewpoint) support.viewpoint = camera_of_cloud(cloud_);
  return configuration.describe(view, *search_, keypoints_, support, configuration.kept);
}

}  // namespace shortshot_bench::paper
