// A generated cloud, and what is done with it per camera frame, in memory that is kept from frame to frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "speed/scaling/measure.hpp"
#include "tools/io/require_ok.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::scaling {

/// What is measured, the radius where the curve does not vary it, and the voxels that key points are sampled in.
using Measured = shortshot::Scsh336;
inline constexpr float scaling_radius = 0.04f;
inline constexpr float scaling_leaf = 0.01f;

/// The tabletop scene in a resolution that gives about that many valid points.
struct ScalingCloud {
  explicit ScalingCloud(std::size_t about_points);

  RgbdCloud cloud;
  shortshot::CloudView view;
  std::vector<std::uint32_t> valid;  // indices of the points with a measurement
};

/// `count` of the cloud's valid points, evenly spaced in the image's order.
std::vector<std::uint32_t> spread_keypoints(const ScalingCloud& cloud, std::size_t count);

/// A camera frame from its points on: sampling, index, and descriptors. What is described are not the points sampled
/// but spread_keypoints(): as many as asked for, where there are fewer voxels, too. Memory for the rows that come out
/// is there before anything is measured: it is the caller's, and not counted.
class FrameWork {
 public:
  FrameWork(const ScalingCloud& cloud, std::size_t keypoints, float radius, unsigned threads = 1);

  /// Costs of sampling, index build, extract (Lab of the whole cloud included), and all of it together. Throws
  /// std::runtime_error if the library refuses.
  std::vector<Cost> run(Clock clock);
  static std::vector<std::string> series() { return {"sample", "index build", "extract", "whole frame"}; }

  /// Of the last run: the key points that have a descriptor (a few lone points have no frame), their mean number of
  /// neighbors, and the most neighbors of any key point.
  std::vector<std::uint32_t> described() const;
  double mean_neighbors() const;
  std::uint32_t most_neighbors() const;
  const shortshot::GridSearch& index() const { return index_; }

 private:
  const ScalingCloud& cloud_;
  std::vector<std::uint32_t> keypoints_;
  float radius_;
  unsigned threads_;
  shortshot::KeypointSampler sampler_;
  std::vector<std::uint32_t> sampled_;
  shortshot::GridSearch index_;
  shortshot::Extractor<Measured> extractor_;
  shortshot::Features<Measured> features_;
};

}  // namespace shortshot_bench::scaling
