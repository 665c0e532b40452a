// Private to the readers: the normals of a table of points.
#pragma once

#include <string>
#include <vector>

#include "point_table.hpp"
#include "rgbd_cloud.hpp"

namespace shortshot_bench {

/// Sets cloud.normals if the table has any that can be used, all of length 1 or NaN. As read_colors().
void read_normals(const PointTable& table, RgbdCloud& cloud, std::vector<std::string>& ignored);

}  // namespace shortshot_bench
