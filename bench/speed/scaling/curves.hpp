// The four scaling curves of shortshot on the generated scene.
#pragma once

#include <vector>

#include "speed/scaling/curve_point.hpp"

namespace shortshot_bench::scaling {

/// `quick`: smaller and with fewer repetitions, to see that everything works.
std::vector<CurvePoint> measure_points(bool quick);
std::vector<CurvePoint> measure_neighbors(bool quick);
std::vector<CurvePoint> measure_keypoints(bool quick);
std::vector<CurvePoint> measure_threads(bool quick);

/// All of them, one after the other.
std::vector<CurvePoint> measure_curves(bool quick);

}  // namespace shortshot_bench::scaling
