// describe_at() is search, frame and kernel in one call; the kernel's sums hold whatever a neighborhood can add up to.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace test_describe {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Scsh336;

constexpr ss::Frame upright{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// The three steps one by one, with a neighborhood as large as the larger radius.
std::vector<float> by_steps(const TestCloud& cloud, const ss::KeyPoint& key, const ss::Support& support) {
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  const float widest = std::max(support.radius.value, support.frame_radius.value);
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(key.position, widest, n) == Status::ok);
  ss::Frame frame{};
  REQUIRE(ss::estimate_frame(n, support.frame_radius, frame, support.viewpoint) == Status::ok);
  const ss::RgbColors<ss::PublishedLab> colors{cloud.view(), key.color};
  std::vector<float> out = garbage<D>();
  REQUIRE(ss::describe<D>(n, colors, frame, support.radius, out.data()) == Status::ok);
  return out;
}

std::vector<float> at_once(const TestCloud& cloud, const ss::KeyPoint& key, const ss::Support& support) {
  static ss::Workspace<2000> workspace;
  std::vector<float> out = garbage<D>();
  REQUIRE(ss::describe_at<D>(cloud.view(), ss::BruteSearch{cloud.view()}, key, support, workspace, out.data()) ==
          Status::ok);
  return out;
}

}  // namespace

TEST_CASE("describe: describe_at() is search, frame and kernel, whichever radius is larger") {
  const TestCloud cloud = curved_surface(1, 1500);
  const ss::Point eye{0.0f, 0.0f, 0.5f};  // between the origin and the cloud
  for (const float frame_radius : {0.03f, 0.05f, 0.08f}) {
    for (const ss::Viewpoint& viewpoint :
         {ss::Viewpoint{}, ss::Viewpoint::towards(eye), ss::Viewpoint::away_from(eye)}) {
      ss::Support support = 0.05f;
      support.frame_radius = frame_radius;
      support.viewpoint = viewpoint;
      for (std::size_t i = 0; i < 20; ++i) {
        const ss::Point p = cloud.at(i);
        const ss::KeyPoint on_cloud = ss::keypoint(cloud.view(), i);
        const ss::KeyPoint off_cloud{{p.x + 0.002f, p.y, p.z + 0.001f}, {200, 10, 10}};
        CHECK(same_bits(at_once(cloud, on_cloud, support), by_steps(cloud, on_cloud, support)));
        CHECK(same_bits(at_once(cloud, off_cloud, support), by_steps(cloud, off_cloud, support)));
      }
    }
  }
}

TEST_CASE("describe: neighbors beyond the descriptor's radius change nothing but the rounding of votes") {
  const TestCloud cloud = curved_surface(2, 1500);
  for (std::size_t i = 0; i < 20; ++i) {
    Room room(cloud.size());
    std::vector<float> narrow(96), wide(96);
    ss::Neighborhood n = room.neighborhood();
    REQUIRE(ss::BruteSearch{cloud.view()}.gather(cloud.at(i), 0.04f, n) == Status::ok);
    REQUIRE(ss::describe<ss::Ssh96>(n, ss::sources(), upright, 0.04f, narrow.data()) == Status::ok);
    REQUIRE(ss::BruteSearch{cloud.view()}.gather(cloud.at(i), 0.1f, n) == Status::ok);
    REQUIRE(ss::describe<ss::Ssh96>(n, ss::sources(), upright, 0.04f, wide.data()) == Status::ok);
    CHECK(l2_distance(narrow, wide) < 1e-5);
  }
}

TEST_CASE("describe: Lab converted beforehand gives the same bits as bytes converted on the way") {
  const TestCloud cloud = curved_surface(3, 1500);
  std::vector<ss::Lab> lab(cloud.size());
  REQUIRE(ss::convert_colors<ss::PublishedLab>(cloud.view(), lab.data()) == Status::ok);
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(cloud.at(5), 0.05f, n) == Status::ok);
  std::vector<float> before = garbage<D>(), meanwhile = garbage<D>();
  REQUIRE(ss::describe<D>(n, ss::LabColors{lab.data(), lab[5]}, upright, 0.05f, before.data()) == Status::ok);
  REQUIRE(ss::describe<D>(n, ss::RgbColors<ss::PublishedLab>{cloud.view(), cloud.color_at(5)}, upright, 0.05f,
                          meanwhile.data()) == Status::ok);
  CHECK(same_bits(before, meanwhile));
}

TEST_CASE("describe: an array of colors is what a pointer to them is") {
  const TestCloud cloud = curved_surface(3, 1500);
  static ss::PackedLab packed[1500];
  REQUIRE(ss::convert_colors<ss::PublishedLab>(cloud.view(), packed) == Status::ok);
  static ss::Workspace<1500> workspace;
  const ss::PackedLab* const pointer = packed;
  std::vector<float> by_array = garbage<D>(), by_pointer = garbage<D>(), by_bytes = garbage<D>();
  const ss::BruteSearch search{cloud.view()};
  REQUIRE(ss::describe_at<D>(cloud.view(), search, 5, 0.05f, workspace, by_array.data(), packed) == Status::ok);
  REQUIRE(ss::describe_at<D>(cloud.view(), search, 5, 0.05f, workspace, by_pointer.data(), pointer) == Status::ok);
  REQUIRE(ss::describe_at<D>(cloud.view(), search, 5, 0.05f, workspace, by_bytes.data()) == Status::ok);
  CHECK(same_bits(by_array, by_pointer));
  CHECK_FALSE(same_bits(by_array, by_bytes));  // packed ones are rounded
}

