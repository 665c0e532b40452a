// The normals of a whole cloud: those of estimate_normal() but for rounding, the same bits for any search and threads.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "fixtures.hpp"
#include "pinhole.hpp"
#include "plane_oracle.hpp"
#include "searches.hpp"
#include "thread_pool.hpp"

namespace test_estimate_normals {
namespace {

using namespace unit;
using ss::Status;

using Normals = std::vector<ss::SurfaceNormal>;

template <class Search>
Normals estimated(const ss::CloudView& view, const Search& search, float radius, ss::Point viewpoint = {}) {
  Normals normals;
  REQUIRE(ss::estimate_normals(view, search, radius, ss::Viewpoint::towards(viewpoint), normals) == Status::ok);
  REQUIRE(normals.size() == view.size);
  return normals;
}

/// Point by point.
Normals expected(const ss::CloudView& view, float radius, ss::Point viewpoint = {}) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const ss::BruteSearch brute{view};
  Room room(view.size);
  Normals normals(view.size, {none, none, none});
  for (std::size_t i = 0; i < view.size; ++i) {
    const ss::Point p = ss::point(view, i);
    if (!ss::is_finite(p)) continue;
    ss::Neighborhood n = room.neighborhood();
    REQUIRE(brute.gather(p, radius, n) == Status::ok);
    ss::SurfaceNormal normal{};
    if (ss::estimate_normal(n, radius, normal, ss::Viewpoint::towards(viewpoint)) == Status::ok) normals[i] = normal;
  }
  return normals;
}

/// Both may be off by what oracle_plane() allows.
void require_alike(const TestCloud& cloud, float radius, const Normals& normals, const Normals& alone) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    CAPTURE(i);
    REQUIRE(std::isnan(normals[i].x) == std::isnan(alone[i].x));
    if (std::isnan(normals[i].x)) continue;
    const double sine = to_double(normals[i]).cross(to_double(alone[i])).norm();
    if (sine > 1e-6) REQUIRE(sine <= 2.0 * oracle_plane(cloud, i, radius).bound);
  }
}

void check_cloud(const TestCloud& cloud, float radius, ss::Point viewpoint = {}) {
  const ss::GridSearch grid(cloud.view(), radius);
  require_alike(cloud, radius, estimated(cloud.view(), grid, radius, viewpoint),
                expected(cloud.view(), radius, viewpoint));
}

TestCloud image_with_holes(std::uint32_t seed) {
  TestCloud cloud = pinhole_image(seed, {});
  Random random(seed);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (random.below(7) == 0) cloud.xyz[3 * i + random.below(3)] = random.below(2) == 0 ? not_a_number : infinity;
  }
  return cloud;
}

/// Dense patches, lines, pairs, copies and points alone.
TestCloud medley() {
  TestCloud cloud = curved_surface(21, 1500);
  for (int k = 0; k < 40; ++k) cloud.add(0.001f * static_cast<float>(k), -5.0f, 0.0f);
  for (int k = 0; k < 20; ++k) cloud.add(3.0f, 3.0f, 3.0f);
  Random random(22);
  for (int k = 0; k < 30; ++k) {
    const ss::Point p{random.between(10.0f, 20.0f), random.between(10.0f, 20.0f), random.between(10.0f, 20.0f)};
    cloud.add(p);
    cloud.add(p.x + 0.001f, p.y, p.z);
  }
  add_points(cloud, random, 50, -1e-4f, 1e-4f);
  return cloud;
}

}  // namespace

TEST_CASE("estimate_normals: as every point alone") {
  check_cloud(curved_surface(1, 3000), 0.01f);
  check_cloud(blob(2, 3000), 0.02f, {1.0f, -2.0f, 0.5f});
  check_cloud(medley(), 0.02f);
  check_cloud(medley(), 0.3f);
  check_cloud(curved_surface(2, 4000), 0.1f);  // up to 2047 neighbors, and more
  check_cloud(curved_surface(3, 500), 1e3f);   // much larger than the cloud
  for (std::size_t points = 1; points < 20; ++points) check_cloud(curved_surface(4, points), 0.5f);
}

