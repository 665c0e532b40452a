// Private to read_cloud: the PLY format.
#pragma once

#include "byte_source.hpp"
#include "rgbd_cloud.hpp"

namespace shortshot_bench {

// ascii, binary_little_endian and binary_big_endian; elements after the vertices are not read. The source
// stands at the file's begin.
RgbdCloud read_ply(ByteSource& source);

}  // namespace shortshot_bench
