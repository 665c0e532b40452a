// diagnose(): each number that cannot work is named, and a sound cloud has nothing to be named.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace test_diagnose {
namespace {

using namespace unit;
using ss::Diagnosis;
using ss::Status;

constexpr float radius = 0.05f;

/// A bent sheet, a point in each millimeter or two: `points` of 0.002 m.
TestCloud sheet(std::size_t side = 60) {
  TestCloud cloud;
  for (std::size_t i = 0; i < side * side; ++i) {
    const float x = 0.002f * static_cast<float>(i % side);
    const float y = 0.002f * static_cast<float>(i / side);
    cloud.add(x + 0.1f, y, 1.0f + 3.0f * x * x - 2.0f * x * y, {static_cast<std::uint8_t>(i % 251), 7, 9});
  }
  return cloud;
}

TestCloud scaled(TestCloud cloud, float scale, float x = 0.0f) {
  for (float& v : cloud.xyz) v *= scale;
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.xyz[3 * i] += x;
  return cloud;
}

Diagnosis diagnosed(const TestCloud& cloud, const ss::Support& support = radius) {
  const Diagnosis d = ss::diagnose(cloud.view(), ss::GridSearch(cloud.view(), radius), support);
  REQUIRE(d.status == Status::ok);
  return d;
}

}  // namespace

TEST_CASE("diagnose: a sound cloud") {
  const Diagnosis d = diagnosed(sheet());
  CHECK(d.not_finite == 0.0f);
  CHECK(d.at_origin == 0.0f);
  CHECK(d.low.x == 0.1f);
  CHECK(d.high.y == doctest::Approx(0.118));
  CHECK(!d.one_color);
  CHECK(d.no_normal == 1.0f);
  CHECK(d.other_length == 0.0f);
  CHECK(d.sampled == 1000);
  CHECK(d.float_step < 1.3e-7f);
  CHECK(d.spacing == doctest::Approx(0.002).epsilon(0.05));
  CHECK(d.doubles == 0.0f);
  CHECK(d.neighbors > 500.0f);
  CHECK(d.few_neighbors == 0.0f);
  CHECK(d.no_frame == 0.0f);
  CHECK(d.frame_confidence > 0.0f);
  CHECK(d.off_surface == 0);
}

TEST_CASE("diagnose: the same for any search") {
  const TestCloud cloud = sheet();
  const Diagnosis d = diagnosed(cloud);
  const Diagnosis of_brute = ss::diagnose(cloud.view(), ss::BruteSearch(cloud.view()), radius);
  CHECK(of_brute.spacing == d.spacing);
  CHECK(of_brute.neighbors == d.neighbors);
  CHECK(of_brute.frame_confidence == d.frame_confidence);
}

TEST_CASE("diagnose: millimeters with a radius in meters have a spacing, and no neighbors") {
  const Diagnosis d = diagnosed(scaled(sheet(), 1000.0f));
  CHECK(d.spacing == doctest::Approx(2.0).epsilon(0.05));
  CHECK(d.neighbors == 1.0f);
  CHECK(d.few_neighbors == 1.0f);
  CHECK(d.no_frame == 1.0f);
  CHECK(d.frame_confidence == 0.0f);
}

TEST_CASE("diagnose: points that are no measurement, and points on top of each other") {
  TestCloud cloud = sheet();
  const std::size_t points = cloud.size();
  for (std::size_t k = 0; k < points; ++k) cloud.add(0.0f, 0.0f, 0.0f);
  for (std::size_t k = 0; k < 2 * points; ++k) cloud.add(1.0f, not_a_number, 0.0f);
  const Diagnosis d = diagnosed(cloud);
  CHECK(d.not_finite == doctest::Approx(0.5));
  CHECK(d.at_origin == doctest::Approx(0.25));
  CHECK(d.low.x == 0.1f);
  CHECK(d.doubles == 0.0f);
  CHECK(d.few_neighbors == 0.0f);
  CHECK(d.sampled > 300);

  TestCloud twice = sheet();
  for (std::size_t k = 0; k < points; ++k) twice.add(twice.at(k));
  CHECK(diagnosed(twice).doubles == 1.0f);
  CHECK(diagnosed(twice).spacing == doctest::Approx(0.002).epsilon(0.05));
}

TEST_CASE("diagnose: coordinates that float cannot hold") {
  CHECK(diagnosed(scaled(sheet(), 1.0f, 5.4e6f)).float_step == 0.5f);
}

TEST_CASE("diagnose: normals that are missing or of another length, and one color") {
  TestCloud cloud = with_surface_normals(sheet(), 1);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.normals[i] = i % 4 == 0 ? no_normal : i % 2 == 0 ? ss::SurfaceNormal{0, 0, 6} : ss::SurfaceNormal{0, 0, 1};
  }
  cloud.rgb.assign(cloud.rgb.size(), 77);
  const Diagnosis d = diagnosed(cloud);
  CHECK(d.no_normal == doctest::Approx(0.25));
  CHECK(d.other_length == doctest::Approx(1.0 / 3.0));
  CHECK(d.one_color);
}

TEST_CASE("diagnose: key points off the surface") {
  const TestCloud cloud = sheet();
  const ss::Point p = cloud.at(1000);
  const std::vector<ss::KeyPoint> keypoints{
      {p, {}}, {{p.x, p.y, p.z + 0.02f}, {}}, {{9.0f, 0.0f, 0.0f}, {}}, {{not_a_number, 0.0f, 0.0f}, {}}};
  const ss::GridSearch search(cloud.view(), radius);
  CHECK(ss::diagnose(cloud.view(), search, radius, keypoints).off_surface == 3);
  CHECK(ss::diagnose(cloud.view(), search, radius, std::vector<int>{0, -1, 5}).off_surface == 1);
}

TEST_CASE("diagnose: a search over another cloud, and what cannot be looked at") {
  const TestCloud cloud = sheet();
  const TestCloud other = scaled(cloud, 1.0f, 0.003f);
  CHECK(ss::diagnose(cloud.view(), ss::GridSearch(other.view(), radius), radius).status == Status::other_cloud);
  CHECK(ss::diagnose(cloud.view(), ss::GridSearch(), radius).status == Status::empty_cloud);
  CHECK(ss::diagnose(cloud.view(), ss::BruteSearch(cloud.view()), -1.0f).status == Status::bad_radius);
  CHECK(ss::diagnose(ss::CloudView{}, ss::BruteSearch(cloud.view()), radius).status == Status::empty_cloud);
  TestCloud invalid;
  invalid.add(not_a_number, 0.0f, 0.0f);
  const Diagnosis d = ss::diagnose(invalid.view(), ss::BruteSearch(invalid.view()), radius);
  CHECK(d.status == Status::ok);
  CHECK(d.not_finite == 1.0f);
  CHECK(d.sampled == 0);
}

TEST_CASE("diagnose: a radius as large as a crowded cloud is looked at in few places") {
  const TestCloud cloud = sheet(400);  // 160,000 points, each of which has all others as neighbors
  const Diagnosis d = ss::diagnose(cloud.view(), ss::GridSearch(cloud.view(), 0.05f), 10.0f);
  CHECK(d.neighbors == 160000.0f);
  CHECK(d.sampled < 70);
}

}  // namespace test_diagnose
