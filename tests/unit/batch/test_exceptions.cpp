// Whatever an executor throws, and whenever: nothing that the caller keeps from call to call passes for what this call
// would have computed. And nothing that was moved from passes for what it was.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "depth_images.hpp"
#include "fixtures.hpp"

namespace test_exceptions {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Scsh336;

constexpr float radius = 0.03f;

struct NoThread : std::runtime_error {
  NoThread() : std::runtime_error("cannot start a thread") {}
};

/// Does `runs` pieces of work, and then cannot: at once, or when the work has been done, too.
struct Failing {
  int runs = 0;
  bool works = false;
  [[nodiscard]] static int threads() { return 2; }
  template <class Work>
  void run(const Work& work) {
    if (runs > 0 || works) work();
    if (runs-- == 0) throw NoThread();
  }
};

const Failing failures[] = {{0, false}, {0, true}, {1, false}, {1, true}};

/// A camera's frame, and what the others' rows must not pass for.
struct Scene {
  TestCloud cloud;
  ss::GridSearch grid;
  std::vector<std::uint32_t> keypoints;
  ss::Features<D> features;
  explicit Scene(std::uint32_t moment)
      : cloud(with_surface_normals(curved_surface(moment, 4000), moment)), grid(cloud.view(), radius) {
    for (std::uint32_t i = moment; i < 4000; i += 400) keypoints.push_back(i);
    REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, features) == Status::ok);
  }
};

/// Whatever is ok is what it should be.
void check_rows(const ss::Features<D>& features, const ss::Features<D>& right) {
  for (std::size_t row = 0; row < features.size(); ++row) {
    const float* const values = features[row];
    if (features.status[row] == Status::ok) {
      REQUIRE(std::vector<float>(values, values + D::size) == std::vector<float>(right[row], right[row] + D::size));
    } else {
      CHECK(features.status[row] == Status::out_of_memory);
      CHECK(all_zero(std::vector<float>(values, values + D::size)));
    }
  }
}

}  // namespace

TEST_CASE("exceptions: rows of the frame before do not outlive an executor that throws") {
  const Scene first(1), second(2);
  ss::Extractor<D> extractor;
  for (const Failing& failure : failures) {
    ss::Features<D> kept = first.features;
    const auto check_thrown = [&](auto&&... how) {  // colors are converted in one run, key points described in another
      Failing executor = failure;
      CHECK_THROWS_AS(static_cast<void>(extractor.extract(second.cloud.view(), second.grid, second.keypoints, how...,
                                                          kept, executor)),
                      NoThread);
      REQUIRE(kept.size() == second.keypoints.size());
      check_rows(kept, second.features);
    };
    check_thrown(radius);
    kept = first.features;
    check_thrown(second.features.frames, ss::Radius(radius));
  }
}

TEST_CASE("exceptions: a row whose own computation throws says out_of_memory, not bad_keypoint") {
  struct ThrowingSearch : ss::BruteSearch {
    using ss::BruteSearch::BruteSearch;
    Status gather(const ss::Point&, ss::Radius, ss::Neighborhood&) const { throw std::bad_alloc(); }
  };
  const Scene first(1), second(2);
  ss::Features<D> kept = first.features;
  const ThrowingSearch search(second.cloud.view());
  CHECK_THROWS_AS(static_cast<void>(ss::extract(second.cloud.view(), search, second.keypoints, radius, kept)),
                  std::bad_alloc);
  REQUIRE(kept.size() == second.keypoints.size());
  CHECK(kept.status == std::vector<Status>(kept.size(), Status::out_of_memory));
  check_rows(kept, second.features);
}

