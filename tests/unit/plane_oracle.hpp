// The plane through a point's neighbors by principal components in double precision (Eigen), and how far float may
// be from it.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fixtures.hpp"

namespace unit {

struct OraclePlane {
  std::size_t members = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double bound = 0.0;  // on the sine of the angle
};

inline OraclePlane oracle_plane(const TestCloud& cloud, std::size_t index, ss::Radius radius) {
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(cloud.at(index), radius, n) == ss::Status::ok);
  OraclePlane plane;
  plane.members = n.size;
  if (n.size < 3) return plane;
  Eigen::Matrix3Xd offsets(3, n.size);
  for (Eigen::Index k = 0; k < offsets.cols(); ++k) {
    offsets.col(k) = Eigen::Vector3f(n.dx[k], n.dy[k], n.dz[k]).cast<double>();
  }
  const Eigen::Matrix3Xd centered = offsets.colwise() - offsets.rowwise().mean();
  const Eigen::Matrix3d scatter = centered * centered.transpose();
  // Only the ratios of eigenvalues matter: of 1e-38 square meters, too.
  const double trace = scatter.trace();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter / trace);
  plane.normal = solver.eigenvectors().col(0);
  // First-order perturbation: what may be wrong with the matrix over the gap of its eigenvalues. A term is wrong by up
  // to 2^-21 of the radius squared, the mean of all is at least a 16th of that: 7.6e-6 if all erred to the same side, a
  // quarter of it at most because they do not.
  const double size = offsets.colwise().squaredNorm().sum() / trace;
  plane.bound = 2e-6 * size / (solver.eigenvalues()[1] - solver.eigenvalues()[0]);
  return plane;
}

inline Eigen::Vector3d to_double(const ss::SurfaceNormal& n) { return Eigen::Vector3f(n.x, n.y, n.z).cast<double>(); }

inline void require_normal(const ss::SurfaceNormal& normal, const OraclePlane& oracle) {
  const Eigen::Vector3d n = to_double(normal);
  REQUIRE(std::abs(n.norm() - 1.0) < 1e-6);
  REQUIRE(n.cross(oracle.normal).norm() <= oracle.bound);
}

}  // namespace unit
