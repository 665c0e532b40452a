// A streaming robot: from the second frame on nothing is allocated. This file counts what the whole test program
// allocates: operator new, and, where the C library allows it and no sanitizer has it already, malloc itself.
#include <doctest/doctest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <vector>

#include "depth_images.hpp"
#include "fixtures.hpp"
#include "thread_pool.hpp"

namespace {

std::atomic<std::size_t> allocations{0};
std::atomic<long> until_failure{-1};  // calls of operator new that are granted before one throws; below 0: all are

}  // namespace

#if defined(__has_feature)  // clang's way to say what GCC says by a macro
#if __has_feature(address_sanitizer)
#define SHORTSHOT_TEST_OWN_MALLOC
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define SHORTSHOT_TEST_OWN_MALLOC
#endif
#if defined(__GLIBC__) && !defined(SHORTSHOT_TEST_OWN_MALLOC)
extern "C" {
void* __libc_malloc(std::size_t size);                       // NOLINT: the C library's own name
void* __libc_calloc(std::size_t count, std::size_t size);    // NOLINT
void* __libc_realloc(void* memory, std::size_t size);        // NOLINT
void* __libc_memalign(std::size_t align, std::size_t size);  // NOLINT
void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t align, std::size_t size) noexcept {
  ++allocations;
  return __libc_memalign(align, size);
}
}
#endif

// The one that does not throw as well: a sanitizer's own would not go together with the delete below.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}
void* operator new(std::size_t size) {
  if (until_failure >= 0 && until_failure-- == 0) throw std::bad_alloc();
  if (void* memory = operator new(size, std::nothrow)) return memory;
  throw std::bad_alloc();
}
// Not in line: GCC 12 would see free() of what operator new gave and warn, whatever that does.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace test_allocation {
namespace {

using namespace unit;
using ss::Status;

constexpr float radius = 0.02f;
constexpr std::size_t points = 20000;

/// The scene as the camera sees it at some moment: as many points as before, other ones.
struct Frame {
  TestCloud cloud;
  std::vector<std::uint32_t> keypoints;
  explicit Frame(std::uint32_t moment) : cloud(with_surface_normals(curved_surface(moment, points), moment)) {
    for (std::uint32_t i = moment; i < points; i += 100) keypoints.push_back(i);
    keypoints.resize(150);
  }
};

/// Allocations of each frame but the first.
template <class D, class Color = ss::Lab, class Threads>
std::vector<std::size_t> steady_allocations(Threads&& threads) {
  std::vector<Frame> frames;
  for (std::uint32_t moment = 0; moment < 8; ++moment) frames.emplace_back(moment);
  std::vector<std::size_t> counts;
  counts.reserve(frames.size());
  ss::GridSearch search;
  ss::KeypointSampler sampler;
  std::vector<std::uint32_t> sampled;
  std::vector<ss::KeyPoint> centroids;
  ss::Extractor<D, Color> extractor;
  ss::Features<D> features;
  for (const Frame& frame : frames) {
    const std::size_t before = allocations;
    const Status chosen = sampler.sample_uniform(frame.cloud.view(), 0.2f, sampled);  // as many voxels in each frame
    const Status averaged = sampler.sample_centroids(frame.cloud.view(), 0.2f, centroids);
    const Status built = search.build(frame.cloud.view(), radius);
    const Status status = extractor.extract(frame.cloud.view(), search, frame.keypoints, radius, features, threads);
    counts.push_back(allocations - before);
    REQUIRE(chosen == Status::ok);
    REQUIRE(averaged == Status::ok);
    REQUIRE(built == Status::ok);
    REQUIRE(status == Status::ok);
    REQUIRE(features.status == std::vector<Status>(frame.keypoints.size(), Status::ok));
  }
  CHECK(counts.front() > 0);  // the first frame must be seen to allocate
  return {counts.begin() + 1, counts.end()};
}

const std::vector<std::size_t> none(7, 0);

}  // namespace

