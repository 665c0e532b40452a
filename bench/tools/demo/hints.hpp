// What to try next, where what comes of a cloud says that something is probably not meant so.
#pragma once

#include <string>
#include <vector>

#include "tools/demo/options.hpp"
#include "tools/demo/run.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

/// What diagnose() has to say where most key points have no descriptor, or one of them has all points as neighbors.
std::vector<std::string> hints(const RgbdCloud& cloud, const DemoOptions& options, const DemoResult& result);

}  // namespace shortshot_bench
