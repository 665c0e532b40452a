// shortshot/batch/estimate_normals.hpp: the surface normals of a whole cloud, on one or more threads. Hosted only:
// allocates, starts threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../frame/viewpoint.hpp"
#include "../search/radius.hpp"
#include "../search/search.hpp"
#include "../status.hpp"
#include "executor.hpp"
#include "normal_estimator.hpp"
#include "plausible.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Points that a thread takes at a time: about a quarter of a millisecond of work.
inline constexpr std::size_t normal_block = 512;

/// estimate_normals() where `needed` is not 0; null: everywhere.
template <class Search, class Threads>
[[nodiscard]] Status estimate_needed_normals(const CloudView& cloud, const Search& search, Radius radius,
                                             const Viewpoint& viewpoint, const std::uint8_t* needed,
                                             std::vector<SurfaceNormal>& normals, Threads& threads) {
  normals.clear();
  Status status = validate_search(cloud, search);
  if (status == Status::ok) status = validate(radius);
  if (status == Status::ok) status = validate(viewpoint);
  if (status == Status::ok && all_are_coarse(cloud, radius)) status = Status::coarse_coordinates;
  if (status != Status::ok) return status;

  auto&& executor = executor_of(threads, (cloud.size + normal_block - 1) / normal_block);
  const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
  std::vector<NormalMemory> memories(team);
  for (NormalMemory& memory : memories) memory.workspace.reserve(1024);
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  normals.assign(cloud.size, {none, none, none});  // and so they stay where an executor throws before their turn
  for_blocks(executor, team, cloud.size, normal_block, [&](std::size_t thread, std::size_t begin, std::size_t end) {
    NormalEstimator<Search>(cloud, search, radius, viewpoint, needed, memories[thread], normals.data())
        .estimate(begin, end);
  });
  bool other_cloud = false;
  for (const NormalMemory& memory : memories) other_cloud = other_cloud || memory.other_cloud;
  const auto has_one = [](const SurfaceNormal& n) { return n.x == n.x; };
  if (!other_cloud && std::none_of(normals.begin(), normals.end(), has_one)) {
    other_cloud = !finds_a_point(cloud, search, radius, memories[0].workspace);
  }
  if (other_cloud) normals.clear();
  return other_cloud ? Status::other_cloud : Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The surface normal at each point of a cloud, as estimate_normal() gives it but for the rounding of sums: points that
/// follow each other are looked at together.
///
/// `search`     any search over this cloud (GridSearch, NanoflannSearch, ...)
/// `radius`     of the neighborhoods, in meters
/// `viewpoint`  to which side of the surface normals point: Viewpoint::towards({0, 0, 0}) for what a depth camera gives
///              in its own coordinates; Viewpoint{} leaves them as they come
/// `normals`    one per point, all three components NaN where the point is not finite or has no normal: fewer than
///              three neighbors, or all of them on a line. with_normals(cloud, normals.data()) puts them into a view
/// `threads`    how many threads share the work, or an executor (see extract()); the result is the same, bit for bit,
///              for any number, and for any search
///
/// Statuses: empty_cloud, bad_view (also: the search is over a cloud of another size), bad_radius, bad_viewpoint (not
/// finite), what the search's build() returned, coarse_coordinates (at every point floats lie farther apart than a 64th
/// of the radius), or other_cloud (as in extract()); `normals` is empty then.
///
/// The cost is points times neighbors: with a radius as large as the cloud, the square of its points. Points that lie
/// on top of each other in crowded places, as (0, 0, 0) for "no measurement", are looked at once for each place.
/// Allocates the normals (none, if they fit already), and for each thread 8 KB and about 30 bytes for each neighbor of
/// the largest neighborhood. May throw what extract() may; `normals` is empty then, or NaN where none was estimated by
/// then.
template <class Search, class Threads = unsigned>
[[nodiscard]] Status estimate_normals(const CloudView& cloud, const Search& search, Radius radius,
                                      const Viewpoint& viewpoint, std::vector<SurfaceNormal>& normals,
                                      Threads&& threads = 1u) {
  return detail::estimate_needed_normals(cloud, search, radius, viewpoint, nullptr, normals, threads);
}

/// The same where normals are needed: `needed` has a number for each point (see mark_neighbors()). Points where it is
/// not 0 have the normals that they have among those of the whole cloud, bit for bit; others may have NaN. sizes_differ
/// if there are not as many.
template <class Search, class Threads = unsigned>
[[nodiscard]] Status estimate_normals(const CloudView& cloud, const Search& search, Radius radius,
                                      const Viewpoint& viewpoint, const std::vector<std::uint8_t>& needed,
                                      std::vector<SurfaceNormal>& normals, Threads&& threads = 1u) {
  normals.clear();
  const Status usable = detail::validate_search(cloud, search);
  if (usable != Status::ok) return usable;
  if (needed.size() != cloud.size) return Status::sizes_differ;
  return detail::estimate_needed_normals(cloud, search, radius, viewpoint, needed.data(), normals, threads);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
