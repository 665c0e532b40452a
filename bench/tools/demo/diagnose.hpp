// What the library sees of a cloud, a radius and a leaf: --diagnose.
#pragma once

#include "shortshot/shortshot.hpp"
#include "tools/demo/options.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

/// What the library sees of a cloud with these options.
shortshot::Diagnosis diagnosis_of(const RgbdCloud& cloud, const DemoOptions& options);

/// Prints what the library sees and what to do about it; true if there is nothing to be done.
bool print_diagnosis(const RgbdCloud& cloud, const DemoOptions& options);

}  // namespace shortshot_bench
