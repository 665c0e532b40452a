// What is wrong with a cloud, a radius and a leaf, in sentences.
#pragma once

#include <string>
#include <vector>

#include "shortshot/shortshot.hpp"
#include "tools/demo/options.hpp"

namespace shortshot_bench {

/// One sentence for each thing that cannot work or hardly will, and what to do about it; none if all is well.
std::vector<std::string> advice_on(const shortshot::Diagnosis& diagnosis, const shortshot::CloudView& cloud,
                                   const DemoOptions& options);

/// Options that fit the cloud's own spacing; empty if it is not known.
std::string fitting_options(const shortshot::Diagnosis& diagnosis);

}  // namespace shortshot_bench
