// Many points in one place, far outliers, radii as large as the cloud: normals cost what the distinct places cost.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "fixtures.hpp"

namespace test_crowded_normals {
namespace {

using namespace unit;
using ss::Status;

/// Counts what a search is asked, and all neighbors that it finds.
template <class Search>
struct CountingSearch {
  const Search& search;
  mutable std::atomic<std::size_t> gathers{0};
  mutable std::atomic<std::size_t> neighbors{0};

  explicit CountingSearch(const Search& asked) : search(asked) {}
  [[nodiscard]] Status status() const { return search.status(); }
  [[nodiscard]] std::size_t cloud_size() const { return search.cloud_size(); }
  template <class Neighbors>
  Status gather(const ss::Point& center, ss::Radius radius, Neighbors& out) const {
    const Status status = search.gather(center, radius, out);
    ++gathers;
    neighbors += out.found;
    return status;
  }
};

struct Cost {
  std::size_t gathers, neighbors;
  std::vector<ss::SurfaceNormal> normals;
};

Cost cost_of(const TestCloud& cloud, float radius, unsigned threads = 1) {
  const ss::GridSearch grid(cloud.view(), radius);
  const CountingSearch<ss::GridSearch> search(grid);
  Cost cost{};
  REQUIRE(ss::estimate_normals(cloud.view(), search, radius, ss::Viewpoint::towards({}), cost.normals, threads) ==
          Status::ok);
  cost.gathers = search.gathers;
  cost.neighbors = search.neighbors;
  return cost;
}

constexpr float radius = 0.02f;
constexpr std::size_t copies = 20000;

bool same_bits(const ss::SurfaceNormal& a, const ss::SurfaceNormal& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

TEST_CASE("normals of points in one place are computed once for each place and thread") {
  const TestCloud surface = curved_surface(1, 2000);
  const Cost alone = cost_of(surface, radius);
  for (const std::size_t every : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {  // how far apart in memory
    CAPTURE(every);
    TestCloud cloud;
    for (std::size_t k = 0; k < copies; ++k) {
      cloud.add(0.0f, 0.0f, 0.0f);
      if (k % every == 0 && k / every < surface.size()) cloud.add(surface.at(k / every));
    }
    for (const unsigned threads : {1u, 3u}) {
      const Cost cost = cost_of(cloud, radius, threads);
      CHECK(cost.neighbors < 4 * alone.neighbors + 40 * threads * copies);  // copies^2 would be 400 million
      for (const ss::SurfaceNormal& n : cost.normals) CHECK((std::isnan(n.x) || n.z != 0.0f));
      CHECK(std::isnan(cost.normals[0].x));
    }
  }
}

TEST_CASE("normals of several crowded places in turn, and of one on a surface") {
  TestCloud cloud = curved_surface(2, 3000);
  const ss::Point crowded[] = {cloud.at(5), cloud.at(900), cloud.at(2100)};
  for (std::size_t k = 0; k < copies; ++k) cloud.add(crowded[k % 3]);
  const Cost cost = cost_of(cloud, radius);
  CHECK(cost.neighbors < std::size_t{200} * copies + std::size_t{3000} * copies);
  for (std::size_t k = 3003; k < cloud.size(); ++k) {
    CHECK(same_bits(cost.normals[k], cost.normals[3000 + (k - 3000) % 3]));
    CHECK(std::isfinite(cost.normals[k].x));
  }
}

TEST_CASE("rows of key points in one place are computed once for each place and thread") {
  TestCloud cloud = curved_surface(2, 3000);
  const ss::Point crowded = cloud.at(900);
  for (std::size_t k = 0; k < copies; ++k) cloud.add(k % 2 == 0 ? ss::Point{0.0f, 0.0f, 0.0f} : crowded);
  cloud.rgb.assign(cloud.rgb.size(), 90);
  for (std::size_t i = 0; i < 3000; ++i) cloud.rgb[3 * i] = static_cast<std::uint8_t>(i);
  std::vector<std::uint32_t> keypoints{5, 900, 6};
  for (std::uint32_t k = 3000; k < 3000 + copies; ++k) keypoints.push_back(k);
  const ss::GridSearch grid(cloud.view(), radius);
  ss::Features<ss::Scsh336> zero, crowd, other_color;
  const auto alone = [&](std::uint32_t index, ss::Features<ss::Scsh336>& out) {
    REQUIRE(ss::extract(cloud.view(), grid, std::vector<std::uint32_t>{index}, radius, out) == Status::ok);
  };
  alone(3000, zero);
  alone(3001, crowd);
  alone(900, other_color);
  REQUIRE(zero.status[0] != Status::ok);
  REQUIRE(crowd.status[0] == Status::ok);
  REQUIRE(std::memcmp(crowd[0], other_color[0], ss::Scsh336::size_bytes) != 0);
  for (const unsigned threads : {1u, 3u}) {
    const CountingSearch<ss::GridSearch> search(grid);
    ss::Features<ss::Scsh336> features;
    REQUIRE(ss::extract(cloud.view(), search, keypoints, radius, features, threads) == Status::ok);
    CHECK(search.neighbors < 30 * threads * copies);  // copies^2 would be 400 million
    for (std::size_t row = 1; row < features.size(); ++row) {
      if (row == 2) continue;
      const ss::Features<ss::Scsh336>& expected = row == 1 ? other_color : row % 2 == 1 ? zero : crowd;
      REQUIRE(features.status[row] == expected.status[0]);
      REQUIRE(features.neighbors[row] == expected.neighbors[0]);
      REQUIRE(std::memcmp(features[row], expected[0], ss::Scsh336::size_bytes) == 0);
      REQUIRE(std::memcmp(&features.frames[row], &expected.frames[0], sizeof(ss::Frame)) == 0);
    }
  }
}

TEST_CASE("two outliers at the ends of float's range leave the grid its cells") {
  const TestCloud cloud = curved_surface(3, 4000);
  for (const float far : {1e9f, 2e38f, 3e38f, 3.4e38f}) {
    CAPTURE(far);
    TestCloud with = cloud;
    with.add(far, -far, far);
    with.add(-far, far, -far);
    std::vector<std::uint32_t> cell_end(65536);
    ss::detail::Grid<std::uint32_t> grid{};
    REQUIRE(grid.plan(with.view(), radius, {nullptr, cell_end.data(), nullptr, with.size(), cell_end.size()}) ==
            Status::ok);
    CHECK(grid.cells() > 100);
    const ss::GridSearch search(with.view(), radius);
    Room room(with.size());
    for (const std::size_t i : {std::size_t{0}, std::size_t{2500}, std::size_t{4000}, std::size_t{4001}}) {
      CHECK(found_by(search, with.at(i), radius, room) ==
            found_by(ss::BruteSearch(with.view()), with.at(i), radius, room));
    }
  }
}

}  // namespace test_crowded_normals
