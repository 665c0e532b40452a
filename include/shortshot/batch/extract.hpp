// shortshot/batch/extract.hpp: many key points at once, on one or more threads. Hosted only: allocates, starts threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "../cloud/cloud.hpp"
#include "../color/color_source.hpp"
#include "../config.hpp"
#include "../kernel/describe_at.hpp"
#include "../search/neighborhood.hpp"
#include "../status.hpp"
#include "executor.hpp"
#include "features.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// Key points that a thread takes at a time. Few, since one at the rim of an object has a hundredth of the neighbors
/// of one on a table, and whoever takes the last block keeps the others waiting: of 1000 key points on 8 threads that
/// cost 1 % with blocks of 2, 2.5 % with 4, 10 % with 16 (measured), and a block costs 30 nanoseconds at worst.
inline constexpr std::size_t keypoint_block = 2;

/// Colors that a thread converts at a time: about 20 microseconds of work.
inline constexpr std::size_t color_block = 4096;

/// Row `row` of the features but for the zeros of a failure. The workspace grows until the neighbors fit.
template <class D, class Color, class Search>
[[nodiscard]] Status extract_row(const CloudView& cloud, const Search& search, const KeyPoint& key,
                                 const Support& support, GrowingWorkspace& workspace, Features<D, Color>& out,
                                 std::size_t row) {
  if (!is_finite(key.position)) return Status::invalid_keypoint;
  Neighborhood n;
  const Status status = workspace.gather(search, key.position, gather_radius(support), n);
  out.neighbors[row] = n.found;
  if (status != Status::ok) return status;
  if (n.size > max_neighbors) return Status::too_many_neighbors;
  float* values = out.values.data() + row * static_cast<std::size_t>(D::size);
  std::memset(values, 0, D::size_bytes);
  if constexpr (D::needs_colors) {
    const StoredColors<Color> colors{out.scratch.lab.data(), out.scratch.to_lab(key.color)};
    return describe_gathered<D, default_chunk_size>(cloud, n, colors, key.position, support, out.frames[row], values,
                                                    out.frame_confidence[row]);
  } else {
    return describe_gathered<D, default_chunk_size>(cloud, n, NoColors{}, key.position, support, out.frames[row],
                                                    values, out.frame_confidence[row]);
  }
}

/// Room in all workspaces for a quarter more neighbors than the largest neighborhood had, whichever thread gets it
/// next time. Nothing is done about frames up to an eighth larger than that: frames a little different need no memory.
template <class Scratch>
void level(Scratch& scratch, const std::vector<std::uint32_t>& neighbors) {
  if (neighbors.empty()) return;
  const std::size_t most = std::min(*std::max_element(neighbors.begin(), neighbors.end()), max_neighbors);
  if (most <= scratch.leveled_for) return;
  for (GrowingWorkspace& workspace : scratch.workspaces) workspace.reserve(most + most / 4);
  scratch.leveled_for = most + most / 8;
}

/// `key_at(i, key)` makes `key` key point i and returns true, or returns false for one outside the cloud.
template <class D, class Color, class Search, class KeyAt, class Threads>
[[nodiscard]] Status extract_all(const CloudView& cloud, const Search& search, std::size_t count, const KeyAt& key_at,
                                 const Support& support, Features<D, Color>& out, Threads& threads) {
  constexpr auto row_size = static_cast<std::size_t>(D::size);
  auto&& executor = executor_of(threads, (count + keypoint_block - 1) / keypoint_block);
  const Status usable = check<D>(cloud, search, support);
  out.status.assign(count, usable);
  out.neighbors.assign(count, 0);
  out.frames.assign(count, Frame{});
  out.frame_confidence.assign(count, FrameConfidence{});
  out.values.resize(count * row_size);
  if (usable != Status::ok) {
    std::fill(out.values.begin(), out.values.end(), 0.0f);
    return usable;
  }
  auto& scratch = out.scratch;
  const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
  if (scratch.workspaces.size() < team) {
    scratch.workspaces.resize(team);
    scratch.leveled_for = 0;
  }
  if constexpr (D::needs_colors) {
    scratch.to_lab.fill();
    scratch.lab.resize(cloud.size);
    for_blocks(executor, team, cloud.size, color_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      convert_range(cloud, begin, end, scratch.to_lab, scratch.lab.data());
    });
  }
  for_blocks(executor, team, count, keypoint_block, [&](std::size_t thread, std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      KeyPoint key{};
      Status& status = out.status[row];
      status = Status::bad_keypoint;
      if (key_at(row, key)) status = extract_row(cloud, search, key, support, scratch.workspaces[thread], out, row);
      if (status == Status::ok) continue;
      clear_row(out, row);
    }
  });
  level(scratch, out.neighbors);
  return Status::ok;
}

}  // namespace detail

/// Describe many key points of a cloud, given by their indices (of any integer type; pcl::Indices, too).
///
/// `search`   any search over this cloud (GridSearch, NanoflannSearch, ...)
/// `support`  radii and viewpoint; a plain float is the radius in meters
/// `out`      one row and one Status per key point; a key point that cannot be described spoils no other
/// `threads`  how many threads share the work, or an executor, which runs it on threads that are there already; the
///            result is the same, bit for bit, for any number
///
/// An executor is any object with `threads()`, the most threads that it runs on, and `run(work)`, which calls work() on
/// each of them, or on fewer, but on one at least, and returns when all calls have returned. OpenMP's, with n threads:
///
///     struct OpenMp {
///       int n;
///       int threads() const { return n; }
///       template <class Work> void run(const Work& work) {
///         #pragma omp parallel num_threads(n)
///         work();
///       }
///     };
///
/// and TBB's run() is `tbb::parallel_for(0, n, [&](int) { work(); });`. A call runs at most two pieces of work on it.
///
/// Returns ok if key points could be looked at at all, else why not, and every row has that status: empty_cloud,
/// bad_view (also: the search is over a cloud of another size), bad_radius, bad_viewpoint, missing_colors,
/// missing_normals, or what the search's build() returned.
///
/// Allocates 12 bytes a point for colors (4 with Features<D, PackedLab>) and 16 KB, about 30 bytes for each neighbor
/// of the largest neighborhood and each thread, and the rows; with the same `out` again, nothing, until a frame needs
/// more than those before it. Starting threads, however, costs small allocations of the C++ runtime's in every call; an
/// executor has none. May throw what std::vector, std::thread and the executor throw (on a thread started here that
/// ends the program).
template <class D, class Color, class Search, class Index, class Threads = unsigned,
          class = std::enable_if_t<std::is_integral<Index>::value>>
[[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<Index>& keypoints,
                             const Support& support, Features<D, Color>& out, Threads&& threads = 1u) {
  const auto key_at = [&](std::size_t row, KeyPoint& key) {
    const auto index = static_cast<std::size_t>(keypoints[row]);  // a negative one becomes far too large
    if (index >= cloud.size) return false;
    key = keypoint(cloud, index);
    return true;
  };
  return detail::extract_all(cloud, search, keypoints.size(), key_at, support, out, threads);
}

/// The same for key points that need not be points of the cloud, each with its own position and color.
template <class D, class Color, class Search, class Threads = unsigned>
[[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<KeyPoint>& keypoints,
                             const Support& support, Features<D, Color>& out, Threads&& threads = 1u) {
  const auto key_at = [&](std::size_t row, KeyPoint& key) {
    key = keypoints[row];
    return true;
  };
  return detail::extract_all(cloud, search, keypoints.size(), key_at, support, out, threads);
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
