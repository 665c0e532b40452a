// shortshot: short color-shape descriptors (SSH, SCSH) of RGB-D point clouds on small CPUs, and their parents (SHOT,
// CSHOT, B-SHOT).
//
// The umbrella. On bare metal it is the kernel: no heap, no exceptions, no operating system. Where there is an
// operating system it adds what allocates: extract() for many key points, sampling, a grid with memory of its own.
// Include <nanoflann.hpp> BEFORE it and NanoflannSearch is there as well; with <Eigen/Core>, view_eigen(), and on an
// operating system matching, poses and the recognizer.
#pragma once

#include "cloud/view_of.hpp"
#include "cloud/view_point_cloud2.hpp"
#include "kernel.hpp"

#if defined(__unix__) || defined(__APPLE__) || defined(_WIN32)
#include "batch/estimate_normals.hpp"
#include "batch/extract.hpp"
#include "batch/keypoints.hpp"
#include "batch/to_pcl.hpp"
#include "descriptor/layout_text.hpp"
#include "recognition/descriptor_rows.hpp"
#include "search/grid_search.hpp"
#if defined(EIGEN_WORLD_VERSION)
#include "recognition/match.hpp"
#include "recognition/pose.hpp"
#include "recognition/recognize.hpp"
#include "recognition/recognizer_model.hpp"
#endif
#endif

#if defined(NANOFLANN_VERSION)
#include "search/nanoflann.hpp"
#endif

#if defined(EIGEN_WORLD_VERSION)
#include "cloud/view_eigen.hpp"
#endif
