// PCL's key points, normals and descriptors as contenders.
#pragma once

#include "speed/peers/suite.hpp"
#include "speed/peers/task.hpp"

namespace shortshot_bench::peers {

/// SHOTColor and SHOT, each as people call it (the search tree that the normals were made with, sorted results, its own
/// frames), in the kindest use (frames given, unsorted results), and on images with IntegralImageNormalEstimation's
/// normals; FPFH in the kindest use. All get normals, whose time counts for the whole frame only, as does VoxelGrid's,
/// which samples; all get the task's key points nevertheless. VoxelGrid and the estimations of normals by themselves,
/// too.
Suite make_pcl_suite(const Task& task, bool with_fpfh);

}  // namespace shortshot_bench::peers
