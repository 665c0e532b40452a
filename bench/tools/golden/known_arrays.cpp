#include "known_arrays.hpp"

#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "named_descriptors.hpp"

namespace shortshot_bench::golden {
namespace {

constexpr auto descriptor_sizes = std::apply(
    [](auto... named) {
      return std::array{std::pair{named.name, std::uint64_t{decltype(named)::Descriptor::size}}...};
    },
    named_descriptors);

}  // namespace

std::optional<KnownArray> find_known_array(const std::string& name) {
  static const std::map<std::string, KnownArray> others = {
      {"points", {"<f4", "", {3}, Role::input}},
      {"rgb", {"u1", "points", {3}, Role::input}},
      {"normals", {"<f4", "points", {3}, Role::input}},
      {"keypoints", {"<i4", "", {}, Role::input}},
      {"frames", {"<f4", "keypoints", {3, 3}, Role::input}},
      {"neighbor_count", {"<i4", "keypoints", {}, Role::reference}},
      {"lrf_pcl", {"<f4", "keypoints", {3, 3}, Role::reference}},
      {"lab_pcl", {"<f4", "rgb", {3}, Role::reference}},
      {"lab_authors", {"<f4", "rgb", {3}, Role::reference}},
      {"bshot", {"u1", "keypoints", {44}, Role::reference}},
      {"fpfh33", {"<f4", "keypoints", {33}, Role::later}},
  };
  for (const auto& [descriptor, size] : descriptor_sizes) {
    if (name == descriptor) return KnownArray{"<f4", "keypoints", {size}, Role::reference};
    if (name == std::string(descriptor) + "_nibbles") {
      return KnownArray{"u1", "keypoints", {(size + 1) / 2}, Role::reference};
    }
  }
  const auto found = others.find(name);
  if (found == others.end()) return std::nullopt;
  return found->second;
}

}  // namespace shortshot_bench::golden