TEST_CASE("estimate_normals: images, of any shape and with holes, give what their points give") {
  const TestCloud cloud = image_with_holes(5);
  const float radius = 0.06f;
  const Normals normals = expected(cloud.view(), radius);
  for (const std::size_t width : {image_width, std::size_t{1}, std::size_t{3}, cloud.size() / 3, cloud.size(),
                                  std::size_t{7}, std::size_t{0}, ~std::size_t{0}, ~std::size_t{0} / 2 + 1}) {
    const std::size_t height = width == 0 ? 5 : width > cloud.size() ? 2 : cloud.size() / width;
    const ss::CloudView view = ss::organized(cloud.view(), width, height);
    CAPTURE(width);
    require_alike(cloud, radius, estimated(view, ss::GridSearch(view, radius), radius), normals);
  }
}

TEST_CASE("estimate_normals: any search gives the same bits") {
  const TestCloud cloud = image_with_holes(6);
  const ss::CloudView view = ss::organized(cloud.view(), image_width, image_height);
  const float radius = 0.05f;
  const Normals normals = estimated(view, ss::GridSearch(view, radius), radius);
  ss::OrganizedSearch image{};
  REQUIRE(image.build(view) == Status::ok);
  CHECK(same_bits(estimated(view, image, radius), normals));
  CHECK(same_bits(estimated(view, ss::NanoflannSearch(view), radius), normals));
  CHECK(same_bits(estimated(view, ss::BruteSearch{view}, radius), normals));
  CHECK(same_bits(estimated(view, ss::GridSearch(view, 0.013f), radius), normals));
}

TEST_CASE("estimate_normals: any number of threads and any executor gives the same bits") {
  const TestCloud cloud = curved_surface(7, 5000);
  const ss::GridSearch grid(cloud.view(), 0.01f);
  const Normals normals = estimated(cloud.view(), grid, 0.01f);
  Normals others(3);
  for (const int threads : {-1, 0, 2, 3, 64}) {
    REQUIRE(ss::estimate_normals(cloud.view(), grid, 0.01f, ss::Viewpoint::towards({}), others, threads) == Status::ok);
    CHECK(same_bits(others, normals));
  }
  ThreadPool pool(3);
  for (int repeat = 0; repeat < 5; ++repeat) {
    REQUIRE(ss::estimate_normals(cloud.view(), grid, 0.01f, ss::Viewpoint::towards({}), others, pool) == Status::ok);
    CHECK(same_bits(others, normals));
  }
}

TEST_CASE("estimate_normals: near those in double precision, and turned to the viewpoint") {
  const TestCloud cloud = image_with_holes(8);
  const ss::CloudView view = ss::organized(cloud.view(), image_width, image_height);
  const ss::Point viewpoint{0.1f, -0.2f, 5.0f};
  const Normals normals = estimated(view, ss::GridSearch(view, 0.06f), 0.06f, viewpoint);
  for (std::size_t i = 0; i < cloud.size(); i += 5) {
    const ss::Point p = cloud.at(i);
    if (!ss::is_finite(p)) continue;
    require_normal(normals[i], oracle_plane(cloud, i, 0.06f));
    const Eigen::Vector3d towards =
        Eigen::Vector3f(viewpoint.x - p.x, viewpoint.y - p.y, viewpoint.z - p.z).cast<double>();
    REQUIRE(towards.dot(to_double(normals[i])) > -1e-6);
  }
}

