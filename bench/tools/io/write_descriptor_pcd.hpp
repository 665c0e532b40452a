// Writes key points with their descriptors as a PCD file.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace shortshot_bench {

// Binary PCD v0.7 with the fields x, y, z and `descriptor`, the latter with COUNT = size. `descriptors`
// holds `size` floats per position. Each of `comments` becomes a line "# ..." of the header, to say what the
// values mean. Throws InputError if the file cannot be written, std::invalid_argument if size is 0: the
// format has no field without values.
void write_descriptor_pcd(const std::string& path, const std::vector<std::array<float, 3>>& positions,
                          const float* descriptors, std::size_t size, const std::vector<std::string>& comments);

}  // namespace shortshot_bench
