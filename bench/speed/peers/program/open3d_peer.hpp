// Open3D's key points and FPFH as contenders.
#pragma once

#include "speed/peers/suite.hpp"
#include "speed/peers/task.hpp"

namespace shortshot_bench::peers {

/// As Open3D's tutorial of registration calls it: voxel_down_sample, normals of what is left in two voxels (30
/// neighbors at most), ComputeFPFHFeature in five (100 at most). It knows no key points, but describes all that is
/// left: once with the task's voxels, and once with voxels so large that no more than the task's key points are left.
/// On one thread, for which it sets OMP_NUM_THREADS.
Suite make_open3d_suite(const Task& task);

}  // namespace shortshot_bench::peers
