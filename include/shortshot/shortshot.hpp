// shortshot: short colour-shape descriptors (SSH, SCSH) of RGB-D point clouds on small CPUs, and their parents (SHOT,
// CSHOT, B-SHOT).
//
// The umbrella. On bare metal it is the kernel: no heap, no exceptions, no operating system. Where there is an
// operating system it adds what allocates: extract() for many key points, sampling, a grid with memory of its own,
// matching, poses and the recognizer. Include <nanoflann.hpp> BEFORE it and NanoflannSearch is there as well; with
// <Eigen/Core>, view_eigen().
#pragma once

#include "adapters/point_cloud2.hpp"
#include "adapters/structs.hpp"
#include "kernel.hpp"

#if defined(__unix__) || defined(__APPLE__) || defined(_WIN32)
#include "adapters/pcl.hpp"
#include "estimate_normals.hpp"
#include "extract.hpp"
#include "layout.hpp"
#include "match.hpp"
#include "pose.hpp"
#include "recognizer.hpp"
#include "recognizer_model.hpp"
#include "rows.hpp"
#include "sample.hpp"
#include "search/grid_hosted.hpp"
#endif

#if defined(NANOFLANN_VERSION)
#include "search/nanoflann.hpp"
#endif

#if defined(EIGEN_WORLD_VERSION)
#include "adapters/eigen.hpp"
#endif
