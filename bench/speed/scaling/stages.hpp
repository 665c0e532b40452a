// Search, frame and kernel of single key points, timed apart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "speed/scaling/frame.hpp"
#include "speed/scaling/measure.hpp"

namespace shortshot_bench::scaling {

/// Key points go through each stage in batches: reading the clock costs as much as a small neighborhood's frame, and
/// what a batch gathers still fits into the second-level cache.
class StageWork {
 public:
  /// `frame` must have run once, so that its index and its neighbors are known.
  StageWork(const ScalingCloud& cloud, const FrameWork& frame, float radius);

  std::size_t keypoints() const { return keypoints_.size(); }

  /// Costs of search, frame and kernel, of all key points that can be described. Throws std::runtime_error if the
  /// library refuses.
  std::vector<Cost> run();
  static std::vector<std::string> series() { return {"search", "local frame", "kernel"}; }

 private:
  static constexpr std::size_t most_in_batch = 64;
  // A few floats more than a power of two, lest all arrays compete for the same cache lines.
  static constexpr std::size_t capacity = 131072 + 48;

  void run_batch(std::size_t begin, std::size_t end, std::vector<Cost>& costs);

  const ScalingCloud& cloud_;
  const shortshot::GridSearch& index_;
  std::vector<std::uint32_t> keypoints_;
  float radius_;
  std::size_t batch_;
  std::vector<shortshot::Lab> lab_;
  std::vector<std::unique_ptr<shortshot::Workspace<capacity>>> workspaces_;
};

}  // namespace shortshot_bench::scaling
