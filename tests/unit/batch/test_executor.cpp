// extract() on an executor of the caller's, whatever that makes of its freedom.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "fixtures.hpp"
#include "thread_pool.hpp"

namespace test_executor {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Scsh336;

constexpr float radius = 0.03f;

/// Says that it has `announced` threads and calls the work `calls` times, one after the other.
struct OneAfterTheOther {
  int announced;
  int calls;
  int runs = 0;
  [[nodiscard]] int threads() const { return announced; }
  template <class Work>
  void run(const Work& work) {
    ++runs;
    for (int i = 0; i < calls; ++i) work();
  }
};

/// Runs on more threads than it announces.
struct Understated {
  ThreadPool pool{4};
  static int threads() { return 1; }
  void run(const std::function<void()>& work) { pool.run(work); }
};

struct Scene {
  TestCloud cloud = curved_surface(11, 10000);
  ss::GridSearch grid{cloud.view(), radius};
  std::vector<std::uint32_t> keypoints;
  ss::Features<D> expected;
  Scene() {
    for (std::uint32_t i = 0; i < 10000; i += 100) keypoints.push_back(i);
    keypoints.push_back(20000);  // outside
    REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, expected) == Status::ok);
  }
  template <class Executor>
  void check_same_on(Executor&& executor) const {
    ss::Features<D> features;
    REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, features, executor) == Status::ok);
    CHECK(same_bits(features.values, expected.values));
    CHECK(features.status == expected.status);
    CHECK(features.neighbors == expected.neighbors);
  }
};

}  // namespace

TEST_CASE("executor: a pool of any size gives the bits of one thread") {
  const Scene scene;
  for (const std::size_t threads : {1u, 2u, 7u}) {
    ThreadPool pool(threads);
    for (int repeat = 0; repeat < 5; ++repeat) scene.check_same_on(pool);
  }
}

TEST_CASE("executor: it may call the work fewer times than announced, or more") {
  const Scene scene;
  scene.check_same_on(OneAfterTheOther{8, 1});
  scene.check_same_on(OneAfterTheOther{1, 8});
  scene.check_same_on(OneAfterTheOther{3, 3});
  scene.check_same_on(OneAfterTheOther{0, 1});
  Understated understated;
  for (int repeat = 0; repeat < 5; ++repeat) scene.check_same_on(understated);
}

TEST_CASE("executor: it runs the conversion of colors and the key points, and nothing where there is nothing to do") {
  const Scene scene;
  OneAfterTheOther executor{2, 2};
  ss::Features<D> colored;
  REQUIRE(ss::extract(scene.cloud.view(), scene.grid, scene.keypoints, radius, colored, executor) == Status::ok);
  CHECK(executor.runs == 2);
  ss::Features<ss::Ssh32> shape;
  REQUIRE(ss::extract(scene.cloud.view(), scene.grid, scene.keypoints, radius, shape, executor) == Status::ok);
  CHECK(executor.runs == 3);
  REQUIRE(ss::extract(scene.cloud.view(), scene.grid, scene.keypoints, -1.0f, shape, executor) == Status::bad_radius);
  CHECK(executor.runs == 3);
}

TEST_CASE("executor: numbers of threads may be of any integer type") {
  const Scene scene;
  scene.check_same_on(2);
  scene.check_same_on(std::size_t{3});
  scene.check_same_on(-1);
  const unsigned none = 0;
  scene.check_same_on(none);
}

TEST_CASE("executor: key points off the cloud are taken, too") {
  const Scene scene;
  ThreadPool pool(2);
  std::vector<ss::KeyPoint> places;
  for (std::size_t i = 0; i + 1 < scene.keypoints.size(); ++i) {
    places.push_back(ss::keypoint(scene.cloud.view(), scene.keypoints[i]));
  }
  ss::Features<D> features;
  REQUIRE(ss::extract(scene.cloud.view(), scene.grid, places, radius, features, pool) == Status::ok);
  for (std::size_t i = 0; i < features.values.size(); ++i) REQUIRE(features.values[i] == scene.expected.values[i]);
}

}  // namespace test_executor
