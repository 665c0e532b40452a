// Reads a point cloud file, PCD or PLY, whatever its name.
#pragma once

#include <string>

#include "rgbd_cloud.hpp"

namespace shortshot_bench {

// The content decides the format, not the name's extension. Throws InputError for a file that is missing,
// broken or truncated; memory stays within a small multiple of the file size (a compressed PCD file: of
// its uncompressed size, which is at most 88 times as large).
//
// No PLY or PCD library is used: none of them bounds its memory by the file size and names the position of
// an error.
RgbdCloud read_cloud(const std::string& path);

// The same of a file's bytes, which are in memory already; messages call them `name`.
RgbdCloud read_cloud(const std::string& name, std::string bytes);

}  // namespace shortshot_bench
