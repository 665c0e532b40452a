// One cloud through the whole pipeline: key points, normals, index, descriptors; with times and counts.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shortshot/cloud/cloud.hpp"
#include "shortshot/status.hpp"
#include "tools/demo/options.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench {

class Stopwatch {
 public:
  double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// What came out, whatever the descriptor.
struct DemoResult {
  std::vector<std::uint32_t> keypoints;
  std::vector<float> values;  // one row of `size` floats per key point
  std::vector<shortshot::Status> status;
  std::vector<std::uint32_t> neighbors;
  std::vector<shortshot::SurfaceNormal> normals;  // one per point, or none if the descriptor needs none
  bool normals_of_file = false;                   // and not estimated
  std::size_t size = 0;
  std::vector<std::string> layout;  // one line per part
  double sample_ms = 0.0;
  double normals_ms = 0.0;  // with an index for them
  double index_ms = 0.0;
  double describe_ms = 0.0;
};

/// Of the normals that shot352 and cshot1344 need.
float normal_radius(const DemoOptions& options);

/// Throws std::runtime_error with the library's own message where it returns a status for the whole cloud.
DemoResult run_demo(const RgbdCloud& cloud, const DemoOptions& options);

/// Runs all searches and several numbers of threads; prints a line for each; true if all results are the same bits.
bool check_searches(const RgbdCloud& cloud, const DemoOptions& options);

}  // namespace shortshot_bench
