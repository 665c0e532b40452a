// The library with what needs Eigen: matching, poses, the recognizer.
#pragma once

// clang-format off: the umbrella has them only where Eigen was included before it.
#include <Eigen/Core>

#include "shortshot/shortshot.hpp"
// clang-format on
