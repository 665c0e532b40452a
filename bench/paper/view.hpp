// One cloud of an experiment, ready to be described.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "paper/configuration.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::paper {

/// How a cloud is looked at; meters.
struct ViewSettings {
  float voxel = 0.0f;              // the cloud is averaged in voxels of this size first; 0: it is taken as it is
  float radius = 0.04f;            // of the support and of the frame
  float leaf = 0.02f;              // one key point in each voxel of this size
  float normal_radius = 0.015f;    // for SHOT and CSHOT
  std::size_t most_keypoints = 0;  // more are thinned out at random; 0: all are taken
  std::uint32_t seed = 1;          // of that
  bool points_of_cloud = false;    // key points are the points nearest to the voxels' centers, not their centroids
};

/// Key points in voxels, normals towards the camera, and the index. Throws std::runtime_error if the cloud
/// has no point. All functions may be called from several threads.
class View {
 public:
  View(RgbdCloud cloud, const ViewSettings& settings);

  const std::vector<shortshot::KeyPoint>& keypoints() const { return keypoints_; }
  bool has_colors() const { return cloud_.has_colors(); }
  const RgbdCloud& cloud() const { return cloud_; }
  const std::vector<shortshot::SurfaceNormal>& normals() const { return normals_; }
  const ViewSettings& settings() const { return settings_; }
  const shortshot::Point& center() const { return center_; }  // the mean of all valid points

  Described describe(const Configuration& configuration) const;

 private:
  RgbdCloud cloud_;
  ViewSettings settings_;
  std::vector<shortshot::SurfaceNormal> normals_;
  std::vector<shortshot::KeyPoint> keypoints_;
  shortshot::Point center_{};
  std::unique_ptr<shortshot::GridSearch> search_;
};

}  // namespace shortshot_bench::paper
