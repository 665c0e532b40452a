// shortshot/batch/extractor.hpp: many key points at once, with memory that is used again for the next cloud. Hosted
// only: allocates, starts threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <type_traits>
#include <vector>

#include "../cloud/cloud.hpp"
#include "../cloud/keypoint.hpp"
#include "../cloud/read.hpp"
#include "../color/color_source.hpp"
#include "../color/lab_table.hpp"
#include "../config.hpp"
#include "../dispatch/widest.hpp"
#include "../kernel/describe_at.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "executor.hpp"
#include "features.hpp"
#include "growing_workspace.hpp"
#include "known_rows.hpp"
#include "plausible.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Key points that a thread takes at a time. Few, since one at the rim of an object has a hundredth of the neighbors
/// of one on a table, and whoever takes the last block keeps the others waiting: of 1000 key points on 8 threads that
/// cost 1 % with blocks of 2, 2.5 % with 4, 10 % with 16 (measured), and a block costs 30 nanoseconds at worst.
inline constexpr std::size_t keypoint_block = 2;

/// Colors that a thread converts at a time: about 20 microseconds of work.
inline constexpr std::size_t color_block = 4096;

/// Key point `row` of those that are to be described: false for an index outside of the cloud.
[[nodiscard]] inline bool keypoint_at(const CloudView&, const std::vector<KeyPoint>& keypoints, std::size_t row,
                                      KeyPoint& key) noexcept {
  key = keypoints[row];
  return true;
}
template <class Index>
[[nodiscard]] bool keypoint_at(const CloudView& cloud, const std::vector<Index>& keypoints, std::size_t row,
                               KeyPoint& key) noexcept {
  static_assert(std::is_integral<Index>::value, "extract() supports key points as indices or as KeyPoints");
  const Index index = keypoints[row];
  if (!is_index(cloud, index)) return false;
  key = keypoint(cloud, static_cast<std::size_t>(index));
  return true;
}

/// A copy where an argument is a part of the output, which is cleared first; else the argument.
template <class Argument, class D>
class SafeFrom {
 public:
  SafeFrom(const Argument& argument, const Features<D>& out) : argument_(argument) {
    const void* const parts[] = {&out.keypoints, &out.frames, &out.neighbors};
    is_part_ = std::find(std::begin(parts), std::end(parts), static_cast<const void*>(&argument)) != std::end(parts);
    if (is_part_) copy_ = argument;
  }
  [[nodiscard]] const Argument& get() const noexcept { return is_part_ ? copy_ : argument_; }

 private:
  const Argument& argument_;
  Argument copy_;
  bool is_part_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Describes many key points of one cloud after the other, and owns the scratch memory that this takes. `Color` is how
/// a cloud's colors are kept meanwhile: Lab, 12 bytes a point, or PackedLab, 4 bytes a point and less exact.
///
/// Allocates those and 16 KB for colors, for each thread 2 KB and about 30 bytes for each neighbor of the largest
/// neighborhood, and the rows; with the same extractor and features again, nothing, until a cloud needs more than those
/// before it. Starting threads, however, costs small allocations of the C++ runtime's in every call; an executor has
/// none. May throw what std::vector, std::thread and the executor throw (on a thread started here that ends the
/// program); rows that were not described by then have the status out_of_memory.
template <class D, class Color = Lab>
class Extractor {
  static_assert(std::is_same<Color, Lab>::value || std::is_same<Color, PackedLab>::value,
                "Extractor<D, Color> supports Lab and PackedLab");

