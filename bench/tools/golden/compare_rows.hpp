// Rows of descriptors, as floats, bits and nibbles, against a case's.
#pragma once

#include "case.hpp"
#include "descriptors.hpp"
#include "report.hpp"

namespace shortshot_bench::golden {

// Row by row, in the given frames. How far rows may be off is the descriptor's to say.
void compare_descriptor(const Case& c, const Array& array, const DescriptorOutput& descriptor, Result& result);

// The bits of the reference's own SHOT must be equal. Those of our SHOT may differ in a few rows, where a sum is 90 %
// of its group but for rounding.
void compare_bits(const Case& c, const Array& array, Result& result);

// Every code must be equal, but where the reference's value is within 1e-4 of the border between two codes: there the
// other one will do.
void compare_nibbles(const Case& c, const Array& array, const DescriptorOutput& descriptor, Result& result);

}  // namespace shortshot_bench::golden
