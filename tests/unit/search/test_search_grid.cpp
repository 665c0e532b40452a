// The grid's own promises: trimmed rows, packed registers, cells in bounded memory, indices of 16 bits.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "fixtures.hpp"
#include "searches.hpp"

namespace test_search_grid {
namespace {

using namespace unit;
using ss::Status;

}  // namespace

TEST_CASE(
    "grid search: rows of cells are cut to the sphere without losing a neighbor, however coarse the coordinates") {
  // A quantum of coordinates is up to a third of the radius; cells, and the gaps between them, are no more exact.
  for (const float offset : {0.0f, 1.0f, -1000.0f, 65536.0f, 1e6f}) {
    CAPTURE(offset);
    Random random(11);
    TestCloud cloud;
    for (int i = 0; i < 1200; ++i) {
      const float x = offset + random.between(-1.0f, 1.0f);
      const float y = -offset + random.between(-1.0f, 1.0f);
      cloud.add(x, y, 0.5f * offset + random.between(-1.0f, 1.0f));
    }
    cloud.add(offset + 1e5f, 1e5f, -1e5f);  // outermost cells reach as far as the outliers in them
    for (const float radius : {0.4f, 0.17f}) {
      const std::vector<ss::Point> places = places_to_ask(cloud, 12, radius);
      for (const float fraction : {0.5f, 1.0f / 3.0f, 1.0f / 7.0f}) {
        const OwnedGrid<std::uint32_t> ample(cloud, radius * fraction, 60000);
        const OwnedGrid<std::uint16_t> narrow(cloud, radius * fraction, 300);
        REQUIRE(ample.status == Status::ok);
        REQUIRE(narrow.status == Status::ok);
        require_brute(ample.index, cloud, places, radius);
        require_brute(narrow.index, cloud, places, radius);
      }
    }
  }
}

TEST_CASE("grid search: neighbors within a few ulp of the rim, in every direction") {
  // Points are put on the sphere as exactly as float can; rounding leaves some inside and some outside.
  Random random(13);
  for (const float offset : {0.0f, 3.0f}) {
    const ss::Point center{offset, -offset, offset};
    for (const float radius : {0.04f, 1.0f / 3.0f}) {
      TestCloud cloud;
      for (int i = 0; i < 3000; ++i) {
        const float x = random.between(-1.0f, 1.0f);
        const float y = i % 3 == 0 ? 0.0f : random.between(-1.0f, 1.0f);
        const float z = i % 5 == 0 ? 0.0f : random.between(-1.0f, 1.0f);
        const float to_rim = radius / std::sqrt(x * x + y * y + z * z);
        cloud.add(center.x + x * to_rim, center.y + y * to_rim, center.z + z * to_rim);
      }
      Room room(cloud.size());
      const auto expected = found_by(ss::BruteSearch{cloud.view()}, center, radius, room);
      REQUIRE(expected.size() > 300);
      REQUIRE(expected.size() < 2700);
      for (const float fraction : {1.0f, 0.5f, 0.3f, 0.1f}) {
        CAPTURE(fraction);
        CHECK(found_by(ss::GridSearch(cloud.view(), radius * fraction), center, radius, room) == expected);
      }
    }
  }
}

TEST_CASE("grid search: neighbors at the edge of their cell, on the rim, ten kilometers along a line") {
  // What the grid takes for the edge of a cell is off by up to a millimeter here.
  const float cell = 0.3f;
  Random random(18);
  for (const int axis : {1, 2}) {
    const auto on_line = [axis](float v) { return axis == 1 ? ss::Point{0.0f, v, 0.0f} : ss::Point{0.0f, 0.0f, v}; };
    TestCloud cloud;
    cloud.add(0.0f, 0.0f, 0.0f);
    std::vector<ss::Point> places;
    for (int k = 0; k < 400; ++k) {
      float v = cell * static_cast<float>(30000 + random.below(8000));
      v = random.below(2) == 0 ? std::nextafterf(v, 0.0f) : v;
      cloud.add(on_line(v));
      for (const float side : {-1.0f, 1.0f}) {
        const float radius = 2.0f * cell;
        float center = v + side * 1.01f * radius;
        while (!((center - v) * (center - v) < radius * radius)) center = std::nextafterf(center, v);
        places.push_back(on_line(center));
      }
    }
    const OwnedGrid<std::uint32_t> grid(cloud, cell, 60000);
    REQUIRE(grid.status == Status::ok);
    require_brute(grid.index, cloud, places, 2.0f * cell);
  }
}

TEST_CASE("grid search: radii as small and as large as floats allow") {
  for (const float radius : {2e-19f, 1e-12f, 1e9f, 1.8e19f}) {
    CAPTURE(radius);
    Random random(14);
    TestCloud cloud;
    add_points(cloud, random, 200, -2.0f * radius, 2.0f * radius);
    const std::vector<ss::Point> places{{0.0f, 0.0f, 0.0f}, cloud.at(0), cloud.at(7), {3e38f, 0.0f, 0.0f}};
    for (const float cell : {radius, 0.6f * radius}) {
      require_brute(ss::GridSearch(cloud.view(), cell), cloud, places, radius);
    }
  }
}

TEST_CASE("grid search: dense clouds get smaller cells, and the same neighbors") {
  const TestCloud cloud = blob(15, 6000);
  for (const float cell : {0.2f, 0.05f, 0.02f}) {
    require_brute(ss::GridSearch(cloud.view(), cell), cloud, places_to_ask(cloud, 16, 0.05f), 0.05f);
  }
}

TEST_CASE("grid search: an index of 16 bits counts to 65,535 points and refuses more") {
  TestCloud cloud;
  for (int i = 0; i < 65535; ++i) {
    cloud.add(static_cast<float>(i % 256), static_cast<float>(i / 256), static_cast<float>(i % 7));
  }
  const OwnedGrid<std::uint16_t> full(cloud, 4.0f, 5000);
  REQUIRE(full.status == Status::ok);
  CHECK(full.index.size() == 65535);
  const auto search = std::make_unique<ss::StaticGrid<65535, 4096>>();
  REQUIRE(search->build(cloud.view(), 4.0f) == Status::ok);
  const std::vector<ss::Point> places{cloud.at(0), cloud.at(40000), cloud.at(65534)};
  require_brute(full.index, cloud, places, 4.0f);
  require_brute(*search, cloud, places, 4.0f);

  cloud.add(0.0f, 0.0f, 0.0f);
  CHECK(OwnedGrid<std::uint16_t>(cloud, 4.0f, 5000).status == Status::out_of_memory);
}

TEST_CASE("grid search: an index of 16 bits never mistakes a point beyond 65,535 for another") {
  // Few points are valid, but their places in the cloud need more than 16 bits: refuse, or find the right ones.
  TestCloud cloud;
  for (int i = 0; i < 70000; ++i) cloud.add(not_a_number, not_a_number, not_a_number);
  for (int i = 0; i < 100; ++i) cloud.add(0.01f * static_cast<float>(i), 0.0f, 0.0f);
  for (const bool copy_points : {false, true}) {
    CAPTURE(copy_points);
    const OwnedGrid<std::uint16_t> grid(cloud, 0.1f, 100, copy_points);
    if (grid.status != Status::ok) {
      CHECK(grid.status == Status::out_of_memory);
      continue;
    }
    Room room(200);
    const ss::BruteSearch brute{cloud.view()};
    CHECK(found_by(grid.index, cloud.at(70050), 0.1f, room) == found_by(brute, cloud.at(70050), 0.1f, room));
  }
}

TEST_CASE("grid search: a grid writes no cell beyond its capacity, even where floats cannot count the cells") {
  // 4097 * 4097 = 2^24 + 8193 is odd and rounds down to the capacity.
  TestCloud cloud;
  cloud.add(0.0f, 0.0f, 0.0f);
  cloud.add(4096.0f, 4096.0f, 0.0f);
  const OwnedGrid<std::uint32_t> grid(cloud, 1.0f, 4097u * 4097u - 1u);
  REQUIRE(grid.status == Status::ok);
  CHECK(grid.guard_intact());
}

TEST_CASE("grid search: a grid without room for the points, or without a cell, is out of memory and finds nothing") {
  const TestCloud cloud = blob(9, 50);
  std::vector<std::uint32_t> order(50), cells(64);
  ss::GridIndex<> grid{};
  CHECK(grid.build(cloud.view(), 0.1f, {order.data(), cells.data(), nullptr, 49, 64}) == Status::out_of_memory);
  CHECK(grid.build(cloud.view(), 0.1f, {order.data(), cells.data(), nullptr, 50, 0}) == Status::out_of_memory);
  CHECK(refuses(grid, cloud.at(0), 0.1f, Status::out_of_memory));
  CHECK(refuses(ss::GridIndex<>{}, cloud.at(0), 0.1f, Status::empty_cloud));
  CHECK(refuses(ss::GridSearch(cloud.view(), -1.0f), cloud.at(0), 0.1f, Status::bad_radius));
  CHECK(refuses(ss::NanoflannSearch(ss::CloudView{}), cloud.at(0), 0.1f, Status::empty_cloud));
  CHECK(refuses(ss::BruteSearch{ss::view_xyz(nullptr, 5)}, cloud.at(0), 0.1f, Status::bad_view));
  Room room(50);
  CHECK(grid.build(cloud.view(), 0.1f, {order.data(), cells.data(), nullptr, 50, 64}) == Status::ok);
  CHECK(!found_by(grid, cloud.at(0), 0.1f, room).empty());
}

TEST_CASE("grid search: a grid can be built again for the next cloud, larger or smaller") {
  ss::GridSearch grid;
  for (const std::size_t points : {300u, 900u, 20u, 600u}) {
    const TestCloud cloud = blob(static_cast<std::uint32_t>(points), points);
    REQUIRE(grid.build(cloud.view(), 0.05f) == Status::ok);
    require_brute(grid, cloud, places_to_ask(cloud, 1, 0.05f), 0.05f);
  }
}

TEST_CASE("grid search: nothing is written beyond the capacity, and everything up to it") {
  const TestCloud cloud = blob(17, 500);
  const ss::Point center{0.0f, 0.0f, 0.0f};
  for (const float cell : {0.2f, 0.03f}) {
    const ss::GridSearch grid(cloud.view(), cell);
    const OwnedGrid<std::uint16_t> narrow(cloud, cell, 2000);
    Room all(500);
    const auto found = static_cast<std::uint32_t>(found_by(grid, center, 0.1f, all).size());
    REQUIRE(found > 40);
    for (std::uint32_t capacity = 0; capacity < found + 20; ++capacity) {
      Room room(capacity + 1);  // one more than the search is told of, as a guard
      ss::Neighborhood n = room.neighborhood();
      n.capacity = capacity;
      n.dx[capacity] = n.dy[capacity] = n.dz[capacity] = n.d2[capacity] = -7.0f;
      n.index[capacity] = 0xABCDu;
      const auto check_guard = [&](Status status) {
        CHECK(status == (capacity < found ? Status::too_many_neighbors : Status::ok));
        CHECK(n.found == found);
        CHECK(n.size == std::min(capacity, found));
        const bool intact = n.dx[capacity] == -7.0f && n.dy[capacity] == -7.0f && n.dz[capacity] == -7.0f &&
                            n.d2[capacity] == -7.0f && n.index[capacity] == 0xABCDu;
        CHECK(intact);
      };
      check_guard(grid.gather(center, 0.1f, n));
      check_guard(narrow.index.gather(center, 0.1f, n));
    }
  }
}

}  // namespace test_search_grid
