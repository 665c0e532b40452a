// What the library sees of a cloud, a radius and a leaf: --diagnose.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "shortshot/cloud/cloud.hpp"
#include "shortshot/shortshot.hpp"
#include "tools/demo/options.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

/// Share of the key points whose local frames from the even and from the odd points of the cloud have axes less than 20
/// degrees apart; negative if there are none to compare.
float frame_agreement(const shortshot::CloudView& cloud, float radius, float leaf,
                      const shortshot::Viewpoint& viewpoint);

/// What the library sees of a cloud with these options.
shortshot::Diagnosis diagnosis_of(const RgbdCloud& cloud, const DemoOptions& options);

/// Prints what the library sees and what to do about it; true if there is nothing to be done.
bool print_diagnosis(const RgbdCloud& cloud, const DemoOptions& options);

}  // namespace shortshot_bench
