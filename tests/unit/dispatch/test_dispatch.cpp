// Wider lanes than the compiler was told of: used where the CPU has them, with the same bits. (Compiled with
// SHORTSHOT_NO_DISPATCH and without it.)
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "fixtures.hpp"

namespace test_dispatch {
namespace {

using namespace unit;
using ss::Status;

constexpr float radius = 0.05f;

/// Lets the library choose again when a test is over.
struct Choice {
  bool has_wider = ss::extend::allow_wider_lanes(true);
  ~Choice() { static_cast<void>(ss::extend::allow_wider_lanes(true)); }
};

/// do_with(0) without wider lanes, do_with(1) with those that there are.
template <class Do>
void both_ways(Do do_with) {
  for (const std::size_t way : {0u, 1u}) {
    static_cast<void>(ss::extend::allow_wider_lanes(way == 1));
    do_with(way);
  }
}

TestCloud surface() {
  TestCloud cloud = curved_surface(3, 3000);
  cloud.add(5.0f, 5.0f, 5.0f);
  cloud.add(not_a_number, 0.0f, 1.0f);
  return cloud;
}

std::vector<std::uint32_t> some_keypoints(const TestCloud& cloud) {
  std::vector<std::uint32_t> keypoints;
  for (std::size_t i = 0; i < cloud.size(); i += 37) keypoints.push_back(static_cast<std::uint32_t>(i));
  keypoints.push_back(static_cast<std::uint32_t>(cloud.size() - 2));
  keypoints.push_back(static_cast<std::uint32_t>(cloud.size() - 1));
  return keypoints;
}

template <class D>
ss::Features<D> extracted(const ss::CloudView& cloud, const std::vector<std::uint32_t>& keypoints, bool wide) {
  static_cast<void>(ss::extend::allow_wider_lanes(wide));
  const ss::GridSearch grid(cloud, radius);
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud, grid, keypoints, ss::Support(radius), features) == Status::ok);
  return features;
}

template <class D>
void check_same_bits(const ss::CloudView& cloud, const std::vector<std::uint32_t>& keypoints) {
  CAPTURE(D::size);
  const ss::Features<D> narrow = extracted<D>(cloud, keypoints, false);
  const ss::Features<D> wide = extracted<D>(cloud, keypoints, true);
  CHECK(same_bits(narrow.values, wide.values));
  CHECK(narrow.status == wide.status);
  CHECK(narrow.neighbors == wide.neighbors);
  CHECK(same_bits(narrow.frames, wide.frames));
  CHECK(same_bits(narrow.frame_confidence, wide.frame_confidence));
}

/// A signal that the library does not have.
struct Height : ss::extend::Signal<4> {
  template <class At>
  [[nodiscard]] static ss::extend::simd::F32 measure(const At& at) noexcept {
    return at.local.z * ss::extend::simd::all(8.0f) + ss::extend::simd::all(0.5f);
  }
};

}  // namespace

TEST_CASE("dispatch: AVX2 is used where the CPU has it, unless it is not allowed") {
  const Choice choice;
#if defined(SHORTSHOT_HAS_KERNEL_FOR_AVX2)
  CHECK(choice.has_wider == (__builtin_cpu_supports("avx2") != 0));
  CHECK(shortshot_avx2::extend::simd::lanes == 8);
#else
  CHECK_FALSE(choice.has_wider);
#endif
  CHECK_FALSE(ss::extend::allow_wider_lanes(false));
}

