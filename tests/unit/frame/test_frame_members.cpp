// The pieces of the local reference frame: counting members and votes, and ranking by distance without sorting.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "fixtures.hpp"

namespace test_frame_members {
namespace {

using namespace unit;
using ss::Status;

constexpr ss::Point origin{0.0f, 0.0f, 0.0f};

}  // namespace

TEST_CASE("frame: members are counted one by one, whatever else is in the neighborhood") {
  // Every number of neighbors modulo the lanes; copies of the key point, members so close that their squared distance
  // underflows, and neighbors beyond the frame's radius.
  Random random(9);
  for (std::size_t count = 0; count < 40; ++count) {
    TestCloud cloud;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t kind = random.below(4);
      const float length = kind == 0 ? 0.0f : kind == 1 ? 1e-30f : kind == 2 ? 0.4f : 0.6f;
      cloud.add(0.0f, random.below(2) == 0 ? length : -length, 0.0f);
    }
    Room room(count);
    ss::Neighborhood n = room.neighborhood();
    if (count > 0) REQUIRE(ss::BruteSearch{cloud.view()}.gather(origin, 1.0f, n) == Status::ok);
    int members = 0;
    int votes = 0;
    float farthest = 0.0f;
    for (std::uint32_t i = 0; i < n.size; ++i) {
      if (n.dy[i] == 0.0f || n.d2[i] >= 0.25f) continue;
      ++members;
      votes += n.dy[i] > 0.0f ? 1 : 0;
      farthest = std::max(farthest, n.d2[i]);
    }
    const ss::detail::Census census = ss::detail::take_census(n, 0.5f);
    CHECK(census.members == members);
    CHECK(census.farthest_d2 == farthest);
    const float up[3] = {0.0f, 1.0f, 0.0f};
    const float down[3] = {0.0f, -1.0f, 0.0f};
    const ss::detail::AxisVotes against = ss::detail::count_votes_against(n, 0.5f, up, down);
    CHECK(against.x == members - votes);
    CHECK(against.z == votes);
  }
}

TEST_CASE("frame: a neighbor in an axis' normal plane counts as in favor, the key point's copies do not") {
  TestCloud cloud;
  cloud.add(0.1f, 0.0f, 0.0f);
  cloud.add(-0.1f, 0.0f, 0.0f);
  cloud.add(0.0f, 0.1f, 0.0f);
  cloud.add(0.0f, 0.0f, -0.1f);
  cloud.add(origin);
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(origin, 1.0f, n) == Status::ok);
  const ss::detail::Census census = ss::detail::take_census(n, 1.0f);
  CHECK(census.members == 4);
  const auto votes = [&](const float(&x)[3], const float(&z)[3]) {
    const ss::detail::AxisVotes against = ss::detail::count_votes_against(n, 1.0f, x, z);
    return std::vector<int>{4 - against.x, 4 - against.z};
  };
  CHECK(votes({1.0f, 0.0f, 0.0f}, {-1.0f, 0.0f, 0.0f}) == std::vector<int>{3, 3});
  CHECK(votes({0.0f, -1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}) == std::vector<int>{3, 3});
}

TEST_CASE("ranking: the place of each rank has those before it that sorting finds, ties and all") {
  Random random(8);
  for (int round = 0; round < 40; ++round) {
    TestCloud cloud;
    // A coarse lattice: many equal distances, copies of the key point. In the last rounds all are so close that squared
    // distances underflow: the index alone decides.
    const float scale = round < 30 ? 1.0f : 1e-30f;
    for (int k = 0; k < 60; ++k) {
      cloud.add(scale * random.dyadic(-1.0f, 1.0f, 2), scale * random.dyadic(-1.0f, 1.0f, 2),
                scale * random.dyadic(-1.0f, 1.0f, 1));
    }
    Room room(cloud.size());
    ss::Neighborhood n = room.neighborhood();
    const ss::GridSearch grid(cloud.view(), 0.3f);  // not in the order of indices
    REQUIRE(grid.gather(origin, 2.0f, n) == Status::ok);
    std::vector<std::uint32_t> order(n.size);
    std::iota(order.begin(), order.end(), 0);
    const auto is_copy = [&n](std::uint32_t i) { return n.dx[i] == 0.0f && n.dy[i] == 0.0f && n.dz[i] == 0.0f; };
    const auto copies_end = std::partition(order.begin(), order.end(), is_copy);
    std::sort(copies_end, order.end(), [&n](std::uint32_t a, std::uint32_t b) {
      return n.d2[a] != n.d2[b] ? n.d2[a] < n.d2[b] : n.index[a] < n.index[b];
    });
    const auto copies = static_cast<std::size_t>(copies_end - order.begin());
    CHECK(ss::detail::count_before(n, 1) == static_cast<int>(copies));
    for (std::size_t rank = copies; rank < order.size(); ++rank) {
      const ss::detail::Place place = ss::detail::place_of_rank(n, static_cast<int>(rank));
      CHECK(ss::detail::count_before(n, place) == static_cast<int>(rank));
      for (std::size_t k = 0; k < order.size(); ++k) {
        CHECK((ss::detail::place_at(n, order[k]) < place) == (k < rank));
      }
    }
  }
}

TEST_CASE("ranking: comes to an end where all neighbors are one") {
  std::vector<float> ones(20, 1.0f);
  std::vector<std::uint32_t> same(20, 7);
  const ss::Neighborhood n{ones.data(), ones.data(), ones.data(), ones.data(), same.data(), 20, 20, 20, {}};
  const ss::detail::Place place = ss::detail::place_of_rank(n, 10);
  CHECK(ss::detail::count_before(n, place) == 0);
  CHECK(ss::detail::count_before(n, place + 1) == 20);
}

}  // namespace test_frame_members