 public:
  /// See the function extract() below.
  template <class Search, class Key, class Threads = unsigned, class... Own>
  [[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                               const Support& support, Features<D>& out, Threads&& threads = 1u, const Own&... own) {
    const auto finish = [&](const Neighborhood& n, const auto& sources, std::size_t row, float* values) {
      return detail::describe_widest<D>(n, sources, out.keypoints[row].position, support, out.frames[row], values,
                                        out.frame_confidence[row]);
    };
    const detail::SafeFrom<std::vector<Key>, D> keys(keypoints, out);
    return extract_all<true>(cloud, search, keys.get(), support, out, threads, finish, own...);
  }

  /// The same in frames that the caller knows, one for each key point: bad_rows if there are not as many; bad_frame for
  /// a key point whose frame is not orthonormal.
  template <class Search, class Key, class Threads = unsigned, class... Own>
  [[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                               const std::vector<Frame>& frames, Radius radius, Features<D>& out,
                               Threads&& threads = 1u, const Own&... own) {
    if (frames.size() != keypoints.size()) {
      detail::clear_rows(out, keypoints.size(), Status::bad_rows);
      return Status::bad_rows;
    }
    const detail::SafeFrom<std::vector<Frame>, D> kept(frames, out);
    const detail::SafeFrom<std::vector<Key>, D> keys(keypoints, out);
    const auto finish = [&](const Neighborhood& n, const auto& sources, std::size_t row, float* values) {
      out.frames[row] = kept.get()[row];
      return detail::describe_widest<D>(n, sources, out.frames[row], radius, values);
    };
    return extract_all<false>(cloud, search, keys.get(), radius, out, threads, finish, own...);
  }

 private:
  /// finish(neighborhood, sources, row, values) makes row `row` of a key point's neighborhood. `SameRows`: the same key
  /// point has the same row.
  template <bool SameRows, class Search, class Key, class Threads, class Finish, class... Own>
  [[nodiscard]] Status extract_all(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                                   const Support& support, Features<D>& out, Threads& threads, const Finish& finish,
                                   const Own&... own) {
    const std::size_t count = keypoints.size();
    auto&& executor = detail::executor_of(threads, (count + detail::keypoint_block - 1) / detail::keypoint_block);
    const Status usable = validate<D>(cloud, search, support);
    detail::clear_rows(out, count, usable == Status::ok ? Status::out_of_memory : usable);
    if (usable != Status::ok) return usable;
    const std::size_t team = std::max<std::size_t>(1, static_cast<std::size_t>(executor.threads()));
    if (workspaces_.size() < team) {
      workspaces_.resize(team);
      leveled_for_ = 0;
    }
    if (SameRows) known_rows_.assign(team, {});
    convert_colors(cloud, executor, team);
    const auto extract_rows = [&](std::size_t thread, std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row) {
        KeyPoint& key = out.keypoints[row];
        Status& status = out.status[row];
        if (!detail::keypoint_at(cloud, keypoints, row, key)) {
          status = Status::bad_keypoint;
          continue;
        }
        const std::size_t same = SameRows ? known_rows_[thread].find(out, row) : row;
        if (same != row) {
          detail::copy_row(out, same, row);
          continue;
        }
        status = extract_row(cloud, search, support, workspaces_[thread], out, row, finish, own...);
        if (status != Status::ok) detail::clear_row(out, row);
        if (SameRows) known_rows_[thread].keep(out, row);
      }
    };
    detail::for_blocks(executor, team, count, detail::keypoint_block, extract_rows);
    level(out.neighbors);
    const Status sense = verdict(cloud, search, support, out);
    if (sense != Status::ok) detail::clear_rows(out, count, sense);
    return sense;
  }

  /// other_cloud if one row shows it: no other one can be believed then. coarse_coordinates if all rows are. Else ok.
  template <class Search>
  [[nodiscard]] Status verdict(const CloudView& cloud, const Search& search, const Support& support,
                               const Features<D>& out) {
    const auto rows = static_cast<std::ptrdiff_t>(out.size());
    const auto count = [&](Status status) { return std::count(out.status.begin(), out.status.end(), status); };
    if (rows == 0) return Status::ok;
    if (count(Status::other_cloud) > 0) return Status::other_cloud;
    if (count(Status::coarse_coordinates) == rows) return Status::coarse_coordinates;
    if (std::count(out.neighbors.begin(), out.neighbors.end(), 0u) < rows) return Status::ok;
    const Radius reach = detail::reach_of<D>(support);
    return detail::finds_a_point(cloud, search, reach, workspaces_[0]) ? Status::ok : Status::other_cloud;
  }

  /// One row but for the zeros of a failure. The workspace grows until the neighbors fit.
  template <class Search, class Finish, class... Own>
  [[nodiscard]] Status extract_row(const CloudView& cloud, const Search& search, const Support& support,
                                   detail::GrowingWorkspace& workspace, Features<D>& out, std::size_t row,
                                   const Finish& finish, const Own&... own) const {
    using Kinds = typename D::Sources;
    const KeyPoint& key = out.keypoints[row];
    if (!is_finite(key.position)) return Status::invalid_keypoint;
    if (detail::is_coarse(key.position, support.radius)) return Status::coarse_coordinates;
    const Color* const converted = lab_.data();
    const auto sources = detail::sources_at(Kinds{}, cloud, detail::key_for<D>(key), own..., converted);
    Status status = detail::status_of(Kinds{}, sources);
    if (status != Status::ok) return status;
    Neighborhood n;
    status = workspace.gather(search, key.position, detail::reach_of<D>(support), n);
    out.neighbors[row] = n.found;
    if (status != Status::ok) return status;
    if (n.size > max_neighbors) return Status::too_many_neighbors;
    if (!detail::is_of(cloud, key.position, n)) return Status::other_cloud;
    return finish(n, sources, row, row_of(out, row));
  }

  template <class Executor>
  void convert_colors(const CloudView& cloud, Executor& executor, std::size_t team) {
    if constexpr (D::needs_colors) {
      to_lab_.fill();
      lab_.resize(cloud.size);
      detail::for_blocks(executor, team, cloud.size, detail::color_block,
                         [&](std::size_t, std::size_t begin, std::size_t end) {
                           detail::convert_range(cloud, begin, end, to_lab_, lab_.data());
                         });
    }
  }

  /// Room in all workspaces for a quarter more neighbors than the largest neighborhood had, whichever thread gets it
  /// next time. Nothing is done about clouds up to an eighth denser than that: a little difference needs no memory.
  void level(const std::vector<std::uint32_t>& neighbors) {
    if (neighbors.empty()) return;
    const std::size_t most = std::min(*std::max_element(neighbors.begin(), neighbors.end()), max_neighbors);
    if (most <= leveled_for_) return;
    for (detail::GrowingWorkspace& workspace : workspaces_) workspace.reserve(most + most / 4);
    leveled_for_ = most + most / 8;
  }

  [[nodiscard]] static float* row_of(Features<D>& out, std::size_t row) noexcept {
    return out.values.data() + row * static_cast<std::size_t>(D::size);
  }

  LabTable<typename D::LabRule> to_lab_;
  std::vector<Color> lab_;                            // the cloud's colors
  std::vector<detail::GrowingWorkspace> workspaces_;  // one per thread
  std::vector<detail::KnownRows> known_rows_;         // one per thread, of one call
  std::size_t leveled_for_ = 0;                       // neighbors that each of them has had room made for
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
