// The search of organized clouds: exactly the neighbors that looking at every point finds, or an honest refusal.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"
#include "pinhole.hpp"

namespace test_search_organized {
namespace {

using namespace unit;
using ss::Status;

/// True if the search agreed to be built; its neighbors are then brute force's.
bool exact_if_built(const TestCloud& cloud, std::size_t width, std::size_t height, float radius) {
  ss::OrganizedSearch search{};
  const Status status = search.build(ss::organized(cloud.view(), width, height));
  if (status != Status::ok) {
    CHECK(status == Status::not_organized);
    return false;
  }
  const ss::BruteSearch brute{cloud.view()};
  Room room(cloud.size());
  Random random(11);
  for (int k = 0; k < 60; ++k) {
    ss::Point p = cloud.at(random.below(cloud.size()));
    if (!ss::is_finite(p)) continue;
    if (k % 3 == 0) p = {p.x + random.between(-radius, radius), p.y + radius, p.z - random.between(0.0f, radius)};
    REQUIRE(found_by(search, p, radius, room) == found_by(brute, p, radius, room));
  }
  return true;
}

bool exact_if_built(const TestCloud& cloud, float radius) {
  return exact_if_built(cloud, image_width, image_height, radius);
}

}  // namespace

TEST_CASE("organized search: a perfect pinhole image, with and without holes") {
  const TestCloud image = pinhole_image(1, {});
  CHECK(exact_if_built(image, 0.05f));
  CHECK(exact_if_built(image, 0.3f));
  TestCloud holes = image;
  Random random(2);
  for (std::size_t i = 0; i < holes.size(); ++i) {
    if (random.below(3) == 0) holes.xyz[3 * i + 2] = not_a_number;
  }
  CHECK(exact_if_built(holes, 0.05f));
}

TEST_CASE("organized search: coordinates off the pixels' rays") {
  Camera noisy;
  noisy.lateral_noise = 0.004f;  // a pixel and a half
  CHECK(exact_if_built(pinhole_image(3, noisy), 0.05f));
}

TEST_CASE("organized search: flipped axes, a flipped camera and a crop far from the optical axis") {
  for (const float sx : {-1.0f, 1.0f}) {
    for (const float sy : {-1.0f, 1.0f}) {
      for (const float sz : {-1.0f, 1.0f}) {
        TestCloud image = pinhole_image(4, {});
        for (std::size_t i = 0; i < image.size(); ++i) {
          image.xyz[3 * i] *= sx;
          image.xyz[3 * i + 1] *= sy;
          image.xyz[3 * i + 2] *= sz;
        }
        CHECK(exact_if_built(image, 0.05f));
      }
    }
  }
  Camera crop;
  crop.center_u = -400.0f;
  CHECK(exact_if_built(pinhole_image(5, crop), 0.05f));
}

TEST_CASE("organized search: a moved cloud is refused or searched exactly") {
  const TestCloud image = pinhole_image(6, {});
  int refused = 0;
  for (int step = 0; step < 24; ++step) {
    // A growing turn about y, then a shift: a slightly moved cloud still resembles a pinhole image.
    const float angle = 0.13f * static_cast<float>(step);
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    const float shift = 0.1f * static_cast<float>(step % 5);
    TestCloud moved = image;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const ss::Point p = image.at(i);
      moved.xyz[3 * i] = c * p.x + s * p.z + shift;
      moved.xyz[3 * i + 1] = p.y - shift;
      moved.xyz[3 * i + 2] = c * p.z - s * p.x;
    }
    refused += exact_if_built(moved, 0.05f) ? 0 : 1;
  }
  CHECK(refused > 0);
  CHECK(refused < 24);
}

TEST_CASE("organized search: a sphere that reaches behind the camera, and far-off, tiny and NaN questions") {
  const TestCloud image = pinhole_image(7, {});
  ss::OrganizedSearch search{};
  REQUIRE(search.build(ss::organized(image.view(), image_width, image_height)) == Status::ok);
  const ss::BruteSearch brute{image.view()};
  Room room(image.size());
  const ss::Point places[] = {{0.0f, 0.0f, 0.1f},         {0.0f, 0.0f, 0.0f},      {0.2f, -0.1f, -0.5f},
                              {0.0f, 0.0f, 1.0f},         {5.0f, 5.0f, 1.0f},      {1e30f, 0.0f, 1.0f},
                              {0.0f, 0.0f, 1e-30f},       {0.0f, 1e-40f, -1e-40f}, {not_a_number, 0.0f, 1.0f},
                              {0.0f, 0.0f, not_a_number}, {infinity, 0.0f, 1.0f},  {0.0f, 0.0f, -infinity}};
  for (const ss::Point& place : places) {
    for (const float radius : {1e-10f, 0.05f, 1.0f, 1.5f, 1e10f}) {
      CHECK(found_by(search, place, radius, room) == found_by(brute, place, radius, room));
    }
  }
}

