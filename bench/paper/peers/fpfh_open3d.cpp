// Open3D's FPFH. It describes all points of a cloud and knows no key points: a key point has the row of the point that
// is nearest to it. Both steps reach as far as the radius of the others' support, without a limit of neighbors.
#include <omp.h>
#include <open3d/geometry/KDTreeFlann.h>
#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/Feature.h>

#include <cstdlib>
#include <limits>

#include "peer.hpp"

namespace {

using namespace shortshot_bench::paper;
namespace geometry = open3d::geometry;

Eigen::Vector3d vector_of(const float* p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

PeerAnswer describe(const PeerQuestion& question) {
  geometry::PointCloud cloud;
  for (std::size_t i = 0; i < question.size(); ++i) {
    cloud.points_.push_back(vector_of(question.point(i)));
    cloud.normals_.push_back(vector_of(question.normal(i)));
  }
  const auto features =
      open3d::pipelines::registration::ComputeFPFHFeature(cloud, geometry::KDTreeSearchParamRadius(question.radius));
  const geometry::KDTreeFlann tree(cloud);
  PeerAnswer answer{static_cast<std::size_t>(features->Dimension())};
  for (std::size_t i = 0; i < question.keypoint_count(); ++i) {
    std::vector<int> nearest;
    std::vector<double> squared;
    const bool found = tree.SearchKNN(vector_of(question.keypoint(i)), 1, nearest, squared) == 1;
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(answer.size); ++k) {
      answer.values.push_back(found ? static_cast<float>(features->data_(k, nearest[0]))
                                    : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return answer;
}

}  // namespace

int main(int argc, char** argv) {
  setenv("OMP_NUM_THREADS", "1", 1);  // Open3D asks whether it is set,
  omp_set_num_threads(1);             // and the library that read it before we were here for its value
  return answer_as_peer(argc, argv, describe);
}
