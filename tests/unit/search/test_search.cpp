// Every search finds exactly the neighbors that looking at every point finds, whatever the cloud and the memory.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"
#include "searches.hpp"

namespace test_search {
namespace {

using namespace unit;
using ss::Status;

/// All searches that need no image, with ample and with tiny memory, and cells much smaller and larger than the radius.
void check_all_searches(const TestCloud& cloud, float radius) {
  const std::vector<ss::Point> places = places_to_ask(cloud, 7, radius);
  for (const float cell : {radius, radius / 50.0f, radius * 50.0f}) {
    CAPTURE(cell);
    const ss::GridSearch grid(cloud.view(), cell);
    REQUIRE(grid.status() == Status::ok);
    require_brute(grid, cloud, places, radius);
    for (const std::size_t cells : {1u, 7u, 64u, 1000u}) {
      CAPTURE(cells);
      const OwnedGrid<std::uint32_t> wide(cloud, cell, cells);
      const OwnedGrid<std::uint16_t> narrow(cloud, cell, cells, false);
      REQUIRE(wide.status == Status::ok);
      REQUIRE(narrow.status == Status::ok);
      REQUIRE(wide.guard_intact());
      REQUIRE(narrow.guard_intact());
      require_brute(wide.index, cloud, places, radius);
      require_brute(narrow.index, cloud, places, radius);
    }
  }
  for (const std::size_t leaf : {1u, 10u, 500u}) {
    CAPTURE(leaf);
    require_brute(ss::NanoflannSearch(cloud.view(), leaf), cloud, places, radius);
  }
}

}  // namespace

TEST_CASE("search: random points and curved surfaces") {
  check_all_searches(blob(1, 800), 0.03f);
  check_all_searches(curved_surface(2, 800), 0.03f);
}

TEST_CASE("search: clusters with nothing between them") {
  Random random(3);
  TestCloud cloud;
  for (int k = 0; k < 6; ++k) {
    const float corner = random.between(-5.0f, 5.0f);
    add_points(cloud, random, 80, corner, corner + 0.05f);
  }
  check_all_searches(cloud, 0.02f);
}

TEST_CASE("search: a plane, a line, identical points and a single point") {
  Random random(4);
  TestCloud plane, line, copies, single;
  for (int k = 0; k < 500; ++k) {
    plane.add(random.between(0.0f, 1.0f), random.between(0.0f, 1.0f), 0.25f);
    line.add(0.5f, 0.5f, random.between(0.0f, 1.0f));
    copies.add(0.1f, 0.2f, 0.3f);
  }
  single.add(0.1f, 0.2f, 0.3f);
  check_all_searches(plane, 0.1f);
  check_all_searches(line, 0.1f);
  check_all_searches(copies, 0.1f);
  check_all_searches(single, 0.1f);
}

TEST_CASE("search: far outliers neither exhaust the cells nor lose a neighbor") {
  for (const float far : {1e6f, 1e30f, 3e38f}) {
    CAPTURE(far);
    TestCloud cloud = blob(5, 600);
    cloud.add(far, 0.0f, 0.0f);
    cloud.add(-far, far, -far);
    cloud.add(0.0f, far, 0.01f);
    check_all_searches(cloud, 0.03f);
  }
}

TEST_CASE("search: ten kilometers of points with a radius of a meter") {
  Random random(6);
  TestCloud cloud;
  add_points(cloud, random, 1500, -5000.0f, 5000.0f);
  for (std::size_t i = 0; i < 100; ++i) {  // so that somebody has neighbors
    const ss::Point p = cloud.at(i);
    cloud.add(p.x + 0.5f, p.y, p.z);
  }
  check_all_searches(cloud, 1.0f);
}

TEST_CASE("search: a radius whose square is near the end of float's range") {
  Random random(4);
  TestCloud cloud;
  add_points(cloud, random, 300, -2e19f, 2e19f);
  for (const float radius : {0.9e19f, 1.2e19f, 1.7e19f, 1.8e19f}) {
    CAPTURE(radius);
    const std::vector<ss::Point> places = places_to_ask(cloud, 7, radius);
    require_brute(ss::GridSearch(cloud.view(), radius), cloud, places, radius);
    for (const std::size_t leaf : {1u, 10u}) {
      require_brute(ss::NanoflannSearch(cloud.view(), leaf), cloud, places, radius);
    }
  }
}

TEST_CASE("search: points that are not finite are never neighbors") {
  TestCloud cloud = blob(8, 600);
  for (std::size_t i = 0; i < cloud.xyz.size(); i += 5) cloud.xyz[i] = i % 2 == 0 ? not_a_number : -infinity;
  check_all_searches(cloud, 0.05f);
}

TEST_CASE("search: a point on the rim is outside, one ulp closer is inside") {
  // From the origin, distances along an axis are exact: d2 = x * x, against R * R = 1/16.
  const float radius = 0.25f;
  const float inside = std::nextafterf(radius, 0.0f);
  const float outside = std::nextafterf(radius, 1.0f);
  TestCloud cloud;
  for (const float distance : {inside, radius, outside}) {
    for (const float sign : {-1.0f, 1.0f}) {
      cloud.add(sign * distance, 0.0f, 0.0f);
      cloud.add(0.0f, sign * distance, 0.0f);
      cloud.add(0.0f, 0.0f, sign * distance);
    }
  }
  const std::vector<std::uint32_t> expected{0, 1, 2, 3, 4, 5};
  const ss::Point origin{0.0f, 0.0f, 0.0f};
  Room room(cloud.size());
  CHECK(found_by(ss::BruteSearch{cloud.view()}, origin, radius, room) == expected);
  CHECK(found_by(ss::GridSearch(cloud.view(), radius), origin, radius, room) == expected);
  CHECK(found_by(ss::GridSearch(cloud.view(), radius / 8.0f), origin, radius, room) == expected);
  CHECK(found_by(ss::NanoflannSearch(cloud.view(), 1), origin, radius, room) == expected);
}

TEST_CASE("search: rims all over a lattice far from the origin") {
  // Spacing 1/16 of a meter at 100 m: every third neighbor along an axis lies exactly on the rim.
  TestCloud cloud;
  for (int i = 0; i < 729; ++i) {
    const auto at = [](int k) { return 100.0f + static_cast<float>(k) / 16.0f; };
    cloud.add(at(i % 9), at(i / 9 % 9), at(i / 81));
  }
  check_all_searches(cloud, 3.0f / 16.0f);
}

TEST_CASE("search: Radius::from_double squares in double, as PCL does") {
  const auto narrow = ss::Radius(0.1f);
  const auto wide = ss::Radius::from_double(0.1);
  CHECK(wide.value == narrow.value);
  CHECK(wide.squared == static_cast<float>(0.1 * 0.1));
  CHECK(wide.squared != narrow.squared);
}

TEST_CASE("search: a full workspace is reported with the exact number of neighbors, by every search") {
  const TestCloud cloud = blob(10, 400);
  const ss::Point center{0.0f, 0.0f, 0.0f};
  Room all(400);
  const auto expected = static_cast<std::uint32_t>(found_by(ss::BruteSearch{cloud.view()}, center, 0.1f, all).size());
  REQUIRE(expected > 8);
  const auto check_overflow = [&](const auto& search) {
    for (const std::uint32_t capacity : {0u, 1u, 8u, expected - 1u}) {
      Room room(capacity);
      ss::Neighborhood n = room.neighborhood();
      CHECK(search.gather(center, 0.1f, n) == Status::too_many_neighbors);
      CHECK(n.found == expected);
      CHECK(n.size == capacity);
    }
    Room exact(expected);
    ss::Neighborhood n = exact.neighborhood();
    CHECK(search.gather(center, 0.1f, n) == Status::ok);
  };
  check_overflow(ss::BruteSearch{cloud.view()});
  check_overflow(ss::GridSearch(cloud.view(), 0.1f));
  check_overflow(ss::NanoflannSearch(cloud.view()));
}

}  // namespace test_search
