// What to try next, where the numbers say that something is probably not meant so.
#pragma once

#include <string>

#include "tools/demo/options.hpp"
#include "tools/demo/run.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

/// Where most key points have too few neighbors, or all points are within one radius: the cloud's extent, and that its
/// unit may be another than that of the radius. Else empty.
std::string hint_at_units(const RgbdCloud& cloud, const DemoOptions& options, const DemoResult& result);

}  // namespace shortshot_bench
