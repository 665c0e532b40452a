// The normal of one neighborhood, against principal components in double precision; and its refusals.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "fixtures.hpp"
#include "plane_oracle.hpp"

namespace test_normals {
namespace {

using namespace unit;
using ss::Status;

Status normal_at(const TestCloud& cloud, const ss::Point& center, ss::Radius radius, ss::SurfaceNormal& normal,
                 const ss::Viewpoint& viewpoint = {}) {
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(center, radius, n) == Status::ok);
  normal = {not_a_number, not_a_number, not_a_number};
  return ss::estimate_normal(n, radius, normal, viewpoint);
}

bool is_zero(const ss::SurfaceNormal& n) { return all_zero({n.x, n.y, n.z}); }

Status refused(const TestCloud& cloud, float radius = 0.1f) {
  ss::SurfaceNormal normal{};
  const Status status = normal_at(cloud, cloud.at(0), radius, normal);
  CHECK(is_zero(normal));
  return status;
}

/// Every 8th point's normal, a unit vector, is within the bound of the oracle's.
void check_normals(const TestCloud& cloud, float radius) {
  for (std::size_t i = 0; i < cloud.size(); i += 8) {
    ss::SurfaceNormal normal{};
    REQUIRE(normal_at(cloud, cloud.at(i), radius, normal) == Status::ok);
    require_normal(normal, oracle_plane(cloud, i, radius));
  }
}

/// A square of 20 cm with bumps of up to `bumps` along its normal.
TestCloud tilted_square(const Eigen::Vector3f& normal, float bumps, std::size_t points) {
  Random random(7);
  const Eigen::Vector3f u = normal.unitOrthogonal();
  const Eigen::Vector3f v = normal.cross(u);
  TestCloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const float a = random.between(-0.1f, 0.1f);
    const float b = random.between(-0.1f, 0.1f);
    const Eigen::Vector3f p = a * u + b * v + random.between(0.0f, bumps) * normal;
    cloud.add(p.x(), p.y(), p.z());
  }
  return cloud;
}

TestCloud moved(const TestCloud& cloud, float scale, float offset) {
  TestCloud result;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const ss::Point p = cloud.at(i);
    result.add(scale * p.x + offset, scale * p.y - offset, scale * p.z + offset);
  }
  return result;
}

}  // namespace

TEST_CASE("normals: of smooth surfaces, boxes of points and squares at any angle") {
  check_normals(curved_surface(1, 2000), 0.02f);
  check_normals(curved_surface(2, 2000), 0.1f);
  check_normals(blob(3, 2000), 0.05f);
  Random random(4);
  for (int k = 0; k < 20; ++k) {
    const float x = random.between(-1.0f, 1.0f), y = random.between(-1.0f, 1.0f);
    const Eigen::Vector3f normal = Eigen::Vector3f(x, y, random.between(-1.0f, 1.0f)).normalized();
    for (const float bumps : {0.0f, 1e-5f, 5e-3f}) check_normals(tilted_square(normal, bumps, 400), 0.04f);
  }
}

TEST_CASE("normals: exactly those of the coordinate planes") {
  Random random(5);
  for (int axis = 0; axis < 3; ++axis) {
    TestCloud cloud;
    for (int k = 0; k < 200; ++k) {
      float p[3] = {random.between(0.0f, 0.1f), random.between(0.0f, 0.1f), random.between(0.0f, 0.1f)};
      p[axis] = 0.7f;
      cloud.add(p[0], p[1], p[2]);
    }
    const auto up = ss::Viewpoint::towards({9.0f, 9.0f, 9.0f});
    ss::SurfaceNormal n{};
    REQUIRE(normal_at(cloud, cloud.at(0), 0.05f, n, up) == Status::ok);
    CHECK(n.x == (axis == 0 ? 1.0f : 0.0f));
    CHECK(n.y == (axis == 1 ? 1.0f : 0.0f));
    CHECK(n.z == (axis == 2 ? 1.0f : 0.0f));
  }
}

