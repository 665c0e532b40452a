// Less memory, the same bits: indices only for neighbors, chunks of any length, colors as bytes or converted before.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "fixtures.hpp"

namespace test_low_memory {
namespace {

using namespace unit;
using ss::Status;

constexpr std::size_t max_points = 700;
constexpr float radius = 0.05f;
constexpr std::uint32_t shortest_chunk = static_cast<std::uint32_t>(ss::extend::simd::lanes);

static_assert(sizeof(ss::CompactWorkspace<512>) == 1024 && sizeof(ss::CompactWorkspace<512, std::uint32_t>) == 2048,
              "2 or 4 bytes a neighbor");
static_assert(std::is_trivial<ss::CompactWorkspace<512>>::value, "a static of it needs no code");
static_assert(ss::chunk_bytes<ss::Scsh336, 8> < ss::chunk_bytes<ss::Scsh336, 64>, "shorter chunks take less stack");

/// A cloud with normals, and the same twice over: copies of key points, ties in distance, points that are not valid.
TestCloud hard_cloud() {
  TestCloud cloud = with_surface_normals(curved_surface(7, 300), 8);
  for (std::size_t i = 0; i < 60; ++i) {
    cloud.add(cloud.at(i), cloud.color_at(i + 1));
    cloud.normals.push_back(cloud.normals[i]);
  }
  for (int x = -4; x <= 4; ++x) {  // a lattice, on the borders of cells
    for (int y = -4; y <= 4; ++y) {
      cloud.add(0.0125f * static_cast<float>(x), 0.0125f * static_cast<float>(y), 0.95f, {10, 200, 30});
      cloud.normals.push_back({0.0f, 0.0f, -1.0f});
    }
  }
  cloud.add(not_a_number, 0.0f, 1.0f);
  cloud.normals.push_back(no_normal);
  return cloud;
}

struct Result {
  Status status;
  std::vector<float> values;

