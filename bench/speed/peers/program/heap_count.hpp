// How much memory a piece of work needs at its peak, beyond what was there: malloc and its kin, of all libraries of the
// program, as the C library rounds them.
#pragma once

#include <cstddef>

namespace shortshot_bench::peers {

void start_counting_heap();

/// The peak since start_counting_heap(), in bytes. Counting ends.
std::size_t peak_heap_bytes();

}  // namespace shortshot_bench::peers
