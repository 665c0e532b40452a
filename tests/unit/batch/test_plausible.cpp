// Numbers that cannot work are refused: a search over another cloud, coordinates too large for float; and arguments
// that are parts of the output are read before it is cleared.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace test_plausible {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Ssh96;

constexpr float radius = 0.05f;
const std::vector<int> some{3, 77, 200, 499};

TestCloud moved(TestCloud cloud, float x, float y, float z) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.xyz[3 * i] += x;
    cloud.xyz[3 * i + 1] += y;
    cloud.xyz[3 * i + 2] += z;
  }
  return cloud;
}

/// A user's search that supports nothing but Neighborhood, and looks at copies.
struct SearchOfCopies {
  explicit SearchOfCopies(const TestCloud& cloud) : points(cloud) {}
  [[nodiscard]] Status status() const { return Status::ok; }
  [[nodiscard]] std::size_t cloud_size() const { return points.size(); }
  Status gather(const ss::Point& center, ss::Radius r, ss::Neighborhood& out) const {
    return ss::BruteSearch(points.view()).gather(center, r, out);
  }
  TestCloud points;
};

/// extract() and estimate_normals() with this search.
template <class Search>
void check(const TestCloud& cloud, const Search& search, Status expected) {
  ss::Features<D> features;
  CHECK(ss::extract(cloud.view(), search, some, radius, features, 2) == expected);
  REQUIRE(features.size() == some.size());
  for (const Status status : features.status) CHECK(status == expected);
  if (expected != Status::ok) CHECK(all_zero(features.values));
  std::vector<ss::SurfaceNormal> normals(3);
  CHECK(ss::estimate_normals(cloud.view(), search, radius, ss::Viewpoint{}, normals, 2) == expected);
  CHECK(normals.size() == (expected == Status::ok ? cloud.size() : 0));
}

}  // namespace

TEST_CASE("a search over another cloud of the same size is refused, by any search") {
  const TestCloud cloud = curved_surface(1, 500);
  const TestCloud copy = cloud;  // the same points elsewhere in memory are the same cloud
  check(cloud, ss::GridSearch(copy.view(), radius), Status::ok);
  check(cloud, ss::BruteSearch(copy.view()), Status::ok);
  check(cloud, SearchOfCopies(cloud), Status::ok);
  const TestCloud others[] = {curved_surface(2, 500),            // another frame
                              moved(cloud, 0.001f, 0.0f, 0.0f),  // the same, moved by a millimeter
                              moved(cloud, 9.0f, 0.0f, 0.0f)};   // nothing where the key points are
  for (const TestCloud& other : others) {
    check(cloud, ss::GridSearch(other.view(), radius), Status::other_cloud);
    check(cloud, ss::BruteSearch(other.view()), Status::other_cloud);
    check(cloud, SearchOfCopies(other), Status::other_cloud);
  }
}

TEST_CASE("a grid over memory that was written to since is a search over another cloud") {
  TestCloud cloud = curved_surface(1, 500);
  const ss::GridSearch search(cloud.view(), radius);
  check(cloud, search, Status::ok);
  cloud.xyz = curved_surface(2, 500).xyz;
  check(cloud, search, Status::other_cloud);
}

TEST_CASE("key points with nothing around them say nothing of the search") {
  const TestCloud cloud = curved_surface(1, 500);
  ss::Features<D> features;
  const std::vector<ss::KeyPoint> far{{{9.0f, 9.0f, 9.0f}, {}}};
  CHECK(ss::extract(cloud.view(), ss::GridSearch(cloud.view(), radius), far, radius, features) == Status::ok);
  CHECK(features.status[0] == Status::too_few_neighbors);
  CHECK(ss::extract(cloud.view(), ss::BruteSearch(cloud.view()), std::vector<int>{}, radius, features) == Status::ok);
}

TEST_CASE("coordinates whose floats lie farther apart than a 64th of the radius are refused, others are not") {
  const TestCloud cloud = curved_surface(1, 500);
  for (const float away : {0.0f, 100.0f, -1000.0f, 4000.0f}) {  // at 8192 m floats lie 1 mm apart
    const TestCloud there = moved(cloud, 0.0f, away, 0.0f);
    check(there, ss::GridSearch(there.view(), radius), Status::ok);
  }
  for (const float away : {9000.0f, -9000.0f, 5.4e6f, 1e30f}) {
    const TestCloud there = moved(cloud, away, 0.0f, 0.0f);
    check(there, ss::GridSearch(there.view(), radius), Status::coarse_coordinates);
    ss::Features<D> features;
    CHECK(ss::describe_cloud(there.view(), ss::CloudOptions{}, features) == Status::coarse_coordinates);
  }
}

TEST_CASE("one coarse key point spoils no other") {
  TestCloud cloud = curved_surface(1, 500);
  cloud.add(1e7f, 0.0f, 0.0f);
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud.view(), ss::GridSearch(cloud.view(), radius), std::vector<int>{3, 500}, radius, features) ==
          Status::ok);
  CHECK(features.status == std::vector<Status>{Status::ok, Status::coarse_coordinates});
}

TEST_CASE("extract: key points, frames and counts of the output itself are read before they are cleared") {
  const TestCloud cloud = curved_surface(1, 500);
  const ss::GridSearch search(cloud.view(), radius);
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud.view(), search, some, radius, features) == Status::ok);
  const ss::Features<D> first = features;
  REQUIRE(ss::extract(cloud.view(), search, features.keypoints, radius, features, 2) == Status::ok);
  CHECK(features.status == first.status);
  CHECK(same_bits(features.values, first.values));
  REQUIRE(ss::extract(cloud.view(), search, features.keypoints, features.frames, radius, features) == Status::ok);
  CHECK(same_bits(features.values, first.values));
  const std::vector<std::uint32_t> numbers = features.neighbors;  // any numbers are indices
  ss::Features<D> expected;
  REQUIRE(ss::extract(cloud.view(), search, numbers, radius, expected) == Status::ok);
  REQUIRE(ss::extract(cloud.view(), search, features.neighbors, radius, features) == Status::ok);
  CHECK(same_bits(features.values, expected.values));
}

}  // namespace test_plausible
