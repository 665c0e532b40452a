// Private to the readers: an origin near the points, where floats are too coarse for the file's coordinates.
#pragma once

#include <array>

#include "point_table.hpp"

namespace shortshot_bench {

/// What to subtract from each coordinate: zeros where floats are fine enough, or where nothing is to be won because the
/// file holds 4-byte floats itself; `lost` says so then. Judged by a sample; points of (0, 0, 0) and those that are not
/// finite do not count.
struct OriginShift {
  std::array<double, 3> origin{0, 0, 0};
  double spacing = 0;  // of floats at the file's coordinates, where that is too coarse; else 0
  bool lost = false;   // the file has such floats
};
OriginShift find_origin(const PointTable& table);

}  // namespace shortshot_bench
