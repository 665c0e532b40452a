// What benchmarks of single stages work on: a cloud with normals, key points, and each one's neighborhood and frame,
// made beforehand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "shortshot/cloud/cloud.hpp"
#include "shortshot/frame/frame.hpp"
#include "shortshot/kernel/describe_at.hpp"
#include "shortshot/search/neighborhood.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

struct WorkloadOptions {
  float radius = 0.04f;         // of the support, in the cloud's unit (meters)
  float leaf = 0.02f;           // voxel size of the uniform key points, in the same unit
  std::size_t keypoints = 100;  // at most, spread evenly over the sampled ones
};

/// Memory for one neighborhood of up to `capacity` neighbors.
class NeighborhoodMemory {
 public:
  explicit NeighborhoodMemory(std::uint32_t capacity);
  shortshot::Neighborhood empty() const;

 private:
  std::unique_ptr<float[]> floats_;
  std::unique_ptr<std::uint32_t[]> index_;
  std::uint32_t capacity_;
};

/// A key point as the frame and the kernel find it.
struct GatheredKeyPoint {
  shortshot::KeyPoint key;
  NeighborhoodMemory memory;
  shortshot::Neighborhood neighborhood;
  shortshot::Frame frame;
};

struct Workload {
  RgbdCloud cloud;
  float radius = 0.0f;
  float leaf = 0.0f;                              // of the sampled key points
  float frame_leaf = 0.0f;                        // half of it: of the sampling that a whole frame begins with
  float normal_radius = 0.0f;                     // a quarter of the radius
  std::vector<shortshot::SurfaceNormal> normals;  // one per point, towards the camera
  std::size_t normal_neighbors = 0;               // of all valid points together, within that radius
  std::vector<std::uint32_t> sampled;             // key points by uniform sampling: what extract() is given
  std::size_t sampled_neighbors = 0;              // of them all together
  std::vector<GatheredKeyPoint> chosen;           // some of them, so few that their neighborhoods stay in the cache
  std::size_t chosen_neighbors = 0;               // of these all together
  std::uint32_t most_neighbors = 0;               // of one of these

  shortshot::CloudView view() const;  // with normals
};

/// Key points without a frame or, for want of normals, without SHOT are not chosen. Throws std::runtime_error with the
/// library's own message where the cloud, the radius or the leaf cannot be used, or if no key point is left.
Workload make_workload(RgbdCloud cloud, const WorkloadOptions& options);

}  // namespace shortshot_bench