TEST_CASE("dispatch: every descriptor has the same bits, frames and statuses with wider lanes") {
  const Choice choice;
  const TestCloud cloud = surface();
  const std::vector<std::uint32_t> keypoints = some_keypoints(cloud);
  std::vector<ss::SurfaceNormal> normals;
  const ss::GridSearch grid(cloud.view(), radius);
  REQUIRE(ss::estimate_normals(cloud.view(), grid, radius, ss::Viewpoint::towards({}), normals) == Status::ok);
  const std::vector<float> echo(cloud.size(), 0.5f);
  const ss::CloudView view = ss::with_intensities(ss::with_normals(cloud.view(), normals.data()), echo.data());
  check_same_bits<ss::Ssh32>(view, keypoints);
  check_same_bits<ss::Scsh336>(view, keypoints);
  check_same_bits<ss::IntensityShape336>(view, keypoints);
  check_same_bits<ss::Shot352>(view, keypoints);
  check_same_bits<ss::PclCshot1344>(view, keypoints);
  check_same_bits<ss::ShapeColor95>(view, keypoints);
  check_same_bits<ss::RoomColor95>(view, keypoints);
  check_same_bits<ss::ColorRings27>(view, keypoints);
}

TEST_CASE("dispatch: the same key points") {
  const Choice choice;
  const TestCloud cloud = surface();
  std::vector<std::uint32_t> keypoints[2];
  std::vector<ss::KeyPoint> centroids[2];
  both_ways([&](std::size_t way) {
    REQUIRE(ss::sample_uniform(cloud.view(), 0.02f, keypoints[way]) == Status::ok);
    REQUIRE(ss::sample_centroids(cloud.view(), 0.02f, centroids[way]) == Status::ok);
  });
  CHECK(keypoints[0] == keypoints[1]);
  REQUIRE(centroids[0].size() == centroids[1].size());
  for (std::size_t k = 0; k < centroids[0].size(); ++k) {
    CHECK(std::memcmp(&centroids[0][k].position, &centroids[1][k].position, sizeof(ss::Point)) == 0);
  }
}

TEST_CASE("dispatch: the same normals") {
  const Choice choice;
  const TestCloud cloud = surface();
  std::vector<ss::SurfaceNormal> normals[2];
  both_ways([&](std::size_t way) {
    const ss::GridSearch grid(cloud.view(), radius);
    REQUIRE(ss::estimate_normals(cloud.view(), grid, radius, ss::Viewpoint::towards({0.1f, 0.2f, 3.0f}),
                                 normals[way]) == Status::ok);
  });
  REQUIRE(normals[0].size() == cloud.size());
  CHECK(normals[0][7].x == normals[0][7].x);
  CHECK(same_bits(normals[0], normals[1]));
}

TEST_CASE("dispatch: the same matches") {
  const Choice choice;
  const TestCloud cloud = surface();
  const ss::Features<ss::Scsh336> rows = extracted<ss::Scsh336>(cloud.view(), some_keypoints(cloud), false);
  std::vector<ss::Match> matches[2];
  both_ways([&](std::size_t way) {
    REQUIRE(ss::nearest(ss::rows_of(rows), ss::rows_of(rows), 3, matches[way]) == Status::ok);
  });
  REQUIRE(matches[0].size() == 3 * rows.size());
  CHECK(same_bits(matches[0], matches[1]));
}

TEST_CASE("dispatch: a signal of the caller's own is measured as ever") {
  using D = ss::Descriptor<ss::HardVoting, ss::Part<ss::SphericalGrid<1, 2, 4>, Height>>;
  const Choice choice;
  const TestCloud cloud = surface();
  check_same_bits<D>(cloud.view(), some_keypoints(cloud));
}

TEST_CASE("dispatch: frames of the caller's own") {
  const Choice choice;
  const TestCloud cloud = surface();
  const std::vector<std::uint32_t> keypoints = some_keypoints(cloud);
  const ss::GridSearch grid(cloud.view(), radius);
  std::vector<ss::Frame> frames(keypoints.size(), ss::Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  frames[1] = {};
  ss::Features<ss::ShapeColor32> features[2];
  both_ways([&](std::size_t way) {
    REQUIRE(ss::extract(cloud.view(), grid, keypoints, frames, radius, features[way]) == Status::ok);
  });
  CHECK(features[1].status[1] == Status::bad_frame);
  CHECK(same_bits(features[0].values, features[1].values));
  CHECK(features[0].status == features[1].status);
}

}  // namespace test_dispatch
