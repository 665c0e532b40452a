// Private to the readers: from a table of points to a cloud, and to what is said about it.
#pragma once

#include "point_table.hpp"
#include "rgbd_cloud.hpp"

namespace shortshot_bench {

/// The columns of all channels that the table uses are set.
RgbdCloud make_cloud(PointTable& table);

}  // namespace shortshot_bench
