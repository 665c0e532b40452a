// Points that are no measurements: (0, 0, 0), and many in one place.
#pragma once

#include <cstddef>

#include "rgbd_cloud.hpp"

namespace shortshot_bench {

/// How many points of the file are (0, 0, 0), which is what some sensors write where they have measured nothing.
std::size_t count_zeros(const RgbdCloud& cloud);

/// Makes them points that are not measured, NaN, and says so in a note; returns how many.
std::size_t drop_zeros(RgbdCloud& cloud);

/// Adds a note where there are points of (0, 0, 0), and one where many others share their place with another point.
void note_repeated_points(RgbdCloud& cloud);

}  // namespace shortshot_bench
