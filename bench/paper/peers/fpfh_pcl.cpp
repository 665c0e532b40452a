// PCL's FPFH of key points anywhere: simple histograms of all points near one, and their mean, weighted by distance.
// Each of the two steps reaches as far as the radius of the others' support: a row depends on points up to twice as far
// away.
#include <pcl/console/print.h>
#include <pcl/features/fpfh.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <algorithm>

#include "peer.hpp"

namespace {

using namespace shortshot_bench::paper;

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Tree = pcl::search::KdTree<pcl::PointXYZ>;

PeerAnswer describe(const PeerQuestion& question) {
  const Cloud::Ptr surface(new Cloud), keypoints(new Cloud);
  const pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  for (std::size_t i = 0; i < question.size(); ++i) {
    const float* const p = question.point(i);
    const float* const n = question.normal(i);
    surface->push_back({p[0], p[1], p[2]});
    normals->push_back({n[0], n[1], n[2]});
  }
  for (std::size_t i = 0; i < question.keypoint_count(); ++i) {
    const float* const k = question.keypoint(i);
    keypoints->push_back({k[0], k[1], k[2]});
  }
  pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33> estimation;
  estimation.setInputCloud(keypoints);
  estimation.setSearchSurface(surface);
  estimation.setInputNormals(normals);
  estimation.setSearchMethod(Tree::Ptr(new Tree(false)));
  estimation.setRadiusSearch(question.radius);
  pcl::PointCloud<pcl::FPFHSignature33> rows;
  estimation.compute(rows);
  PeerAnswer answer{33};
  for (const pcl::FPFHSignature33& row : rows) {
    answer.values.insert(answer.values.end(), std::begin(row.histogram), std::end(row.histogram));
  }
  return answer;
}

}  // namespace

int main(int argc, char** argv) {
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
  return answer_as_peer(argc, argv, describe);
}