TEST_CASE("allocation: one thread allocates nothing from the second frame on") {
  CHECK(steady_allocations<ss::Scsh336>(1) == none);
  CHECK(steady_allocations<ss::Scsh336, ss::PackedLab>(1) == none);
  CHECK(steady_allocations<ss::Ssh32>(1) == none);
  CHECK(steady_allocations<ss::Shot352>(1) == none);
  CHECK(steady_allocations<ss::Cshot1344>(1) == none);
}

TEST_CASE("allocation: normals of depth images need none from the second frame on, on one thread or an executor's") {
  const DepthImage frames[3] = {noisy_ball(1, 0.001f), noisy_ball(2, 0.001f), with_holes(noisy_ball(3, 0.001f), 4, 5)};
  ThreadPool pool(3);
  const auto count = [&](auto&& threads) {
    ss::ImageNormalEstimator estimator;
    std::vector<ss::SurfaceNormal> normals;
    std::vector<std::size_t> counts;
    counts.reserve(3);
    for (const DepthImage& frame : frames) {
      const ss::CloudView view = frame.view();
      const std::size_t before = allocations;
      const Status status =
          estimator.estimate(view, radius * static_cast<float>(counts.size() + 1), {}, normals, threads);
      counts.push_back(allocations - before);
      REQUIRE(status == Status::ok);
    }
    CHECK(counts[0] > 0);
    CHECK(counts[1] == 0);
    CHECK(counts[2] == 0);
  };
  count(1);
  count(pool);
}

TEST_CASE("allocation: the kernel allocates nothing, not even at first") {
  const Frame frame(1);
  static ss::Workspace<2000> workspace;
  static float out[ss::Cshot1344::size];
  const ss::CloudView view = frame.cloud.view();
  const ss::BruteSearch search{view};
  const std::size_t before = allocations;
  const Status shot = ss::describe_at<ss::Shot352>(view, search, 0, radius, workspace, out);
  const Status cshot = ss::describe_at<ss::Cshot1344>(view, search, 0, radius, workspace, out);
  const Status pcl = ss::describe_at<ss::PclCshot1344>(view, search, 0, radius, workspace, out);
  const std::size_t after = allocations;
  CHECK(after == before);
  CHECK(shot == Status::ok);
  CHECK(cshot == Status::ok);
  CHECK(pcl == Status::ok);
}

TEST_CASE("allocation: an executor's threads allocate nothing from the second frame on") {
  ThreadPool pool(3);
  CHECK(steady_allocations<ss::Scsh336>(pool) == none);
  CHECK(steady_allocations<ss::Scsh336, ss::PackedLab>(pool) == none);
  CHECK(steady_allocations<ss::Ssh32>(pool) == none);
  CHECK(steady_allocations<ss::Cshot1344>(pool) == none);
}

TEST_CASE("allocation: threads that are started are the only thing that is allocated") {
  for (const std::size_t count : steady_allocations<ss::Ssh32>(3)) {
    CHECK(count > 0);   // the count is seen to work on other threads' behalf
    CHECK(count <= 8);  // two threads and their list, counted once by operator new and once by malloc; C runtime's own
  }
}

