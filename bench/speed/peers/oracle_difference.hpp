// How far descriptors are from the tests' oracle, which computes them in double precision.
#pragma once

#include <cstddef>
#include <vector>

#include "speed/peers/task.hpp"

namespace shortshot_bench::peers {

class OracleDescriptors {
 public:
  enum class Kind { ssh32, scsh336 };

  /// In the library's own frames, which the oracle is given.
  OracleDescriptors(const Task& task, Kind kind);

  /// Has key point `row` a frame, and lies none of its neighbors within 1e-5 cells of a place where the voting rule
  /// jumps: the border or the middle of a cell? Rounding decides there, and either side is right.
  bool is_clear(std::size_t row) const { return !expected_[row].empty(); }
  std::size_t clear_keypoints() const;

  /// The largest difference of any value, over the clear key points. `rows` holds one descriptor per key point.
  double largest_difference(const float* rows) const;

 private:
  std::vector<std::vector<double>> expected_;  // one per key point; empty where it is not clear
};

}  // namespace shortshot_bench::peers
