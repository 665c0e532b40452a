#include "paper/datasets/rigid_motion.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <vector>

#include "tools/io/input_error.hpp"
#include "tools/io/matrix_file.hpp"

namespace shortshot_bench::datasets {
namespace {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Eigen::Map<const Matrix4> matrix_of(const RigidMotion& motion) { return Eigen::Map<const Matrix4>(motion.data()); }

}  // namespace

RigidMotion read_rigid_motion(const std::string& path) {
  const std::vector<double> values = read_matrix(path, 4, 4, "a rigid motion");
  RigidMotion motion;
  std::copy(values.begin(), values.end(), motion.begin());
  constexpr double tolerance = 1e-2;
  const Eigen::Matrix3d rotation = matrix_of(motion).topLeftCorner<3, 3>();
  const double deviation = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation <= tolerance)) {
    throw InputError::about(path, "expected a rotation R, found R^T R off 1 by " + std::to_string(deviation));
  }
  if (rotation.determinant() < 0.0) throw InputError::about(path, "expected a rotation, found a mirror image");
  if (matrix_of(motion).row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
    throw InputError::about(path, "expected 0 0 0 1 as the last row, found another");
  }
  return motion;
}

RigidMotion motion_between(const RigidMotion& from_pose, const RigidMotion& to_pose) {
  RigidMotion motion;
  // The general inverse: a pose's R is a rotation only up to what its file rounds.
  Eigen::Map<Matrix4>(motion.data()) = matrix_of(to_pose).inverse() * matrix_of(from_pose);
  return motion;
}

double rotation_degrees(const RigidMotion& motion) {
  constexpr double degrees_per_radian = 57.295779513082321;
  const Eigen::Matrix3d rotation = matrix_of(motion).topLeftCorner<3, 3>();
  return Eigen::AngleAxisd(rotation).angle() * degrees_per_radian;
}

}  // namespace shortshot_bench::datasets
