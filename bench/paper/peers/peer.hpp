// What the programs of this folder have in common: the question that they are asked, see paper/peer_program.hpp, and
// the answer.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace shortshot_bench::paper {

/// A cloud whose key points are to be described.
struct PeerQuestion {
  double radius = 0.0;           // of the support, meters
  std::vector<float> points;     // x y z and the normal's x y z of each: those that have a normal
  std::vector<float> keypoints;  // x y z of each

  std::size_t size() const { return points.size() / 6; }
  const float* point(std::size_t i) const { return points.data() + 6 * i; }
  const float* normal(std::size_t i) const { return point(i) + 3; }
  std::size_t keypoint_count() const { return keypoints.size() / 3; }
  const float* keypoint(std::size_t i) const { return keypoints.data() + 3 * i; }
};

/// Rows of `size` floats, one for each key point; NaN where there is none.
struct PeerAnswer {
  std::size_t size = 0;
  std::vector<float> values{};
};

/// Reads and writes the files that the two arguments name, and times on its thread's clock describe() of the cloud,
/// which is averaged in voxels of a tenth of the radius first. Returns what main() does.
int answer_as_peer(int argc, char** argv, const std::function<PeerAnswer(const PeerQuestion&)>& describe);

}  // namespace shortshot_bench::paper
