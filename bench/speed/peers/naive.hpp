// The published SSH / SCSH rule written down as it stands, in double precision with libm and std::vector: what a
// careful programmer has before any thought of speed. Same numbers as the library, so the like-for-like baseline.
//
// Kind to it: nanoflann's tree with unsorted results (one search per key point, for frame and descriptor), and colors
// converted once per cloud, not once per neighbor.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "shortshot/frame/frame.hpp"
#include "speed/peers/task.hpp"

namespace shortshot_bench::peers {

/// Cells of a grid; with bins, each holds a histogram of color distances instead of a count.
struct NaivePart {
  int radial, elevation, azimuth;
  int bins = 0;

  std::size_t size() const {
    return static_cast<std::size_t>(radial * elevation * azimuth) * static_cast<std::size_t>(bins > 0 ? bins : 1);
  }
};

class Naive {
 public:
  explicit Naive(const Task& task);
  ~Naive();
  Naive(const Naive&) = delete;
  Naive& operator=(const Naive&) = delete;

  /// The point nearest to the center of each voxel of the task's leaf, in ascending order.
  std::vector<std::uint32_t> sample() const;

  void build_tree();      // leaves of 10 points
  void convert_colors();  // to CIELAB
  void release();         // both

  /// Neighbors of a key point, itself included: index and squared distance. Needs the tree.
  using Neighbors = std::vector<std::pair<std::uint32_t, float>>;
  void find_neighbors(std::uint32_t keypoint, Neighbors& neighbors) const;

  /// SHOT's frame; false if there are fewer than five neighbors.
  bool estimate_frame(std::uint32_t keypoint, const Neighbors& neighbors, shortshot::Frame& frame) const;

  /// The parts one after the other, of L2 norm 1. Parts with bins need converted colors.
  void describe(std::uint32_t keypoint, const Neighbors& neighbors, const shortshot::Frame& frame,
                const std::vector<NaivePart>& parts, std::vector<double>& descriptor) const;

 private:
  struct Tree;

  std::array<float, 3> offset(std::uint32_t keypoint, std::uint32_t neighbor) const;

  const Task& task_;
  std::unique_ptr<Tree> tree_;
  std::vector<std::array<double, 3>> lab_;
};

}  // namespace shortshot_bench::peers
