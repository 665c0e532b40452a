// What the tests of several searches share: grids in memory of their own, places to ask, and the comparison with brute
// force.
#pragma once

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace unit {

/// A GridIndex with its memory behind it, and a guard after the last cell.
template <class Index>
struct OwnedGrid {
  OwnedGrid(const TestCloud& cloud, float cell_size, std::size_t cells, bool copy_points = true)
      : order(cloud.size()), cell_end(cells + 1, Index{0xABCD}), xyz(3 * cloud.size()) {
    status = index.build(cloud.view(), cell_size,
                         {order.data(), cell_end.data(), copy_points ? xyz.data() : nullptr, cloud.size(), cells});
  }
  [[nodiscard]] bool guard_intact() const { return cell_end.back() == Index{0xABCD}; }

  std::vector<Index> order, cell_end;
  std::vector<float> xyz;
  ss::GridIndex<Index> index{};
  ss::Status status;
};

/// Points of the cloud, places between them, just outside of its box and far away.
inline std::vector<ss::Point> places_to_ask(const TestCloud& cloud, std::uint32_t seed, float radius) {
  Random random(seed);
  std::vector<ss::Point> places{{1e5f, -1e5f, 1e5f}, {1e30f, 0.0f, 0.0f}};
  for (int k = 0; k < 25; ++k) {
    const ss::Point p = cloud.at(random.below(cloud.size()));
    if (!ss::is_finite(p)) continue;
    places.push_back(p);
    places.push_back(
        {p.x + random.between(-radius, radius), p.y + random.between(-radius, radius), p.z + 0.9f * radius});
  }
  return places;
}

template <class Search>
void require_brute(const Search& search, const TestCloud& cloud, const std::vector<ss::Point>& places, float radius) {
  Room room(cloud.size());
  const ss::BruteSearch brute{cloud.view()};
  for (const ss::Point& place : places) {
    CAPTURE(place.x);
    REQUIRE(found_by(search, place, radius, room) == found_by(brute, place, radius, room));
  }
}

inline void add_points(TestCloud& cloud, Random& random, std::size_t count, float low, float high) {
  for (std::size_t i = 0; i < count; ++i) {
    const float x = random.between(low, high);
    const float y = random.between(low, high);
    cloud.add(x, y, random.between(low, high));
  }
}

}  // namespace unit
