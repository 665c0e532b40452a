// suggest() and frame_agreement(): lengths that fit a cloud whatever its unit, and describe_cloud() with them.

#include <doctest/doctest.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "fixtures.hpp"

namespace test_suggest {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Ssh32;

TestCloud scaled(TestCloud cloud, float scale, float shift = 0.0f) {
  for (float& v : cloud.xyz) v = scale * v + shift;
  return cloud;
}

/// A grid of points on a plane.
TestCloud flat(float spacing, int columns) {
  TestCloud cloud;
  for (int i = 0; i < columns * columns; ++i) {
    cloud.add(spacing * static_cast<float>(i % columns), spacing * static_cast<float>(i / columns), 1.0f);
  }
  return cloud;
}

}  // namespace

TEST_CASE("suggest: in any unit the same, times the unit") {
  const TestCloud cloud = curved_surface(7, 20000);  // 20 cm wide
  const ss::Suggestion meters = ss::suggest(cloud.view());
  REQUIRE(meters.status == Status::ok);
  CHECK(meters.radius > 10.0f * meters.spacing);
  CHECK(meters.radius < 41.0f * meters.spacing);
  CHECK(meters.leaf == doctest::Approx(0.5 * static_cast<double>(meters.radius)).epsilon(0.06));
  CHECK(meters.normal_radius == doctest::Approx(0.25 * static_cast<double>(meters.radius)).epsilon(0.06));
  for (const float unit : {1000.0f, 0.001f, 39.37f}) {
    const ss::Suggestion s = ss::suggest(scaled(cloud, unit).view());
    REQUIRE(s.status == Status::ok);
    CHECK(s.radius / unit == doctest::Approx(static_cast<double>(meters.radius)).epsilon(0.06));  // two digits
    CHECK(s.spacing / unit == doctest::Approx(static_cast<double>(meters.spacing)).epsilon(0.01));
  }
}

TEST_CASE("suggest: 20 spacings, no more than a third of the extent, no less than 5 spacings") {
  const ss::Suggestion wide = ss::suggest(flat(0.002f, 100).view());
  REQUIRE(wide.status == Status::ok);
  CHECK(wide.spacing == doctest::Approx(0.002));
  CHECK(wide.radius >= 0.04f);  // more where frames do not repeat: all of a plane look alike
  CHECK(ss::suggest(flat(0.002f, 40).view()).radius == 0.026f);
  CHECK(ss::suggest(flat(0.002f, 6).view()).radius == doctest::Approx(0.01));
}

TEST_CASE("suggest: what cannot be measured has a status, and nothing else") {
  const auto refuses = [](const TestCloud& cloud, Status status) {
    const ss::Suggestion s = ss::suggest(cloud.view());
    CHECK(s.status == status);
    CHECK((s.radius == 0.0f && s.leaf == 0.0f && s.normal_radius == 0.0f && s.spacing == 0.0f));
  };
  refuses({}, Status::empty_cloud);
  TestCloud nowhere = flat(1.0f, 3);
  nowhere.xyz.assign(nowhere.xyz.size(), std::numeric_limits<float>::quiet_NaN());
  refuses(nowhere, Status::empty_cloud);
  nowhere.xyz.assign(nowhere.xyz.size(), 3.0f);
  refuses(nowhere, Status::bad_radius);
  refuses(flat(1.0f, 1), Status::bad_radius);
  refuses(scaled(curved_surface(7, 2000), 1.0f, 1e5f), Status::coarse_coordinates);
  const TestCloud cloud = curved_surface(7, 2000);
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(ss::suggest(cloud.view(), ss::Viewpoint::towards({nan, 0, 0})).status == Status::bad_viewpoint);
}

TEST_CASE("frame agreement: larger neighborhoods repeat better, and there may be none") {
  const TestCloud cloud = curved_surface(5, 4000);
  const float small = ss::frame_agreement(cloud.view(), 0.012f, 0.02f);
  const float large = ss::frame_agreement(cloud.view(), 0.06f, 0.02f);
  CHECK(small >= 0.0f);
  CHECK(large > small);
  CHECK(large <= 1.0f);
  CHECK(ss::frame_agreement(cloud.view(), 1e-6f, 0.02f) < 0.0f);
  CHECK(ss::frame_agreement(cloud.view(), -1.0f, 0.02f) < 0.0f);
  CHECK(ss::frame_agreement({}, 0.06f, 0.02f) < 0.0f);
}

TEST_CASE("describe_cloud: a radius of 0 is what is suggested, a leaf of 0 half the radius") {
  const TestCloud cloud = curved_surface(7, 5000);
  ss::CloudOptions asked;
  asked.radius = ss::suggest(cloud.view()).radius;
  asked.leaf = 0.5f * asked.radius;
  ss::CloudOptions open;
  open.radius = open.leaf = 0.0f;
  ss::Features<D> as_asked, as_suggested;
  REQUIRE(ss::describe_cloud(cloud.view(), asked, as_asked) == Status::ok);
  REQUIRE(ss::describe_cloud(cloud.view(), open, as_suggested) == Status::ok);
  CHECK(as_asked.values == as_suggested.values);
  CHECK(as_asked.size() > 20);
  open.radius = asked.radius;
  REQUIRE(ss::describe_cloud(cloud.view(), open, as_suggested) == Status::ok);
  CHECK(as_asked.values == as_suggested.values);
  open.radius = 0.0f;
  CHECK(ss::describe_cloud(flat(1.0f, 1).view(), open, as_suggested) == Status::bad_radius);
  CHECK(as_suggested.size() == 0);
  CHECK(ss::CloudOptions{}.radius == 0.04f);  // two clouds are described alike unless their program asks for less
  CHECK(ss::CloudOptions{}.leaf == 0.0f);
}

}  // namespace test_suggest
