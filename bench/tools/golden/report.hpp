// What a comparison found: one Result per array, one Report per case.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace shortshot_bench::golden {

// A row beyond tolerance, or one that would be without an explanation.
struct Deviation {
  std::size_t row;
  std::string what;
};

struct Result {
  std::string array;
  std::size_t rows = 0;
  double largest = 0.0;     // absolute difference of one value
  double largest_l2 = 0.0;  // L2 norm of the difference of one row
  std::size_t beyond = 0;   // rows beyond tolerance; a share of them may be allowed
  bool broken = false;
  bool explained = false;  // not broken, because there is a cause for the rows beyond tolerance
  std::string note;        // with the verdict; why the array could not be checked if rows is 0
  std::vector<Deviation> deviations;

  void add_difference(double absolute, double l2) {
    largest = std::max(largest, absolute);
    largest_l2 = std::max(largest_l2, l2);
  }
  void add_deviation(std::size_t row, const std::string& what) {
    ++beyond;
    deviations.push_back({row, what});
  }
};

struct Report {
  std::vector<Result> results;         // arrays that can be checked, given the folder has what it takes
  std::vector<std::string> unchecked;  // names of arrays that are unknown or belong to later descriptors

  bool is_broken() const {
    return std::any_of(results.begin(), results.end(), [](const Result& r) { return r.broken; });
  }
  bool is_empty() const {
    return std::all_of(results.begin(), results.end(), [](const Result& r) { return r.rows == 0; });
  }
};

}  // namespace shortshot_bench::golden
