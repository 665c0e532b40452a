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

/// What is suggested, as options; empty if nothing is.
std::string fitting_options(const shortshot::Suggestion& suggested);

}  // namespace shortshot_bench
