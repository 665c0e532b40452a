// The library as the tests see it, and the only place that includes it: the whole suite is compiled a second time
// against the generated single header.
#pragma once

// clang-format off: the umbrella has NanoflannSearch and view_eigen() only where these two were included before it.
#include <Eigen/Core>
#include <nanoflann.hpp>
#ifdef SHORTSHOT_TEST_SINGLE_HEADER
#include "shortshot.hpp"
#else
#include <shortshot/shortshot.hpp>
#endif
// clang-format on
