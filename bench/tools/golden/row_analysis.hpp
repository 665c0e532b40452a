// Why two rows of a descriptor differ where its votes jump: which neighbors lie within rounding of a border, and
// whether that can make all the difference. Worked out by the tests' oracle, in double and apart from the library.
#pragma once

#include <cstddef>
#include <string>

#include "case.hpp"
#include "descriptors.hpp"

namespace shortshot_bench::golden {

// Neighbors within rounding of a border: of shells, of cells in elevation, in azimuth, of bins. (Middles of cells count
// as borders: votes for partners jump there.)
inline constexpr std::size_t border_kinds = 4;

struct BorderCounts {
  std::size_t of[border_kinds] = {};

  void add(const BorderCounts& other);
  std::string text() const;  // "at a border: 2 shell, 1 azimuth", or nothing
};

struct RowAnalysis {
  bool explains = false;  // each value of both rows is one that these neighbors' votes on either side can make
  BorderCounts at_border;
};

// Both rows are of the key point `row`, of as many values as the descriptor has, which is not a continuous one.
RowAnalysis analyze_row(const Case& c, std::size_t row, const DescriptorOutput& descriptor, const float* ours,
                        const float* reference);

}  // namespace shortshot_bench::golden
