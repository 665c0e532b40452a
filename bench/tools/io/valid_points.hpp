// A cloud without what was not measured.
#pragma once

#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

/// The finite points of a cloud with colors, and these, as one row.
RgbdCloud valid_points(const RgbdCloud& cloud);

}  // namespace shortshot_bench