TEST_CASE("describe: any number of neighbors in the middle of one cell adds up without overflow") {
  // The largest sum there is: four shares of 1 from every neighbor, all into one value.
  using OneCell = ss::Descriptor<ss::PublishedVoting, ss::Part<ss::SphericalGrid<1, 1, 1>, ss::ColorDistance<1>>,
                                 ss::Part<ss::SphericalGrid<1, 1, 2>, ss::Occupancy>>;
  std::vector<float> expected = garbage<OneCell>();
  for (const std::size_t copies : {1u, 2u, 63u, 64u, 65u, 1000u, 65536u, 100000u}) {
    CAPTURE(copies);
    TestCloud cloud;
    for (std::size_t k = 0; k < copies; ++k) cloud.add(0.0f, 0.5f, 0.0f, {255, 255, 0});
    Room room(copies);
    ss::Neighborhood n = room.neighborhood();
    REQUIRE(ss::BruteSearch{cloud.view()}.gather({0.0f, 0.0f, 0.0f}, 1.0f, n) == Status::ok);
    const ss::RgbColors<ss::PublishedLab> colors{cloud.view(), {0, 0, 255}};
    std::vector<float> out = garbage<OneCell>();
    REQUIRE(ss::describe<OneCell>(n, colors, upright, 1.0f, out.data()) == Status::ok);
    if (copies == 1) expected = out;
    CHECK(l2_distance(out, expected) < 1e-4);  // votes round to 2^-11 for 100,000 neighbors
    CHECK(*std::min_element(out.begin(), out.end()) > 0.0f);
  }
}

TEST_CASE("describe: a hundred thousand neighbors where they weigh most do not overflow a frame") {
  TestCloud cloud;  // at two thirds of the radius w |v|^2 is largest
  for (int k = 0; k < 100000; ++k) cloud.add(0.0f, -2.0f / 3.0f, 0.0f);
  for (int k = 0; k < 1000; ++k) cloud.add(0.5f, 0.0f, 0.0f);
  cloud.add(0.0f, 0.0f, 0.5f);
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather({0.0f, 0.0f, 0.0f}, 1.0f, n) == Status::ok);
  ss::Frame frame{};
  REQUIRE(ss::estimate_frame(n, 1.0f, frame) == Status::ok);
  CHECK(frame.x[1] == -1.0f);
  CHECK(std::abs(frame.z[2]) == 1.0f);
}

TEST_CASE("describe: points on axes, diagonals and the rim get the cells that the definition says") {
  // Hard votes into 2 x 2 x 8 cells, exact coordinates, each point on one border or more: the upper cell has it, but
  // phi = +180 degrees is the last azimuth and the -z axis the last elevation.
  using Grid = ss::SphericalGrid<2, 2, 8>;
  struct Case {
    ss::Point p;
    int r, e, a;
  };
  const Case cases[] = {
      {{0.25f, 0.0f, 0.0f}, 0, 1, 4},    {{0.5f, 0.0f, 0.0f}, 1, 1, 4},       {{0.0f, 0.5f, 0.0f}, 1, 1, 6},
      {{-0.25f, 0.0f, 0.0f}, 0, 1, 7},   {{-0.25f, -0.0f, 0.0f}, 0, 1, 7},    {{0.0f, -0.25f, 0.0f}, 0, 1, 2},
      {{0.25f, 0.25f, 0.0f}, 0, 1, 5},   {{-0.25f, 0.25f, 0.0f}, 0, 1, 7},    {{-0.25f, -0.25f, 0.0f}, 0, 1, 1},
      {{0.25f, -0.25f, 0.0f}, 0, 1, 3},  {{0.0f, 0.0f, 0.25f}, 0, 0, 4},      {{0.0f, 0.0f, -0.25f}, 0, 1, 4},
      {{0.25f, 0.0f, 0.0625f}, 0, 0, 4}, {{0.0f, 0.0f, 0.99999994f}, 1, 0, 4}};
  for (const Case& c : cases) {
    CAPTURE(c.p.x);
    CAPTURE(c.p.y);
    CAPTURE(c.p.z);
    TestCloud cloud;
    cloud.add(c.p);
    Room room(1);
    ss::Neighborhood n = room.neighborhood();
    REQUIRE(ss::BruteSearch{cloud.view()}.gather({0.0f, 0.0f, 0.0f}, 1.0f, n) == Status::ok);
    std::vector<float> out(32);
    REQUIRE(ss::describe<ss::Ssh<Grid, ss::HardVoting>>(n, ss::sources(), upright, 1.0f, out.data()) == Status::ok);
    const auto hit = std::max_element(out.begin(), out.end()) - out.begin();
    CHECK(hit == ss::Part<Grid, ss::Occupancy>::index(c.r, c.e, c.a));
  }
}

}  // namespace test_describe
