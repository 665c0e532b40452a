// The true motions of the data sets.
#pragma once

#include <array>
#include <string>

namespace shortshot_bench::datasets {

/// p -> R p + t as a 4 x 4 matrix, row-major, meters.
using RigidMotion = std::array<double, 16>;

/// From a text file of four rows. Throws InputError for what is no rigid motion: R^T R differs from 1 by more than 0.01
/// anywhere, R is a mirror image, or the last row is not 0 0 0 1. What is accepted stays as it is.
RigidMotion read_rigid_motion(const std::string& path);

/// From the one camera's coordinates to the other's; both poses lead from the camera to the world.
RigidMotion motion_between(const RigidMotion& from_pose, const RigidMotion& to_pose);

/// The angle of R, 0 to 180.
double rotation_degrees(const RigidMotion& motion);

}  // namespace shortshot_bench::datasets
