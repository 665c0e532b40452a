// shortshot/batch/extract.hpp: many key points at once, in one call. Hosted only: allocates, starts threads.
#pragma once

#include <vector>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../kernel/support.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "extractor.hpp"
#include "features.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Describe many key points of a cloud. Whoever describes cloud after cloud keeps an Extractor, whose extract() is the
/// same and uses its memory again.
///
/// `search`     any search over this cloud (GridSearch, NanoflannSearch, ...)
/// `keypoints`  indices into the cloud (of any integer type; pcl::Indices, too), or KeyPoints, which need not be points
///              of it, each with its own color and intensity; out.keypoints, too (they are copied before)
/// `support`    radii and viewpoint; a plain float is the radius in meters
/// `out`        one row and one Status per key point; a key point that cannot be described spoils no other
/// `threads`    how many threads share the work, or an executor, which runs it on threads that are there already; the
///              result is the same, bit for bit, for any number
/// `own`        sources of yours for D's signals, which come before those that the cloud has
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
/// missing_normals, missing_intensities, what the search's build() returned, other_cloud (neighbors do not lie where
/// the cloud has them: the search is over another one, or its memory was written to since) or coarse_coordinates (those
/// of all key points; else of the row alone). For allocation and exceptions see Extractor.
///
/// Key points on top of each other in a crowded place are described once for each thread, but not in frames of the
/// caller's.
template <class D, class Search, class Key, class Threads = unsigned, class... Own>
[[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                             const Support& support, Features<D>& out, Threads&& threads = 1u, const Own&... own) {
  return Extractor<D>().extract(cloud, search, keypoints, support, out, threads, own...);
}

/// The same in frames that the caller knows, one for each key point: bad_rows if there are not as many; bad_frame for a
/// key point whose frame is not orthonormal.
template <class D, class Search, class Key, class Threads = unsigned, class... Own>
[[nodiscard]] Status extract(const CloudView& cloud, const Search& search, const std::vector<Key>& keypoints,
                             const std::vector<Frame>& frames, Radius radius, Features<D>& out, Threads&& threads = 1u,
                             const Own&... own) {
  return Extractor<D>().extract(cloud, search, keypoints, frames, radius, out, threads, own...);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
