// Runs the suites over one cloud and sums up what was measured.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "speed/peers/suite.hpp"
#include "speed/peers/task.hpp"

namespace shortshot_bench::peers {

struct MeasuredStep {
  double ms = 0.0;  // median
  std::size_t kept = 0;
  std::size_t taken = 0;
};

struct MeasuredContender {
  Contender what{};
  double us_per_keypoint = 0.0;  // or for each of what else is made
  double frame_ms = 0.0;
  std::size_t peak_bytes = 0;  // of a whole frame, without the descriptors themselves
  std::size_t kept = 0;        // samples, of `taken`, of the step that describes
  std::size_t taken = 0;
};

struct CloudResult {
  std::string cloud;
  std::size_t points = 0;
  std::size_t keypoints = 0;
  double radius = 0.0;
  double leaf = 0.0;
  double mean_neighbors = 0.0;
  std::vector<MeasuredContender> contenders{};
  std::map<std::string, MeasuredStep> steps{};  // "SUITE: STEP"
  std::size_t kept = 0;                         // samples of all steps
  std::size_t taken = 0;
  std::map<std::string, double> oracle_difference{};  // by build: the largest one, over the key points that are clear
  std::size_t clear_keypoints = 0;
};

/// Gives the peak of the memory that the work needs, in bytes.
using MeasurePeak = std::function<std::size_t(const std::function<void()>& work)>;

/// Memory first, which also warms everything up; then `rounds` rounds of all steps of all suites, interleaved. A step
/// that takes longer than 3 s is not repeated after its first time.
CloudResult measure(const Task& task, const std::vector<Suite>& suites, int rounds, const MeasurePeak& measure_peak);

}  // namespace shortshot_bench::peers
