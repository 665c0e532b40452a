#include "open3d_peer.hpp"

#include <omp.h>
#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/Feature.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace shortshot_bench::peers {
namespace {

namespace geometry = open3d::geometry;
namespace registration = open3d::pipelines::registration;

geometry::PointCloud cloud_of(const RgbdCloud& points) {
  geometry::PointCloud cloud;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float* const p = points.xyz.data() + 3 * i;
    const auto* const c = points.rgb.data() + 3 * i;
    cloud.points_.emplace_back(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
    cloud.colors_.emplace_back(c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
  }
  return cloud;
}

struct State {
  explicit State(const Task& task) : cloud(cloud_of(task.points)) {}

  geometry::PointCloud cloud;
  std::shared_ptr<geometry::PointCloud> sampled;
  std::shared_ptr<registration::Feature> features;

  std::size_t sample(double leaf) {
    sampled = cloud.VoxelDownSample(leaf);
    return sampled->points_.size();
  }
  void estimate_normals(double leaf) { sampled->EstimateNormals(geometry::KDTreeSearchParamHybrid(2.0 * leaf, 30)); }
  void describe(double leaf) {
    features = registration::ComputeFPFHFeature(*sampled, geometry::KDTreeSearchParamHybrid(5.0 * leaf, 100));
  }
  void release() {
    sampled.reset();
    features.reset();
  }

  /// The smallest voxels, but for a percent, that leave so many points or fewer.
  double leaf_for(std::size_t points, double leaf) {
    double too_small = leaf;
    while (sample(leaf) > points) {
      too_small = leaf;
      leaf *= 2.0;
    }
    while (leaf > 1.01 * too_small) {
      const double middle = 0.5 * (too_small + leaf);
      (sample(middle) > points ? too_small : leaf) = middle;
    }
    return leaf;
  }
};

/// One frame with its steps. Returns the one that samples.
std::size_t add_frame(Suite& suite, const std::shared_ptr<State>& state, const std::string& which, double leaf,
                      const std::string& search) {
  Contender contender{"Open3D FPFH" + which, "FPFH-33", {}, search};
  contender.made = state->sample(leaf);
  const std::size_t sample = suite.add("voxel_down_sample" + which, [=] { state->sample(leaf); });
  contender.frame = {sample, suite.add("normals" + which, [=] { state->estimate_normals(leaf); })};
  contender.describe = suite.add("FPFH" + which, [=] { state->describe(leaf); });
  contender.frame.push_back(contender.describe);
  contender.output_bytes = contender.made * 33 * sizeof(double);
  contender.against = {"ShapeColor95", "ShapeColor32", "HeightShape96", "SSH-32", "SCSH-336"};
  suite.contenders.push_back(contender);
  return sample;
}

}  // namespace

Suite make_open3d_suite(const Task& task) {
  setenv("OMP_NUM_THREADS", "1", 1);  // Open3D asks whether it is set,
  omp_set_num_threads(1);             // and the library that read it before we were here for its value
  const auto state = std::make_shared<State>(task);
  const auto leaf = static_cast<double>(task.leaf);
  Suite suite{"Open3D"};
  suite.release = [state] { state->release(); };
  const std::size_t sample = add_frame(suite, state, "", leaf, "nanoflann");
  Contender sampling{"Open3D voxel_down_sample", key_points_made, {}, "voxels"};
  sampling.against = {key_points_made};
  suite.add_maker(sampling, sample, suite.contenders.front().made, 6 * sizeof(double));
  add_frame(suite, state, ", as many points", state->leaf_for(task.keypoints.size(), leaf), "nanoflann");
  return suite;
}

}  // namespace shortshot_bench::peers
