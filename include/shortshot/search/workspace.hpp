// shortshot/search/workspace.hpp: the memory of a neighborhood, sized at compile time and owned by the caller.
#ifndef SHORTSHOT_SEARCH_WORKSPACE_HPP
#define SHORTSHOT_SEARCH_WORKSPACE_HPP

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "neighborhood.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// All the scratch memory a key point needs, sized at compile time and owned by the caller: a local, a static, a
/// member. 20 bytes a neighbor. Trivial type; one thread at a time may use it.
template <std::size_t MaxNeighbors>
struct Workspace {
  static_assert(MaxNeighbors >= 5 && MaxNeighbors <= max_neighbors,
                "Workspace<MaxNeighbors> supports 5 (a local reference frame needs as many) to 2^24 neighbors");
  float dx[MaxNeighbors];             ///< see Neighborhood, as all of these
  float dy[MaxNeighbors];             ///< along y
  float dz[MaxNeighbors];             ///< along z
  float d2[MaxNeighbors];             ///< squared distances
  std::uint32_t index[MaxNeighbors];  ///< in the cloud
};

/// A Workspace of 2 bytes a neighbor (`Index` std::uint32_t: 4) for targets that have more time than memory. Clouds of
/// more points than `Index` can tell apart have too_many_neighbors wherever there is a neighbor.
template <std::size_t MaxNeighbors, class Index = std::uint16_t>
struct CompactWorkspace {
  static_assert(MaxNeighbors >= 5 && MaxNeighbors <= max_neighbors,
                "CompactWorkspace<MaxNeighbors> supports 5 (a local reference frame needs as many) to 2^24 neighbors");
  static_assert(std::is_same<Index, std::uint16_t>::value || std::is_same<Index, std::uint32_t>::value,
                "CompactWorkspace<MaxNeighbors, Index> supports uint16_t and uint32_t");
  Index index[MaxNeighbors];  ///< see CompactNeighborhood
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// An empty neighborhood in a workspace's memory; a compact one is for key points of `cloud`.
template <std::size_t MaxNeighbors>
[[nodiscard]] inline Neighborhood neighborhood_in(Workspace<MaxNeighbors>& w) noexcept {
  return {w.dx, w.dy, w.dz, w.d2, w.index, static_cast<std::uint32_t>(MaxNeighbors), 0, 0, {}};
}

template <std::size_t MaxNeighbors>
[[nodiscard]] inline Neighborhood neighborhood_in(Workspace<MaxNeighbors>& w, const CloudView&) noexcept {
  return neighborhood_in(w);
}

template <std::size_t MaxNeighbors, class Index>
[[nodiscard]] inline CompactNeighborhood<Index> neighborhood_in(CompactWorkspace<MaxNeighbors, Index>& w,
                                                                const CloudView& cloud) noexcept {
  const bool all_have_indices = cloud.size - 1 <= static_cast<Index>(~Index{0});
  return {cloud.points, {}, w.index, all_have_indices ? static_cast<std::uint32_t>(MaxNeighbors) : 0u, 0, 0};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_SEARCH_WORKSPACE_HPP