TEST_CASE("normals: of a sphere they are its radii") {
  Random random(6);
  TestCloud cloud;
  for (int k = 0; k < 20000; ++k) {
    const Eigen::Vector3f p(random.between(-1.0f, 1.0f), random.between(-1.0f, 1.0f), random.between(-1.0f, 1.0f));
    if (p.norm() > 0.1f && p.norm() < 1.0f) cloud.add(p.x() / p.norm(), p.y() / p.norm(), p.z() / p.norm());
  }
  for (std::size_t i = 0; i < cloud.size(); i += 100) {
    const ss::Point p = cloud.at(i);
    const auto outside = ss::Viewpoint::away_from({0.0f, 0.0f, 0.0f});
    ss::SurfaceNormal n{};
    REQUIRE(normal_at(cloud, p, 0.2f, n, outside) == Status::ok);
    CHECK(p.x * n.x + p.y * n.y + p.z * n.z > 0.999f);  // neighbors are few: their centroid is a little off
    require_normal(n, oracle_plane(cloud, i, 0.2f));
  }
}

TEST_CASE("normals: far from the origin, and in millimeters, nanometers and light years") {
  const TestCloud cloud = curved_surface(8, 1500);
  check_normals(moved(cloud, 1.0f, 100.0f), 0.03f);
  for (const float scale : {1e3f, 1e-9f, 1e16f, 1e-16f}) check_normals(moved(cloud, scale, 0.0f), 0.03f * scale);
}

TEST_CASE("normals: of few members of a far larger radius, and of very many") {
  TestCloud cloud;
  const TestCloud patch = curved_surface(9, 60);
  for (std::size_t i = 0; i < patch.size(); ++i) cloud.add(patch.at(i));
  check_normals(cloud, 1.0f);
  check_normals(cloud, 1e4f);
  check_normals(curved_surface(10, 6000), 0.15f);
}

TEST_CASE("normals: a radius smaller than that of the neighborhood, in any order of the neighbors, has the same bits") {
  const TestCloud cloud = curved_surface(11, 3000);
  Random random(12);
  Room room(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); i += 100) {
    const ss::Point p = cloud.at(i);
    const auto towards = ss::Viewpoint::towards({0.0f, 0.0f, 0.0f});
    ss::SurfaceNormal expected{};
    REQUIRE(normal_at(cloud, p, 0.03f, expected, towards) == Status::ok);
    ss::Neighborhood n = room.neighborhood();
    REQUIRE(ss::BruteSearch{cloud.view()}.gather(p, 0.04f, n) == Status::ok);
    for (std::uint32_t k = n.size - 1; k > 0; --k) {
      const std::size_t other = random.below(k + 1);
      for (float* values : {n.dx, n.dy, n.dz, n.d2}) std::swap(values[k], values[other]);
      std::swap(n.index[k], n.index[other]);
    }
    ss::SurfaceNormal shuffled{};
    REQUIRE(ss::estimate_normal(n, 0.03f, shuffled, towards) == Status::ok);
    CHECK(std::memcmp(&shuffled, &expected, sizeof expected) == 0);
  }
}

TEST_CASE("normals: turned to the viewpoint, at whatever distance it is; without one only the sign differs") {
  const TestCloud cloud = tilted_square(Eigen::Vector3f(0.0f, 0.6f, 0.8f), 0.001f, 300);
  for (const float distance : {0.01f, 1.0f, 1e20f}) {
    const ss::Point p = cloud.at(0);
    const auto above = ss::Viewpoint::towards({p.x, p.y, p.z + distance});
    const auto below = ss::Viewpoint::away_from({p.x, p.y, p.z + distance});
    ss::SurfaceNormal up{}, down{}, any{};
    REQUIRE(normal_at(cloud, cloud.at(0), 0.05f, up, above) == Status::ok);
    REQUIRE(normal_at(cloud, cloud.at(0), 0.05f, down, below) == Status::ok);
    REQUIRE(normal_at(cloud, cloud.at(0), 0.05f, any) == Status::ok);
    CHECK(up.z > 0.7f);
    CHECK(up.x == -down.x);
    CHECK(up.y == -down.y);
    CHECK(up.z == -down.z);
    CHECK(std::abs(any.z) == up.z);
  }
}

