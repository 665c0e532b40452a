// The library against the golden vectors of one case.
#pragma once

#include "case.hpp"
#include "report.hpp"

namespace shortshot_bench::golden {

// Neighbor counts must be equal; descriptors are made with the given frames. A row without numbers in the
// reference asks for a status and zeros. Tolerances stand in compare.cpp and frames.hpp.
Report compare(const Case& c);

}  // namespace shortshot_bench::golden
