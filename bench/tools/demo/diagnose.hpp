// What is wrong with a cloud, a radius and a leaf, in sentences: --diagnose.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "shortshot/cloud/cloud.hpp"
#include "shortshot/shortshot.hpp"
#include "tools/demo/options.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

/// One sentence for each thing that cannot work or hardly will, and what to do about it; none if all is well.
std::vector<std::string> advice_on(const shortshot::Diagnosis& diagnosis, const shortshot::CloudView& cloud,
                                   const DemoOptions& options);

/// Options that fit the cloud's own spacing; empty if it is not known.
std::string fitting_options(const shortshot::Diagnosis& diagnosis);

/// Share of the key points whose local frames from the even and from the odd points of the cloud have axes less than 20
/// degrees apart; negative if there are none to compare.
float frame_agreement(const shortshot::CloudView& cloud, float radius, float leaf,
                      const shortshot::Viewpoint& viewpoint);

/// Prints what the library sees and what to do about it; true if there is nothing to be done.
bool print_diagnosis(const RgbdCloud& cloud, const DemoOptions& options);

}  // namespace shortshot_bench
