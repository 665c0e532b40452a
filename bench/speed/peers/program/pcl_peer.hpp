// PCL's descriptors as contenders.
#pragma once

#include "speed/peers/suite.hpp"
#include "speed/peers/task.hpp"

namespace shortshot_bench::peers {

/// SHOTColor and SHOT, each as people call it (the search tree that the normals were made with, sorted results, its own
/// frames) and in the kindest use (frames given, unsorted results); FPFH in the latter. All get normals, whose time
/// counts for the whole frame only.
Suite make_pcl_suite(const Task& task, bool with_fpfh);

}  // namespace shortshot_bench::peers
