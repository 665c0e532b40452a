// Private to read_cloud: the PCD format.
#pragma once

#include "byte_source.hpp"
#include "rgbd_cloud.hpp"

namespace shortshot_bench {

// PCD v0.6 and v0.7, DATA ascii, binary and binary_compressed. The source stands at the file's begin.
RgbdCloud read_pcd(ByteSource& source);

}  // namespace shortshot_bench