TEST_CASE("organized search: a wide camera inside of the sphere sees neighbors at every angle") {
  Camera wide;
  wide.focal = 15.0f;
  TestCloud image = pinhole_image(13, wide);
  for (float& v : image.xyz) v *= 0.25f;
  ss::OrganizedSearch search{};
  REQUIRE(search.build(ss::organized(image.view(), image_width, image_height)) == Status::ok);
  const ss::BruteSearch brute{image.view()};
  Room room(image.size());
  for (const float z : {-0.05f, -0.01f, 0.0f, 0.01f, 0.05f, 0.1f}) {
    for (const float radius : {0.3f, 0.5f, 0.7f, 1.0f}) {
      const ss::Point center{0.02f, 0.0f, z};
      CHECK(found_by(search, center, radius, room) == found_by(brute, center, radius, room));
    }
  }
}

TEST_CASE("organized search: with a point at the end of float's range it is exact or refuses the image") {
  for (const ss::Point& far : {ss::Point{3.4e38f, -0.5f, 1.7f}, ss::Point{0.5f, 3.4e38f, 1.7f}}) {
    TestCloud cloud;
    cloud.add(-0.5f, -0.5f, 1.1f);
    cloud.add(far);
    cloud.add(-0.5f, 0.5f, 1.1f);
    cloud.add(0.5f, 0.5f, 1.1f);
    static_cast<void>(exact_if_built(cloud, 2, 2, 0.5f));  // asks itself
  }
}

TEST_CASE("organized search: what is no image is refused") {
  const auto build = [](const ss::CloudView& view) {
    ss::OrganizedSearch search{};
    return search.build(view);
  };
  TestCloud image = pinhole_image(8, {});
  CHECK(build(image.view()) == Status::not_organized);  // height 1
  CHECK(build(ss::organized(image.view(), 1, image.size())) == Status::not_organized);
  CHECK(build(ss::organized(image.view(), image_width, image_height - 1)) == Status::not_organized);
  CHECK(build(ss::organized(image.view(), image_width, 0)) == Status::not_organized);
  CHECK(build(ss::organized(image.view(), 0, image_height)) == Status::not_organized);
  CHECK(build(ss::organized(image.view(), ~std::size_t{0}, 2)) == Status::not_organized);

  TestCloud behind = image;
  behind.xyz[3 * 77 + 2] = -1.0f;
  CHECK(build(ss::organized(behind.view(), image_width, image_height)) == Status::not_organized);
  TestCloud at_camera = image;
  at_camera.xyz[3 * 77 + 2] = 0.0f;
  CHECK(build(ss::organized(at_camera.view(), image_width, image_height)) == Status::not_organized);

  TestCloud flat, shuffled, none;
  Random random(9);
  for (std::size_t i = 0; i < image.size(); ++i) {
    flat.add(image.at(i).x, image.at(i).y, 0.0f);
    shuffled.add(image.at(random.below(image.size())));
    none.add(not_a_number, not_a_number, not_a_number);
  }
  CHECK(build(ss::organized(flat.view(), image_width, image_height)) == Status::not_organized);
  CHECK(build(ss::organized(shuffled.view(), image_width, image_height)) == Status::not_organized);
  CHECK(build(ss::organized(none.view(), image_width, image_height)) == Status::empty_cloud);
}

TEST_CASE("organized search: a refused search finds nothing") {
  TestCloud image = pinhole_image(10, {});
  image.xyz[2] = -1.0f;
  ss::OrganizedSearch search{};
  CHECK(refuses(search, image.at(500), 0.1f, Status::empty_cloud));
  REQUIRE(search.build(ss::organized(image.view(), image_width, image_height)) == Status::not_organized);
  CHECK(refuses(search, image.at(500), 0.1f, Status::not_organized));
}

TEST_CASE("organized search: a full workspace is reported with the exact number of neighbors") {
  const TestCloud image = pinhole_image(12, {});
  ss::OrganizedSearch search{};
  REQUIRE(search.build(ss::organized(image.view(), image_width, image_height)) == Status::ok);
  Room all(image.size());
  const std::size_t expected = found_by(ss::BruteSearch{image.view()}, image.at(1500), 0.1f, all).size();
  Room small(5);
  ss::Neighborhood n = small.neighborhood();
  REQUIRE(expected > 5);
  CHECK(search.gather(image.at(1500), 0.1f, n) == Status::too_many_neighbors);
  CHECK(n.found == expected);
}

}  // namespace test_search_organized
