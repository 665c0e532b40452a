// The nanoflann leaf finds the neighbors that looking at every point finds. Compiled thrice: with the
// installed nanoflann and with stand-ins that have older and newer versions' interfaces (fake_nanoflann/).
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <nanoflann.hpp>
#include <shortshot/shortshot.hpp>
#include <vector>

namespace {

template <class Search>
std::vector<std::uint32_t> neighbors(const Search& search, const shortshot::Point& center, float radius) {
  static shortshot::Workspace<2000> workspace;
  shortshot::Neighborhood found = shortshot::neighborhood_in(workspace);
  if (search.gather(center, radius, found) != shortshot::Status::ok) return {};
  std::vector<std::uint32_t> indices(found.index, found.index + found.size);
  std::sort(indices.begin(), indices.end());
  return indices;
}

}  // namespace

int main() {
  std::vector<float> xyz;
  std::uint32_t random = 1;
  for (int i = 0; i < 3 * 2000; ++i) {
    random = random * 1664525u + 1013904223u;
    xyz.push_back(static_cast<float>(random >> 8) / 16777216.0f);
  }
  xyz[300] = std::numeric_limits<float>::quiet_NaN();
  const shortshot::CloudView cloud = shortshot::view_xyz(xyz.data(), xyz.size() / 3);
  const shortshot::NanoflannSearch tree(cloud);
  std::size_t sum = 0;
  for (std::size_t i = 0; i < cloud.size; i += 7) {
    const shortshot::Point center = shortshot::point(cloud, i);
    const auto found = neighbors(tree, center, 0.15f);
    if (found != neighbors(shortshot::BruteSearch{cloud}, center, 0.15f)) {
      std::printf("other neighbors around point %zu\n", i);
      return 1;
    }
    sum += found.size();
  }
  std::printf("nanoflann 0x%x: the same %zu neighbors\n", NANOFLANN_VERSION, sum);
  return sum > 0 ? 0 : 1;
}
