// shortshot/extract.hpp: many key points at once, on one or more threads. Hosted only: allocates, starts threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <type_traits>
#include <vector>

#include "cloud.hpp"
#include "color.hpp"
#include "config.hpp"
#include "describe_at.hpp"
#include "neighborhood.hpp"
#include "status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// A workspace that grows: one per thread.
class GrowingWorkspace {
 public:
  [[nodiscard]] Neighborhood neighborhood() noexcept {
    const std::size_t n = index_.size();
    float* p = floats_.data();
    return {p, p + n, p + 2 * n, p + 3 * n, index_.data(), static_cast<std::uint32_t>(n), 0, 0};
  }
  void reserve(std::size_t neighbors) {
    if (neighbors <= index_.size()) return;
    floats_.resize(4 * neighbors);
    index_.resize(neighbors);
  }

 private:
  std::vector<float> floats_;
  std::vector<std::uint32_t> index_;
};

}  // namespace detail

/// What extract() gives: one row per key point, in their order. Keep it from frame to frame and its memory is reused.
template <class D>
struct Features {
  std::vector<float> values;             ///< size() * D::size, row by row; zeros where the status is not ok
  std::vector<Status> status;            ///< one per key point
  std::vector<std::uint32_t> neighbors;  ///< found within the larger radius, the key point itself included

  [[nodiscard]] std::size_t size() const noexcept { return status.size(); }
  [[nodiscard]] const float* operator[](std::size_t row) const noexcept {
    return values.data() + row * static_cast<std::size_t>(D::size);
  }

  struct {
    std::vector<Lab> lab;                              // the cloud's colours
    std::vector<detail::GrowingWorkspace> workspaces;  // one per thread
  } scratch;                                           ///< extract()'s own; nothing to read there
};

namespace detail {

/// Row `row` of the features. The workspace grows until the neighbours fit.
template <class D, class Search>
void extract_one(const Search& search, const KeyPoint& key, const Support& support, GrowingWorkspace& workspace,
                 Features<D>& out, std::size_t row) {
  float* values = out.values.data() + row * static_cast<std::size_t>(D::size);
  Status& status = out.status[row];
  if (!is_finite(key.position)) {
    status = Status::invalid_keypoint;
    return;
  }
  Neighborhood n = workspace.neighborhood();
  status = gather(search, key.position, support, n);
  if (status == Status::too_many_neighbors && n.found <= max_neighbors) {
    workspace.reserve(n.found + n.found / 2);
    n = workspace.neighborhood();
    status = gather(search, key.position, support, n);
  }
  out.neighbors[row] = n.found;
  if (status != Status::ok) return;
  if constexpr (D::needs_colors) {
    const LabColors colors{out.scratch.lab.data(), to_lab<typename D::LabRule>(key.color)};
    status = describe_gathered<D>(n, colors, key.position, support, values);
  } else {
    status = describe_gathered<D>(n, NoColors{}, key.position, support, values);
  }
}

/// Key points that a thread takes at a time.
inline constexpr std::size_t block_size = 16;

/// Calls work(thread, begin, end) for blocks of [0, count), on `threads` threads of which the caller's is one.
template <class Work>
void for_blocks(std::size_t count, std::size_t threads, const Work& work) {
  std::atomic<std::size_t> next{0};
  const auto run = [&](std::size_t thread) {
    for (std::size_t begin = next.fetch_add(block_size); begin < count; begin = next.fetch_add(block_size)) {
      work(thread, begin, std::min(begin + block_size, count));
    }
  };
  struct Threads : std::vector<std::thread> {
    ~Threads() {  // also when one more thread cannot be started: those that run finish the work
      for (std::thread& thread : *this) thread.join();
    }
  } others;
  others.reserve(threads);
  for (std::size_t t = 1; t < threads; ++t) others.emplace_back(run, t);
  run(0);
}

/// `key_at(i)` gives key point i, or nothing for one outside the cloud.
template <class D, class Search, class KeyAt>
[[nodiscard]] Status extract_all(const CloudView& cloud, const Search& search, std::size_t count, const KeyAt& key_at,
                                 const Support& support, Features<D>& out, unsigned threads) {
  out.values.assign(count * static_cast<std::size_t>(D::size), 0.0f);
  out.neighbors.assign(count, 0);
  const Status usable = check<D>(cloud, search, support);
  out.status.assign(count, usable);
  if (usable != Status::ok) return usable;
  if constexpr (D::needs_colors) {
    out.scratch.lab.resize(cloud.size);
    static_cast<void>(convert_colors<typename D::LabRule>(cloud, out.scratch.lab.data()));  // checked above
  }
  const std::size_t blocks = (count + block_size - 1) / block_size;
  const std::size_t workers = std::max<std::size_t>(1, std::min<std::size_t>(threads, blocks));
  if (out.scratch.workspaces.size() < workers) out.scratch.workspaces.resize(workers);
  for_blocks(count, workers, [&](std::size_t thread, std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      KeyPoint key{};
      if (key_at(row, key)) {
        extract_one(search, key, support, out.scratch.workspaces[thread], out, row);
      } else {
        out.status[row] = Status::bad_keypoint;
      }
    }
  });
  return Status::ok;
}

}  // namespace detail

/// Describe many key points of a cloud, given by their indices (of any integer type; pcl::Indices, too).
///
/// `search`   any search over this cloud (GridSearch, NanoflannSearch, ...)
/// `support`  radii and viewpoint; a plain float is the radius in metres
/// `out`      one row and one Status per key point; a key point that cannot be described spoils no other
/// `threads`  how many threads share the work; the result is the same, bit for bit, for any number
///
/// Returns ok if key points could be looked at at all, else why not, and every row has that status: empty_cloud,
/// bad_view (also: the search is over a cloud of another size), bad_radius, bad_viewpoint, missing_colors, or what the
/// search's build() returned. Allocates: 12 bytes a point for colours, 20 a neighbour and thread, and the rows.
/// May throw what std::vector and std::thread throw (on a thread of its own that ends the program).
template <class D, class Search, class Index, class = std::enable_if_t<std::is_integral<Index>::value>>
[[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<Index>& keypoints,
                             const Support& support, Features<D>& out, unsigned threads = 1) {
  const auto key_at = [&](std::size_t row, KeyPoint& key) {
    const auto index = static_cast<std::size_t>(keypoints[row]);  // a negative one becomes far too large
    if (index >= cloud.size) return false;
    key = keypoint(cloud, index);
    return true;
  };
  return detail::extract_all(cloud, search, keypoints.size(), key_at, support, out, threads);
}

/// The same for key points that need not be points of the cloud, each with its own position and colour.
template <class D, class Search>
[[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<KeyPoint>& keypoints,
                             const Support& support, Features<D>& out, unsigned threads = 1) {
  const auto key_at = [&](std::size_t row, KeyPoint& key) {
    key = keypoints[row];
    return true;
  };
  return detail::extract_all(cloud, search, keypoints.size(), key_at, support, out, threads);
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