  bool operator==(const Result& other) const {
    return status == other.status &&
           std::memcmp(values.data(), other.values.data(), values.size() * sizeof(float)) == 0;
  }
};

template <class D, std::uint32_t ChunkSize = ss::default_chunk_size, class Search, class Memory, class... Converted>
Result describe(const TestCloud& cloud, const Search& search, std::size_t key, Memory& workspace,
                const Converted*... converted) {
  Result result{Status::ok, garbage<D>()};
  result.status =
      ss::describe_at<D, ChunkSize>(cloud.view(), search, key, radius, workspace, result.values.data(), converted...);
  return result;
}

template <class D>
void check_all_ways() {
  const TestCloud cloud = hard_cloud();
  REQUIRE(cloud.size() <= max_points);
  const ss::BruteSearch brute{cloud.view()};
  static ss::StaticGrid<max_points, 4096> grid;
  REQUIRE(grid.build(cloud.view(), radius) == Status::ok);
  ss::Workspace<max_points> workspace;
  ss::CompactWorkspace<max_points> compact;
  ss::CompactWorkspace<max_points, std::uint32_t> compact_wide;
  int described = 0;
  for (std::size_t key = 0; key < cloud.size(); key += 3) {
    const Result expected = describe<D>(cloud, brute, key, workspace);
    described += expected.status == Status::ok ? 1 : 0;
    CHECK(describe<D>(cloud, brute, key, compact) == expected);
    CHECK(describe<D>(cloud, brute, key, compact_wide) == expected);
    CHECK(describe<D>(cloud, grid, key, compact) == expected);
    CHECK(describe<D, shortest_chunk>(cloud, grid, key, workspace) == expected);
    CHECK(describe<D, 8>(cloud, grid, key, compact) == expected);
    CHECK(describe<D, 16>(cloud, grid, key, compact) == expected);
    CHECK(describe<D, 24>(cloud, brute, key, workspace) == expected);
  }
  CHECK(described > 100);
}

}  // namespace

TEST_CASE("low memory: compact workspaces and chunks of any length give the same bits") {
  check_all_ways<ss::Ssh32>();
  check_all_ways<ss::Scsh336>();
  check_all_ways<ss::Shot352>();
  check_all_ways<ss::Cshot1344>();
}

TEST_CASE("low memory: normals are the same from a compact neighborhood") {
  const TestCloud cloud = hard_cloud();
  const ss::CloudView view = cloud.view();
  ss::Workspace<max_points> workspace;
  ss::CompactWorkspace<max_points> compact;
  for (std::size_t key = 0; key < 300; key += 7) {
    const ss::Point center = cloud.at(key);
    ss::Neighborhood n = ss::neighborhood_in(workspace);
    auto small = ss::neighborhood_in(compact, view);
    REQUIRE(ss::BruteSearch{view}.gather(center, radius, n) == Status::ok);
    REQUIRE(ss::BruteSearch{view}.gather(center, radius, small) == Status::ok);
    REQUIRE(small.size == n.size);
    ss::SurfaceNormal expected{}, normal{};
    const auto up = ss::Viewpoint::towards({center.x, center.y, center.z - 1.0f});
    CHECK(ss::estimate_normal(small, radius, normal, up) == ss::estimate_normal(n, radius, expected, up));
    CHECK(std::memcmp(&normal, &expected, sizeof normal) == 0);
  }
}

TEST_CASE("low memory: colors that were converted before give the bits of those converted one by one") {
  using D = ss::Scsh336;
  const TestCloud cloud = hard_cloud();
  const ss::BruteSearch search{cloud.view()};
  std::vector<ss::Lab> lab(cloud.size());
  std::vector<ss::PackedLab> packed(cloud.size());
  REQUIRE(ss::convert_colors<D::LabRule>(cloud.view(), lab.data()) == Status::ok);
  REQUIRE(ss::convert_colors<D::LabRule>(cloud.view(), packed.data()) == Status::ok);
  ss::CompactWorkspace<max_points> workspace;
  const Result expected = describe<D>(cloud, search, 5, workspace);
  REQUIRE(expected.status == Status::ok);
  CHECK(describe<D>(cloud, search, 5, workspace, lab.data()) == expected);
  const Result approximate = describe<D>(cloud, search, 5, workspace, packed.data());
  CHECK(approximate.status == Status::ok);
  double squared = 0.0;
  for (std::size_t i = 0; i < expected.values.size(); ++i) {
    const double d = static_cast<double>(approximate.values[i]) - static_cast<double>(expected.values[i]);
    squared += d * d;
  }
  CHECK(squared > 0.0);
  CHECK(squared < 0.02 * 0.02);
  CHECK(describe<D>(cloud, search, 5, workspace, static_cast<const ss::Lab*>(nullptr)).status ==
        Status::missing_colors);
}

TEST_CASE("low memory: what does not fit is refused") {
  const TestCloud cloud = hard_cloud();
  ss::CompactWorkspace<16> few;
  const Result result = describe<ss::Ssh32>(cloud, ss::BruteSearch{cloud.view()}, 5, few);
  CHECK(result.status == Status::too_many_neighbors);
  for (const float value : result.values) CHECK(value == 0.0f);

  // Point 65,536 has no 16-bit index: such a cloud is refused even where all neighbors have one.
  TestCloud large = curved_surface(3, 400);
  while (large.size() < 65536) large.add(10.0f, 10.0f, 10.0f);
  ss::CompactWorkspace<max_points> compact;
  ss::CompactWorkspace<max_points, std::uint32_t> compact_wide;
  CHECK(describe<ss::Ssh32>(large, ss::BruteSearch{large.view()}, 5, compact).status == Status::ok);
  large.add(10.0f, 10.0f, 10.0f);
  CHECK(describe<ss::Ssh32>(large, ss::BruteSearch{large.view()}, 5, compact).status == Status::too_many_neighbors);
  CHECK(describe<ss::Ssh32>(large, ss::BruteSearch{large.view()}, 5, compact_wide).status == Status::ok);
}

}  // namespace test_low_memory
