// Are two local reference frames of one neighborhood the same, and if not, does the neighborhood excuse it?
#pragma once

#include "shortshot/frame/frame.hpp"
#include "shortshot/search/neighborhood.hpp"
#include "shortshot/status.hpp"

namespace shortshot_bench::golden {

// Why two right implementations may give different frames.
enum class Cause {
  none,               // they may not
  tie,                // rounding decides the vote over a sign
  planar,             // all neighbors lie at z = 0: no vote over the sign of z
  collinear,          // all neighbors lie on the x axis: any y and z will do
  equal_eigenvalues,  // two axes can be turned in their plane at no cost
};

inline constexpr int cause_count = static_cast<int>(Cause::equal_eigenvalues) + 1;

const char* name_of(Cause cause);

inline constexpr double max_angle_degrees = 0.1;

struct FrameComparison {
  double angle_degrees;  // largest of the three axes; infinite if one side has no frame
  bool agrees;           // angle within max_angle_degrees, or no frame on either side
  Cause cause;           // of the disagreement
};

// `reference` has nine floats, rows x, y, z; NaN where there is no frame. `n` holds at least all neighbors
// within `radius`.
FrameComparison compare_frames(const shortshot::Neighborhood& n, shortshot::Radius radius, shortshot::Status status,
                               const shortshot::Frame& ours, const float* reference);

}  // namespace shortshot_bench::golden
