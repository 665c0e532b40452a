#include "range_grid.hpp"

#include <algorithm>
#include <limits>

namespace shortshot_bench {
namespace {

template <typename Value>
std::vector<Value> arranged(const std::vector<Value>& values, std::size_t per_point, const RangeGrid& grid,
                            Value missing) {
  if (values.empty()) return {};
  std::vector<Value> result(per_point * grid.size(), missing);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    if (grid[cell] != no_vertex) std::copy_n(&values[per_point * grid[cell]], per_point, &result[per_point * cell]);
  }
  return result;
}

}  // namespace

RgbdCloud arranged(const RgbdCloud& cloud, const RangeGrid& grid, std::size_t width, std::size_t height) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<bool> is_used(cloud.size(), false);
  for (const std::size_t vertex : grid) {
    if (vertex != no_vertex) is_used[vertex] = true;
  }
  const auto unused = std::count(is_used.begin(), is_used.end(), false);
  RgbdCloud result = cloud;
  result.xyz = arranged(cloud.xyz, 3, grid, nan);
  if (result.xyz.empty()) result.xyz.resize(3 * grid.size(), nan);
  result.rgb = arranged<std::uint8_t>(cloud.rgb, 3, grid, 0);
  result.intensity = arranged(cloud.intensity, 1, grid, nan);
  result.normals = arranged(cloud.normals, 3, grid, nan);
  result.width = width;
  result.height = height;
  result.notes.push_back("organized by its range grid, " + std::to_string(width) + " x " + std::to_string(height) +
                         (unused == 0 ? "" : ", which leaves out " + std::to_string(unused) + " vertices"));
  return result;
}

}  // namespace shortshot_bench
