// Private to the readers: colors that are three bytes of one number.
#pragma once

#include <string>
#include <vector>

#include "point_table.hpp"
#include "rgbd_cloud.hpp"

namespace shortshot_bench {

/// 0xAARRGGBB as a whole number or as the bits of a float, which is PCL's way. As read_colors().
void read_packed_colors(const Channel& channel, RgbdCloud& cloud, std::vector<std::string>& ignored);

}  // namespace shortshot_bench