TEST_CASE("estimate_normals: points without a normal get NaN in all three") {
  TestCloud cloud = medley();
  cloud.add(0.0f, infinity, 0.0f);
  const Normals normals = estimated(cloud.view(), ss::GridSearch(cloud.view(), 0.02f), 0.02f);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const ss::SurfaceNormal& n = normals[i];
    const bool has_one = i < 1500 || (i >= 1620 && i < 1670);
    REQUIRE(std::isfinite(n.x) == has_one);
    REQUIRE(std::isfinite(n.y) == has_one);
    REQUIRE(std::isfinite(n.z) == has_one);
  }
}

TEST_CASE("estimate_normals: into a view, with a stride") {
  const TestCloud cloud = curved_surface(9, 300);
  const Normals normals = estimated(cloud.view(), ss::GridSearch(cloud.view(), 0.05f), 0.05f);
  CHECK_FALSE(ss::has_normals(cloud.view()));
  const ss::CloudView view = ss::with_normals(cloud.view(), normals.data());
  REQUIRE(ss::has_normals(view));
  REQUIRE(ss::validate(view) == Status::ok);
  struct Padded {
    ss::SurfaceNormal normal;
    float curvature;
  };
  std::vector<Padded> padded;
  for (const ss::SurfaceNormal& n : normals) padded.push_back({n, 7.0f});
  const ss::CloudView strided = ss::with_normals(cloud.view(), &padded[0].normal, sizeof(Padded));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (const ss::SurfaceNormal& n : {ss::normal(view, i), ss::normal(strided, i)}) {
      REQUIRE(std::memcmp(&n, &normals[i], sizeof n) == 0);
    }
  }
  CHECK_FALSE(ss::has_normals(ss::with_normals(view, nullptr)));
}

TEST_CASE("estimate_normals: what cannot be estimated has a status and no normals") {
  const TestCloud cloud = curved_surface(10, 100);
  const ss::GridSearch grid(cloud.view(), 0.05f);
  const auto status = [](const ss::CloudView& view, const ss::GridSearch& search, float radius,
                         ss::Point viewpoint = {}) {
    Normals normals(3);
    const Status result = ss::estimate_normals(view, search, radius, ss::Viewpoint::towards(viewpoint), normals);
    CHECK(normals.empty());
    return result;
  };
  for (const float radius : {0.0f, -1.0f, not_a_number, infinity, 1e30f}) {
    CHECK(status(cloud.view(), grid, radius) == Status::bad_radius);
  }
  CHECK(status(cloud.view(), grid, 0.05f, {0.0f, infinity, 0.0f}) == Status::bad_viewpoint);
  CHECK(status(cloud.view(), grid, 0.05f, {not_a_number, 0.0f, 0.0f}) == Status::bad_viewpoint);
  CHECK(status(ss::view_xyz(nullptr, 5), grid, 0.05f) == Status::bad_view);
  CHECK(status(ss::view_xyz(cloud.xyz.data(), 0), grid, 0.05f) == Status::empty_cloud);
  CHECK(status(ss::view_xyz(cloud.xyz.data(), 50), grid, 0.05f) == Status::bad_view);
  CHECK(status(cloud.view(), ss::GridSearch(cloud.view(), -1.0f), 0.05f) == Status::bad_radius);
  TestCloud invalid;
  invalid.add(not_a_number, 0.0f, 0.0f);
  CHECK(status(invalid.view(), ss::GridSearch(invalid.view(), 0.05f), 0.05f) == Status::empty_cloud);
}

TEST_CASE("estimate_normals: coordinates at the ends of float's range do no harm") {
  TestCloud cloud;
  cloud.add(0.0f, 0.0f, 0.0f);
  for (int k = 0; k < 16; ++k) {
    const float sign = k % 2 == 0 ? 1.0f : -1.0f;
    cloud.add(sign * 3e38f, -sign * 3e38f, static_cast<float>(k));
  }
  const Normals normals = estimated(cloud.view(), ss::BruteSearch{cloud.view()}, 5.0f);
  for (const ss::SurfaceNormal& n : normals) CHECK(std::isnan(n.x));  // two lines
}

}  // namespace test_estimate_normals
