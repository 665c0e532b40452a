// Rigid motions from pairs of points, and key points from clouds, at any coordinates: finite, or a status and zeros.
#include <algorithm>
#include <shortshot/batch/keypoints.hpp>
#include <shortshot/recognition/pose.hpp>

#include "made_cloud.hpp"

namespace {

namespace ss = shortshot;
using fuzz::require;
using ss::Status;

void check_pose(Status status, const ss::Pose& pose) {
  if (status != Status::ok) {
    for (const float value : pose.rotation) require(value == 0.0f, "no pose, and zeros");
    for (const float value : pose.translation) require(value == 0.0f, "no pose, and zeros");
    return;
  }
  for (const float value : pose.translation) require(std::isfinite(value), "a finite translation");
  const float* const r = pose.rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const float dot = r[3 * i] * r[3 * k] + r[3 * i + 1] * r[3 * k + 1] + r[3 * i + 2] * r[3 * k + 2];
      require(std::abs(dot - (i == k ? 1.0f : 0.0f)) < 1e-4f, "orthonormal rows");
    }
  }
  const float determinant =
      r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) + r[2] * (r[3] * r[7] - r[4] * r[6]);
  require(determinant > 0.5f, "a rotation, no reflection");
}

/// Corners of the target lie where a quarter turn takes those of the source, and some anywhere.
std::vector<ss::PointPair> made_pairs(const fuzz::MadeCloud& cloud) {
  std::vector<ss::PointPair> pairs;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float* const p = cloud.xyz.data() + 3 * i;
    const bool is_wrong = cloud.rgb[3 * i] % 4 == 3;
    const float* const q = is_wrong ? cloud.xyz.data() : p;
    pairs.push_back({{p[0], p[1], p[2]}, {-q[1], q[0], q[2] + cloud.radius}});
  }
  return pairs;
}

void check_poses(const fuzz::MadeCloud& cloud, fuzz::Bytes& options) {
  const std::vector<ss::PointPair> pairs = made_pairs(cloud);
  ss::Pose pose{};
  check_pose(ss::fit_pose(pairs, pose), pose);
  ss::RansacOptions ransac;
  ransac.iterations = 16;
  ransac.inlier_distance = options.byte() < 16 ? options.real() : cloud.radius;
  ransac.edge_similarity = options.byte() < 16 ? options.real() : 0.9f;
  ransac.seed = options.byte();
  std::vector<std::uint32_t> inliers;
  const Status status = ss::estimate_pose(pairs, ransac, pose, inliers);
  check_pose(status, pose);
  require(status == Status::ok ? inliers.size() >= 3 : inliers.empty(), "three that agree, or none");
  for (std::size_t i = 0; i < inliers.size(); ++i) {
    require(inliers[i] < pairs.size() && (i == 0 || inliers[i - 1] < inliers[i]), "ascending numbers of pairs");
    const ss::PointPair& pair = pairs[inliers[i]];
    const float squared = ss::squared_distance(pair.target, ss::transform_point(pose, pair.source));
    require(squared < ransac.inlier_distance * ransac.inlier_distance, "inliers lie near their targets");
  }
}

void check_samples(const fuzz::MadeCloud& made) {
  const ss::CloudView cloud = ss::view_xyz_rgb(made.xyz.data(), made.rgb.data(), made.size());
  std::vector<std::uint32_t> points;
  std::vector<ss::KeyPoint> centroids;
  const Status status = ss::sample_uniform(cloud, made.radius, points);
  require(ss::sample_centroids(cloud, made.radius, centroids) == status, "both can, or none");
  require(points.empty() == (status != Status::ok), "key points, or a status");
  require(points.size() == centroids.size(), "one for each voxel");
  for (std::size_t i = 0; i < points.size(); ++i) {
    require(points[i] < cloud.size && (i == 0 || points[i - 1] < points[i]), "ascending indices");
    require(ss::is_finite(ss::point(cloud, points[i])), "valid points");
  }
  for (const ss::KeyPoint& key : centroids) require(ss::is_finite(key.position) && key.has_color, "valid centroids");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes options(data, size < 6 ? size : 6);
  fuzz::Bytes from(data + (size < 6 ? size : 6), size < 6 ? 0 : size - 6);
  const fuzz::MadeCloud cloud = fuzz::made_cloud(from, 128);
  check_poses(cloud, options);
  check_samples(cloud);
  return 0;
}
