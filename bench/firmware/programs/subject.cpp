// The library as a firmware engineer calls it: one configuration, one search (the macro that names it), the caller's
// memory.
#include "subject.hpp"

using shortshot::Status;

namespace {

template <class D, class Search, class... Colors>
Status describe(const Job& job, const Search& search, Colors... colors) {
  return shortshot::describe_at<D, chunk_size>(job.cloud, search, job.index, job.radius, *job.workspace, job.out,
                                               colors...);
}

/// Neighbors into the workspace, and no more.
template <class Search>
Status gather(const Job& job, const Search& search) {
  const shortshot::Point center = shortshot::point(job.cloud, job.index);
  auto neighborhood = shortshot::neighborhood_in(*job.workspace, job.cloud);
  return search.gather(center, job.radius, neighborhood);
}

/// A search that has found its neighbors before: what describe_at() does besides.
struct Given {
  std::size_t points;
  std::uint32_t gathered;
  [[nodiscard]] Status status() const noexcept { return Status::ok; }
  [[nodiscard]] std::size_t cloud_size() const noexcept { return points; }
  template <class Neighborhood>
  [[nodiscard]] Status gather(const shortshot::Point& center, shortshot::Radius, Neighborhood& out) const noexcept {
    out.center = center;
    out.size = gathered;
    out.found = gathered;
    return Status::ok;
  }
};

}  // namespace

extern "C" {

#if defined(BRUTE)
Status describe_brute(const Job* job) { return describe<Configuration>(*job, shortshot::BruteSearch{job->cloud}); }
#if defined(SECOND)
Status describe_second(const Job* job) { return describe<shortshot::SECOND>(*job, shortshot::BruteSearch{job->cloud}); }
#endif

#elif defined(GRID)
Status build_grid(const Job* job) { return job->grid->build(job->cloud, 0.5f * job->radius); }
Status describe_grid(const Job* job) { return describe<Configuration>(*job, *job->grid); }

#elif defined(ORGANIZED)
Status build_organized(const Job* job) { return job->image->build(job->cloud); }
Status describe_organized(const Job* job) { return describe<Configuration>(*job, *job->image); }

#elif defined(GATHER)
Status gather_brute(const Job* job) { return gather(*job, shortshot::BruteSearch{job->cloud}); }
Status gather_grid(const Job* job) { return gather(*job, *job->grid); }

#elif defined(GIVEN)
Status describe_given(const Job* job) { return describe<Configuration>(*job, Given{job->cloud.size, job->gathered}); }

#elif defined(GIVEN_LAB)
Status describe_given_lab(const Job* job) {
  return describe<Configuration>(*job, Given{job->cloud.size, job->gathered}, job->colors);
}
#endif

}  // extern "C"
