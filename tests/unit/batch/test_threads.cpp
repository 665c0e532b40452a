// Several threads at once: calls over the same cloud, search and recognizer, and executors whose work throws. Looked at
// by the thread sanitizer as well (preset "threads").
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

#include "fixtures.hpp"
#include "synthetic_objects.hpp"

namespace test_threads {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Scsh336;

constexpr float radius = 0.03f;

/// Calls all functions at once, each on a thread of its own.
template <class... Functions>
void at_once(const Functions&... functions) {
  std::thread threads[] = {std::thread(functions)...};
  for (std::thread& thread : threads) thread.join();
}

/// Like TBB: what the work throws on any of its threads is thrown to the caller, when all have come to their end.
struct Rethrowing {
  [[nodiscard]] static int threads() { return 3; }
  template <class Work>
  void run(const Work& work) const {
    std::mutex mutex;
    std::exception_ptr thrown;
    const auto guarded = [&] {
      try {
        work();
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        thrown = std::current_exception();
      }
    };
    at_once(guarded, guarded, guarded);
    if (thrown) std::rethrow_exception(thrown);
  }
};

/// Has no memory for places far from the origin.
struct ThrowingSearch : ss::BruteSearch {
  using ss::BruteSearch::BruteSearch;
  template <class Neighbors>
  Status gather(const ss::Point& center, ss::Radius r, Neighbors& out) const {
    if (center.x > 0.05f) throw std::bad_alloc();
    return ss::BruteSearch::gather(center, r, out);
  }
};

struct Scene {
  TestCloud cloud = with_surface_normals(curved_surface(5, 3000), 5);
  ss::GridSearch grid{cloud.view(), radius};
  std::vector<std::uint32_t> keypoints;
  ss::Features<D> expected;
  Scene() {
    for (std::uint32_t i = 0; i < 3000; i += 40) keypoints.push_back(i);
    REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, expected) == Status::ok);
  }
};

}  // namespace

TEST_CASE("threads: calls over one cloud and one search run at the same time") {
  const Scene scene;
  const ss::CloudView cloud = scene.cloud.view();
  ss::Features<D> first, second;
  ss::Features<ss::Shot352> third;
  std::vector<ss::SurfaceNormal> normals;
  Status status[4] = {};
  at_once([&] { status[0] = ss::extract(cloud, scene.grid, scene.keypoints, radius, first, 2); },
          [&] { status[1] = ss::extract(cloud, scene.grid, scene.keypoints, radius, second, 3); },
          [&] { status[2] = ss::extract(cloud, scene.grid, scene.keypoints, radius, third, 2); },
          [&] { status[3] = ss::estimate_normals(cloud, scene.grid, 0.01f, {}, normals, 2); });
  for (const Status each : status) CHECK(each == Status::ok);
  CHECK(same_bits(first.values, scene.expected.values));
  CHECK(same_bits(second.values, scene.expected.values));
  CHECK(normals.size() == cloud.size);
}

TEST_CASE("threads: work that throws on one of several threads leaves rows that say so, and right ones") {
  const Scene scene;
  const ThrowingSearch search(scene.cloud.view());
  ss::Features<D> features;
  CHECK_THROWS_AS(
      static_cast<void>(ss::extract(scene.cloud.view(), search, scene.keypoints, radius, features, Rethrowing{})),
      std::bad_alloc);
  REQUIRE(features.size() == scene.keypoints.size());
  for (std::size_t row = 0; row < features.size(); ++row) {
    if (features.status[row] == Status::out_of_memory) continue;
    REQUIRE(features.status[row] == scene.expected.status[row]);
    REQUIRE(std::vector<float>(features[row], features[row] + D::size) ==
            std::vector<float>(scene.expected[row], scene.expected[row] + D::size));
  }
  std::vector<ss::SurfaceNormal> normals;
  CHECK_THROWS_AS(
      static_cast<void>(ss::estimate_normals(scene.cloud.view(), search, radius, {}, normals, Rethrowing{})),
      std::bad_alloc);
}

TEST_CASE("threads: one recognizer and one database answer several at the same time") {
  const View object = synthetic_object(1, 150);
  ss::Recognizer recognizer;
  REQUIRE(ss::train(recognizer, object.rows(), synthetic_layout, {}, "mug", "red") == Status::ok);
  std::vector<ss::Hypothesis> first, second;
  std::vector<ss::Match> third;
  std::vector<ss::MatchedPair> fourth;
  Status status[4] = {};
  const ss::DescriptorRows rows = object.rows().descriptors;
  at_once([&] { status[0] = ss::recognize(recognizer, object.rows(), synthetic_layout, first, 2); },
          [&] { status[1] = ss::recognize(recognizer, object.rows(), synthetic_layout, second, 3); },
          [&] { status[2] = ss::nearest(rows, rows, 2, third, 2); },
          [&] { status[3] = ss::reciprocal_correspondences(rows, rows, fourth, 3); });
  for (const Status each : status) CHECK(each == Status::ok);
  REQUIRE(!first.empty());
  CHECK(same_bits(first, second));
  CHECK(fourth.size() == object.size());
}

}  // namespace test_threads
