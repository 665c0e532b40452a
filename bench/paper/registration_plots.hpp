// What the report on registration shows of a data set as plots.
#pragma once

#include <string>
#include <vector>

#include "paper/registration_set.hpp"

namespace shortshot_bench::paper {

/// Draws into the folder and returns the files' names, which begin with `prefix`: recall over 1 - precision, and
/// registration recall of each descriptor.
std::vector<std::string> draw_registration(const RegistrationSet& set, const std::string& prefix,
                                           const std::string& directory);

}  // namespace shortshot_bench::paper