TEST_CASE("exceptions: normals that were not estimated are NaN") {
  const Scene first(1), second(2);
  std::vector<ss::SurfaceNormal> normals, right;
  REQUIRE(ss::estimate_normals(second.cloud.view(), second.grid, radius, {}, right) == Status::ok);
  for (const Failing& failure : {failures[0], failures[1]}) {
    REQUIRE(ss::estimate_normals(first.cloud.view(), first.grid, radius, {}, normals) == Status::ok);
    Failing executor = failure;
    CHECK_THROWS_AS(
        static_cast<void>(ss::estimate_normals(second.cloud.view(), second.grid, radius, {}, normals, executor)),
        NoThread);
    REQUIRE(normals.size() == right.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (!failure.works) REQUIRE_FALSE(ss::extend::math::is_finite(normals[i].x));
      if (failure.works) REQUIRE(normals[i].x == right[i].x);
    }
  }
}

TEST_CASE("exceptions: normals of an image that were not estimated are NaN") {
  const DepthImage first = noisy_ball(1, 0.001f), second = noisy_ball(2, 0.001f);
  ss::ImageNormalEstimator estimator;
  std::vector<ss::SurfaceNormal> normals, right;
  REQUIRE(estimator.estimate(second.view(), radius, {}, right) == Status::ok);
  for (const Failing& failure : {failures[0], failures[1]}) {
    REQUIRE(estimator.estimate(first.view(), radius, {}, normals) == Status::ok);
    Failing executor = failure;
    CHECK_THROWS_AS(static_cast<void>(estimator.estimate(second.view(), radius, {}, normals, executor)), NoThread);
    REQUIRE(normals.size() == right.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (!failure.works) REQUIRE_FALSE(ss::extend::math::is_finite(normals[i].x));
      if (failure.works && ss::extend::math::is_finite(right[i].x)) REQUIRE(normals[i].x == right[i].x);
    }
  }
}

TEST_CASE("exceptions: matches, pairs, objects and shares of before are gone") {
  const Scene first(1), second(2);
  const ss::DescriptorRows a = ss::rows_of(first.features), b = ss::rows_of(second.features);
  ss::Recognizer recognizer;
  REQUIRE(ss::train(recognizer, first.features, {0.0f, 0.0f, 0.0f}, "class", "instance") == Status::ok);
  const auto check_gone = [&](auto& out, const auto& call) {
    REQUIRE(call(out, 1u) == Status::ok);
    REQUIRE(!out.empty());
    CHECK_THROWS_AS(static_cast<void>(call(out, Failing{})), NoThread);
    CHECK(out.empty());
  };
  std::vector<ss::Match> matches;
  check_gone(matches, [&](auto& out, auto&& threads) { return ss::nearest(a, b, 1, out, threads); });
  std::vector<ss::MatchedPair> pairs;
  check_gone(pairs, [&](auto& out, auto&& threads) { return ss::reciprocal_correspondences(a, b, out, threads); });
  check_gone(pairs, [&](auto& out, auto&& threads) { return ss::ratio_correspondences(a, b, 1.0f, out, threads); });
  std::vector<ss::Hypothesis> objects;
  check_gone(objects,
             [&](auto& out, auto&& threads) { return ss::recognize(recognizer, first.features, out, threads); });
  ss::ActivationShares shares;
  REQUIRE(ss::activation_shares(recognizer, first.features, shares) == Status::ok);
  CHECK_THROWS_AS(static_cast<void>(ss::activation_shares(recognizer, first.features, shares, Failing{})), NoThread);
  CHECK(shares.classes.empty());
}

TEST_CASE("exceptions: matches whose distance throws are none") {
  struct Row {
    const Status* status = nullptr;
    std::size_t count = 3;
    [[nodiscard]] static bool fits(const Row&) { return true; }
    [[nodiscard]] static int compare(std::size_t row, const Row&, std::size_t other) { return row == other ? 1 : 2; }
    [[nodiscard]] static float distance(int compared) {
      if (compared == 1) throw NoThread();
      return 1.0f;
    }
  };
  std::vector<ss::Match> matches;
  CHECK_THROWS_AS(static_cast<void>(ss::nearest(Row{}, Row{}, 2, matches)), NoThread);
  for (const ss::Match& match : matches) CHECK(match.row == ss::no_row);
}

