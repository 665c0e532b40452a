// shortshot: short color-shape descriptors (SSH, SCSH) of RGB-D point clouds on small CPUs, and their parents (SHOT,
// CSHOT, B-SHOT).
//
// The umbrella, in reading order. On bare metal it is the kernel: no heap, no exceptions, no operating system. Where
// there is an operating system it adds what allocates: describe_cloud() and extract() for many key points, a grid with
// memory of its own, matching, poses, the recognizer, files.
//
// Two things need another library, included before this header: <nanoflann.hpp> for NanoflannSearch, <Eigen/Core> for
// view_eigen(). Whoever comes too late includes this header once more: what is new is added. Without them, the compiler
// says what is missing where one of the two is used.
//
// Macros of other headers (min, near, Status, ...) do no harm here, whether they come before it or after it. In your
// own code they do what they always do.

// clang-format off
#include "macros_off.hpp"

#include "dispatch/hot_kernel.hpp"
#if !defined(SHORTSHOT_FOR_AVX2)  // the single header reads itself up to here (dispatch/kernel_for_avx2.hpp)
#include "kernel.hpp"
#include "cloud/view_of.hpp"
#include "cloud/view_point_cloud2.hpp"

#if defined(__unix__) || defined(__APPLE__) || defined(_WIN32)
#include "batch/grid_search.hpp"
#include "descriptor/layout_of.hpp"
#include "batch/keypoints.hpp"
#include "batch/estimate_normals.hpp"
#include "batch/estimate_image_normals.hpp"
#include "batch/extract.hpp"
#include "batch/mark_neighbors.hpp"
#include "batch/describe_cloud.hpp"
#include "batch/diagnose.hpp"
#include "batch/frame_agreement.hpp"
#include "batch/suggest.hpp"
#include "batch/copy_point_cloud2.hpp"
#include "batch/to_pcl.hpp"
#include "store/features_file.hpp"
#include "store/stored_features.hpp"
#include "recognition/flash_model_file.hpp"
#include "recognition/match.hpp"
#include "recognition/pose.hpp"
#include "recognition/recognize.hpp"
#include "recognition/recognize_stored.hpp"
#include "recognition/recognizer_model.hpp"
#include "recognition/thin.hpp"
#endif

#if defined(NANOFLANN_VERSION)
#include "search/nanoflann.hpp"
#else
#include "search/nanoflann_missing.hpp"
#endif

#if defined(EIGEN_WORLD_VERSION)
#include "cloud/view_eigen.hpp"
#else
#include "cloud/view_eigen_missing.hpp"
#endif

#endif

#include "macros_on.hpp"
// clang-format on
