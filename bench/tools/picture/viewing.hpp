// From where a cloud is looked at.
#pragma once

#include <Eigen/Core>

#include "shortshot/cloud/cloud.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::picture {

/// Where a point is on a picture plane, in lengths of it, downwards and to the right, and how far away.
struct Projected {
  float u, v, depth;
};

struct Viewing {
  Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();  // rows: to the right, down, away from the viewer
  Eigen::Vector3f eye = Eigen::Vector3f::Zero();
  bool is_perspective = false;  // u and v are then for a depth of 1; points behind the eye have a negative depth

  Projected project(const shortshot::Point& p) const;
};

/// As its camera saw it, if the cloud lies before a camera at its viewpoint, z forward; any other cloud along its
/// shortest principal axis, its longest one to the right.
Viewing best_viewing(const RgbdCloud& cloud);

/// From the side, without perspective: turned about the vertical of `viewing` through a place.
Viewing from_the_side(const Viewing& viewing, const shortshot::Point& middle, float degrees);

/// The median of each coordinate of the finite points; zeros of none.
shortshot::Point middle_of(const RgbdCloud& cloud);

}  // namespace shortshot_bench::picture
