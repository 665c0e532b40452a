#include "tools/picture/viewing.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "shortshot/cloud/read.hpp"
#include "tools/io/view_of_cloud.hpp"

namespace shortshot_bench::picture {
namespace {

using shortshot::Point;

Eigen::Vector3f vector_of(const Point& p) { return {p.x, p.y, p.z}; }

std::vector<Eigen::Vector3f> finite_points(const RgbdCloud& cloud) {
  std::vector<Eigen::Vector3f> points;
  const shortshot::CloudView view = view_of_cloud(cloud);
  for (std::size_t i = 0; i < view.size; ++i) {
    const Point p = shortshot::point(view, i);
    if (shortshot::is_finite(p)) points.push_back(vector_of(p));
  }
  return points;
}

/// Does nearly all of it lie within 60 degrees of the z axis through the eye?
bool lies_before(const Eigen::Vector3f& eye, const std::vector<Eigen::Vector3f>& points) {
  const auto is_seen = [&](const Eigen::Vector3f& p) {
    const Eigen::Vector3f d = p - eye;
    return d.z() > 0.0f && std::hypot(d.x(), d.y()) < 1.7f * d.z();
  };
  const auto seen = static_cast<std::size_t>(std::count_if(points.begin(), points.end(), is_seen));
  return 100 * seen >= 99 * points.size();
}

Viewing along_shortest_axis(const std::vector<Eigen::Vector3f>& points) {
  Viewing viewing;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& p : points) sum += p;
  viewing.eye = sum / static_cast<float>(points.size());
  Eigen::Matrix3f scatter = Eigen::Matrix3f::Zero();
  for (const Eigen::Vector3f& p : points) scatter += (p - viewing.eye) * (p - viewing.eye).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(scatter);
  if (solver.info() != Eigen::Success) return viewing;
  viewing.axes.row(0) = solver.eigenvectors().col(2).transpose();
  viewing.axes.row(1) = solver.eigenvectors().col(1).transpose();
  viewing.axes.row(2) = viewing.axes.row(0).cross(viewing.axes.row(1));
  return viewing;
}

}  // namespace

Projected Viewing::project(const Point& p) const {
  const Eigen::Vector3f q = axes * (vector_of(p) - eye);
  return is_perspective ? Projected{q.x() / q.z(), q.y() / q.z(), q.z()} : Projected{q.x(), q.y(), q.z()};
}

Viewing best_viewing(const RgbdCloud& cloud) {
  const std::vector<Eigen::Vector3f> points = finite_points(cloud);
  const Eigen::Vector3f camera(cloud.viewpoint[0], cloud.viewpoint[1], cloud.viewpoint[2]);
  Viewing viewing;
  if (points.empty()) return viewing;
  if (!lies_before(camera, points)) return along_shortest_axis(points);
  viewing.eye = camera;
  viewing.is_perspective = true;
  return viewing;
}

Viewing from_the_side(const Viewing& viewing, const Point& middle, float degrees) {
  Viewing side;
  const float radians = degrees * 0.017453293f;
  side.axes = Eigen::AngleAxisf(radians, Eigen::Vector3f::UnitY()).toRotationMatrix() * viewing.axes;
  side.eye = vector_of(middle);
  return side;
}

Point middle_of(const RgbdCloud& cloud) {
  const std::vector<Eigen::Vector3f> points = finite_points(cloud);
  float median[3] = {};
  for (int axis = 0; axis < 3 && !points.empty(); ++axis) {
    std::vector<float> values;
    for (const Eigen::Vector3f& p : points) values.push_back(p[axis]);
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    median[axis] = *half;
  }
  return {median[0], median[1], median[2]};
}

}  // namespace shortshot_bench::picture
