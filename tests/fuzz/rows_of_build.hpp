// What one build of the library makes of a cloud, as bytes: statuses, frames, normals, descriptors.
#pragma once

#include <cstdint>
#include <vector>

#include "made_cloud.hpp"

namespace fuzz {

using RowsOfBuild = void(const MadeCloud& cloud, std::size_t key, std::vector<std::uint8_t>& rows);
RowsOfBuild rows_sse2, rows_avx2, rows_scalar;

}  // namespace fuzz