TEST_CASE("normals: fewer than three neighbors have none, three and their copies have one") {
  TestCloud cloud;
  cloud.add(0.0f, 0.0f, 1.0f);
  CHECK(refused(cloud) == Status::too_few_neighbors);
  cloud.add(0.01f, 0.0f, 1.0f);
  CHECK(refused(cloud) == Status::too_few_neighbors);
  cloud.add(not_a_number, 0.0f, 1.0f);
  cloud.add(0.0f, 5.0f, 1.0f);
  CHECK(refused(cloud) == Status::too_few_neighbors);
  cloud.add(0.01f, 0.01f, 1.0f);
  const auto up = ss::Viewpoint::towards({0.0f, 0.0f, 9.0f});
  for (int copies = 0; copies < 10; ++copies) {
    ss::SurfaceNormal n{};
    REQUIRE(normal_at(cloud, cloud.at(0), 0.1f, n, up) == Status::ok);
    CHECK(n.x == doctest::Approx(0.0));
    CHECK(n.y == doctest::Approx(0.0));
    CHECK(n.z == doctest::Approx(1.0));
    cloud.add(cloud.at(copies % 2 == 0 ? 0 : 4));
  }
}

TEST_CASE("normals: neighbors in one place, in two, or on a line have none") {
  Random random(13);
  for (int k = 0; k < 2000; ++k) {
    const int points = 3 + static_cast<int>(random.below(60));
    // Whole numbers, so that the points really lie on the line.
    const auto step = [&random] { return static_cast<float>(random.below(41)) - 20.0f; };
    const float x = step(), y = step(), z = step();
    TestCloud line, two_places;
    for (int i = 0; i < points; ++i) {
      const float t = (static_cast<float>(random.below(33)) - 16.0f) / 65536.0f;
      line.add(t * x, t * y, t * z);
      const float place = i == 0 || random.below(2) == 0 ? 0.0f : 1.0f / 1024.0f;
      two_places.add(place * x, place * y, place * z);
    }
    for (const float radius : {0.05f, 0.5f}) {
      REQUIRE(refused(line, radius) == Status::ambiguous_frame);
      REQUIRE(refused(two_places, radius) == Status::ambiguous_frame);
    }
  }
}

TEST_CASE("normals: bad radii, viewpoints and neighborhoods are refused") {
  const TestCloud cloud = curved_surface(14, 100);
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(cloud.at(0), 0.1f, n) == Status::ok);
  const auto status = [&](float radius, const ss::Viewpoint& viewpoint) {
    ss::SurfaceNormal normal{1.0f, 1.0f, 1.0f};
    const Status result = ss::estimate_normal(n, radius, normal, viewpoint);
    CHECK(is_zero(normal));
    return result;
  };
  for (const float radius : {0.0f, -1.0f, not_a_number, infinity, 1e30f, 1e-30f}) {
    CHECK(status(radius, {}) == Status::bad_radius);
  }
  const auto nowhere = ss::Viewpoint::towards({0.0f, not_a_number, 0.0f});
  const auto infinitely_far = ss::Viewpoint::away_from({0.0f, 0.0f, infinity});
  CHECK(status(0.1f, nowhere) == Status::bad_viewpoint);
  CHECK(status(0.1f, infinitely_far) == Status::bad_viewpoint);
  n.size = 0;
  CHECK(status(0.1f, {}) == Status::too_few_neighbors);
  n.size = ss::max_neighbors + 1;  // refused before anything is read
  CHECK(status(0.1f, {}) == Status::too_many_neighbors);
}

}  // namespace test_normals
