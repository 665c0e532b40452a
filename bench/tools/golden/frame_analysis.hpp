// What a neighborhood determines of its local reference frame, worked out in double and apart from the
// library.
#pragma once

#include "shortshot/search/neighborhood.hpp"

namespace shortshot_bench::golden {

// How well one axis, x or z, is determined.
struct AxisAnalysis {
  double gap;      // from its eigenvalue to the middle one, over the largest
  double slack;    // how far float rounding may turn it, radians
  bool open_vote;  // float rounding may give its sign either way
  bool no_vote;    // all neighbors are within rounding of the plane across it
};

struct FrameAnalysis {
  AxisAnalysis x, z;
  bool collinear;  // the neighbors spread along x only
};

// Rule: golden README, "SHOT local reference frame". The neighborhood must have a point besides the key
// point.
FrameAnalysis analyze_frame(const shortshot::Neighborhood& n, shortshot::Radius radius);

}  // namespace shortshot_bench::golden
