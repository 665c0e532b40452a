// Private to the readers: the colors of a table of points, whatever their names and types.
#pragma once

#include <string>
#include <vector>

#include "point_table.hpp"
#include "rgbd_cloud.hpp"

namespace shortshot_bench {

/// Sets cloud.rgb if the table has colors that can be used. How they were read, where that is not plain, goes to
/// cloud.notes, and what could not be used, with the reason, to `ignored`.
void read_colors(const PointTable& table, RgbdCloud& cloud, std::vector<std::string>& ignored);

}  // namespace shortshot_bench
