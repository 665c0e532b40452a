// The umbrella comes first, by way of somebody else's header; Eigen and nanoflann come later; then the umbrella again.
#include HEADER

#include <Eigen/Core>
#include <nanoflann.hpp>

#include HEADER

int main() {
  const Eigen::Matrix3Xf points = Eigen::Matrix3Xf::Random(3, 100);
  const shortshot::CloudView cloud = shortshot::view_eigen(points);
  const shortshot::NanoflannSearch search(cloud);
  return search.status() == shortshot::Status::ok && search.cloud_size() == 100 ? 0 : 1;
}