namespace {

/// Makes the first allocation of a call fail, then the second, and so on until the call ends: check() after each.
template <class Prepare, class Call, class Check>
void fail_one_after_the_other(const Prepare& prepare, const Call& call, const Check& check) {
  for (long granted = 0; granted < 1000; ++granted) {
    prepare();
    bool failed = false;
    Status status = Status::ok;
    until_failure = granted;
    try {
      status = call();
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    until_failure = -1;
    check();
    if (failed) continue;
    CHECK(status == Status::ok);
    CHECK(granted > 0);  // the first one must be seen to fail
    return;
  }
  CHECK(false);
}

template <class D>
ss::Features<D> features_of(const Frame& frame) {
  ss::Features<D> features;
  const ss::GridSearch search(frame.cloud.view(), radius);
  REQUIRE(ss::extract(frame.cloud.view(), search, frame.keypoints, radius, features) == Status::ok);
  return features;
}

/// What is ok must be a row of `right`.
template <class D>
void check_rows(const ss::Features<D>& features, const ss::Features<D>& right) {
  for (std::size_t row = 0; row < features.size(); ++row) {
    if (features.status[row] != Status::ok) continue;
    REQUIRE(std::vector<float>(features[row], features[row] + D::size) ==
            std::vector<float>(right[row], right[row] + D::size));
    REQUIRE(features.keypoints[row].position.x == right.keypoints[row].position.x);
    REQUIRE(features.frames[row].x[0] == right.frames[row].x[0]);
  }
}

}  // namespace

TEST_CASE("allocation: whichever fails in extract() and describe_cloud(), what is ok was computed in that call") {
  using D = ss::Scsh336;
  const Frame first(1), second(2);
  const ss::Features<D> before = features_of<D>(first), right = features_of<D>(second);
  const ss::GridSearch search(second.cloud.view(), radius);
  ss::Features<D> kept;
  fail_one_after_the_other([&] { kept = before; },
                           [&] { return ss::extract(second.cloud.view(), search, second.keypoints, radius, kept); },
                           [&] { check_rows(kept, right); });
  ss::CloudOptions options;
  options.best_frames = 0.5f;
  ss::Features<D> described;
  REQUIRE(ss::describe_cloud(second.cloud.view(), options, described) == Status::ok);
  options.best_frames = 1.0f;
  ss::Features<D> all;
  REQUIRE(ss::describe_cloud(second.cloud.view(), options, all) == Status::ok);
  options.best_frames = 0.5f;
  fail_one_after_the_other([&] { kept = before; },
                           [&] { return ss::describe_cloud(second.cloud.view(), options, kept); },
                           [&] { check_rows(kept, all); });
  CHECK(kept.status == described.status);
}

TEST_CASE("allocation: whichever fails in estimate_normals(), store() and a grid, nothing of before is left") {
  using D = ss::Ssh32;
  const Frame first(1), second(2);
  const ss::GridSearch search(second.cloud.view(), radius);
  const std::vector<ss::SurfaceNormal> others(100, {0.0f, 0.0f, 1.0f});
  std::vector<ss::SurfaceNormal> normals;
  fail_one_after_the_other([&] { normals = others; },
                           [&] { return ss::estimate_normals(second.cloud.view(), search, radius, {}, normals); },
                           [&] { CHECK((normals.empty() || normals.size() == points)); });

  const ss::Features<D> before = features_of<D>(first), features = features_of<D>(second);
  using Stored = ss::StoredFeatures<ss::ByteDescriptor<D>>;
  Stored stored, stored_before;
  REQUIRE(ss::store(before, stored_before) == Status::ok);
  fail_one_after_the_other([&] { stored = stored_before; }, [&] { return ss::store(features, stored); },
                           [&] {
                             const bool whole = stored.descriptors.size() == features.size() &&
                                                stored.frames.size() == features.size() &&
                                                stored.neighbors == features.neighbors;
                             CHECK((stored.size() == 0 || whole));
                           });

  ss::GridSearch grid;
  const auto check_grid = [&] {
    ss::Features<D> found;
    const Status status = ss::extract(second.cloud.view(), grid, second.keypoints, radius, found);
    CHECK((status != Status::ok || found.values == features.values));
  };
  fail_one_after_the_other([&] { grid = ss::GridSearch(); }, [&] { return grid.build(second.cloud.view(), radius); },
                           check_grid);
  const ss::GridSearch full(second.cloud.view(), radius / 4), smaller(second.cloud.view(), radius);
  fail_one_after_the_other([&] { grid = smaller; },
                           [&] {
                             grid = full;
                             return Status::ok;
                           },
                           check_grid);
}

}  // namespace test_allocation