TEST_CASE("moved from: a search has nothing to search, and says so; what took it over has all of it") {
  const Scene scene(1);
  ss::GridSearch from = scene.grid;
  ss::GridSearch to(std::move(from));
  const auto extract = [&](const ss::GridSearch& search) {
    ss::Features<D> features = scene.features;
    const Status status = ss::extract(scene.cloud.view(), search, scene.keypoints, radius, features);
    if (status == Status::ok) CHECK(same_bits(features.values, scene.features.values));
    if (status != Status::ok) CHECK(features.status == std::vector<Status>(scene.keypoints.size(), status));
    return status;
  };
  CHECK(from.status() == Status::empty_cloud);  // NOLINT: what is moved from is looked at here, and below
  CHECK(from.cloud_size() == 0);
  CHECK(extract(from) == Status::empty_cloud);
  Room room(10);
  ss::Neighborhood n = room.neighborhood();
  CHECK(from.gather({0.0f, 0.0f, 1.0f}, ss::Radius(radius), n) == Status::empty_cloud);
  CHECK(extract(to) == Status::ok);
  from = std::move(to);
  CHECK(to.status() == Status::empty_cloud);  // NOLINT
  CHECK(extract(from) == Status::ok);
  to = from;
  CHECK(extract(to) == Status::ok);
  REQUIRE(from.build(scene.cloud.view(), radius) == Status::ok);
  CHECK(extract(from) == Status::ok);
}

TEST_CASE("moved from: features have no rows, an extractor and a recognizer are as new") {
  const Scene scene(1);
  ss::Features<D> features = scene.features;
  const ss::Features<D> taken = std::move(features);
  CHECK(features.size() == 0);  // NOLINT
  CHECK(same_bits(taken.values, scene.features.values));

  ss::Extractor<D> extractor;
  REQUIRE(extractor.extract(scene.cloud.view(), scene.grid, scene.keypoints, radius, features) == Status::ok);
  const ss::Extractor<D> other = std::move(extractor);
  REQUIRE(extractor.extract(scene.cloud.view(), scene.grid, scene.keypoints, radius, features, 2) ==  // NOLINT
          Status::ok);
  CHECK(same_bits(features.values, scene.features.values));

  ss::Recognizer recognizer;
  REQUIRE(ss::train(recognizer, scene.features, {0.0f, 0.0f, 0.0f}, "class", "instance") == Status::ok);
  ss::Recognizer moved = std::move(recognizer);
  std::vector<ss::Hypothesis> objects;
  CHECK(ss::recognize(recognizer, scene.features, objects) == Status::not_trained);  // NOLINT
  CHECK(recognizer.row_size() == 0);
  CHECK(recognizer.layout().empty());
  CHECK(recognizer.class_count() == 0);
  REQUIRE(ss::recognize(moved, scene.features, objects) == Status::ok);
  CHECK(!objects.empty());
  ss::Features<ss::Ssh32> shapes;  // what it was trained with before does not count any more
  REQUIRE(ss::extract(scene.cloud.view(), scene.grid, scene.keypoints, radius, shapes) == Status::ok);
  REQUIRE(ss::train(recognizer, shapes, {0.0f, 0.0f, 0.0f}, "class", "instance") == Status::ok);
  CHECK(ss::recognize(recognizer, shapes, objects) == Status::ok);
  moved = std::move(recognizer);
  CHECK(ss::recognize(moved, shapes, objects) == Status::ok);
  CHECK(ss::recognize(recognizer, shapes, objects) == Status::not_trained);  // NOLINT
}

TEST_CASE("moved from: a search by nanoflann cannot be moved") {
  CHECK_FALSE(std::is_move_constructible<ss::NanoflannSearch>::value);
  CHECK_FALSE(std::is_move_assignable<ss::NanoflannSearch>::value);
}

}  // namespace test_exceptions
