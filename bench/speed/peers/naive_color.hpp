// Colors of the naive transcription: sRGB bytes to CIELAB by the published tables, and the distance of two.
#pragma once

#include <array>
#include <cstdint>

namespace shortshot_bench::peers {

std::array<double, 3> naive_lab(const std::uint8_t* rgb);

/// 0 to 1.
double naive_color_distance(const std::array<double, 3>& p, const std::array<double, 3>& q);

}  // namespace shortshot_bench::peers
