// Frames whose x axis points to where it is brighter: against the formula in double precision, and what they promise.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "fixtures.hpp"
#include "oracle.hpp"
#include "synthetic_objects.hpp"

namespace test_fixed_lamp_frame {
namespace {

using namespace unit;
using ss::Status;

constexpr float radius = 0.05f;
constexpr std::size_t points = 1500;
const ss::Viewpoint camera = ss::Viewpoint::towards({0.0f, 0.0f, 0.0f});

struct Estimate {
  Status status;
  ss::Frame frame;
};

template <class Colors>
Estimate estimate(const ss::CloudView& cloud, const ss::Point& center, const Colors& colors,
                  const ss::Viewpoint& viewpoint = camera) {
  static Room room(points);
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud}.gather(center, radius, n) == Status::ok);
  Estimate made{Status::ok, {{1.0f}, {1.0f}, {1.0f}}};
  made.status = ss::estimate_frame_under_fixed_lamp(n, colors, radius, made.frame, viewpoint);
  return made;
}

ss::RgbColors<ss::PublishedLab> colors_of(const ss::CloudView& cloud) { return {cloud, ss::Rgb{}}; }

Estimate estimate(const TestCloud& cloud, const ss::Point& center) {
  return estimate(cloud.view(), center, colors_of(cloud.view()));
}

ss::Frame shot_frame(const TestCloud& cloud, const ss::Point& center) {
  Room room(points);
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(center, radius, n) == Status::ok);
  ss::Frame frame{};
  REQUIRE(ss::estimate_frame(n, radius, frame, camera) == Status::ok);
  return frame;
}

bool same_bits(const ss::Frame& a, const ss::Frame& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

double angle(const float (&a)[3], const float (&b)[3]) {
  double difference = 0.0;
  for (int k = 0; k < 3; ++k) difference += std::pow(static_cast<double>(a[k]) - static_cast<double>(b[k]), 2);
  return 2.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(difference)));
}

/// x by its formula, given z; and how long the gradient is beside what single points add to it.
struct Expected {
  double x[3];
  double length;
};

Expected expected_x(const TestCloud& cloud, const ss::Point& center, const float (&z)[3]) {
  const auto near = oracle::neighbors(cloud.xyz, {center.x, center.y, center.z}, radius * radius);
  const auto weight_of = [](const oracle::Neighbor& n) {
    return n.d2 > 0.0f ? static_cast<double>(radius) - std::sqrt(static_cast<double>(n.d2)) : 0.0;
  };
  const auto brightness_of = [&](const oracle::Neighbor& n) {
    const ss::Rgb c = cloud.color_at(n.index);
    return oracle::lab({c.r, c.g, c.b}, oracle::LabRule::published)[0];
  };
  double weights = 0.0, mean = 0.0, along_z = 0.0, squares = 0.0;
  for (const auto& n : near) weights += weight_of(n);
  for (const auto& n : near) mean += weight_of(n) * brightness_of(n) / weights;
  Expected expected{};
  for (const auto& n : near) {
    for (std::size_t k = 0; k < 3; ++k) {
      expected.x[k] += weight_of(n) * (brightness_of(n) - mean) * static_cast<double>(n.v[k]);
    }
  }
  for (int k = 0; k < 3; ++k) along_z += expected.x[k] * static_cast<double>(z[k]);
  for (int k = 0; k < 3; ++k) expected.x[k] -= along_z * static_cast<double>(z[k]);
  for (const double component : expected.x) squares += component * component;
  for (double& component : expected.x) component /= std::sqrt(squares);
  expected.length = std::sqrt(squares) / (weights * static_cast<double>(radius) * 100.0);
  return expected;
}

/// The same cloud after a motion.
TestCloud moved(const TestCloud& cloud, const Motion& motion) {
  TestCloud result;
  for (std::size_t i = 0; i < cloud.size(); ++i) result.add(motion(cloud.at(i)), cloud.color_at(i));
  return result;
}

/// Shaded by a lamp far away: gray, and as bright as the surface lies across its light.
TestCloud lit(TestCloud cloud, float x, float y) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const ss::Point p = cloud.at(i);
    const auto gray = static_cast<std::uint8_t>(120.0f + 800.0f * (x * p.x + y * p.y));
    std::fill_n(cloud.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, gray);
  }
  return cloud;
}

/// Somebody's own colors, darker.
struct Dimmed {
  ss::RgbColors<ss::PublishedLab> colors;
  float gain;
  Status status() const { return colors.status(); }
  ss::Lab operator()(std::uint32_t index) const {
    const ss::Lab lab = colors(index);
    return {gain * lab.L, lab.a, lab.b};
  }
};

}  // namespace

TEST_CASE("fixed lamp: z is SHOT's, x is the formula's, y is z cross x") {
  int compared = 0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const TestCloud cloud = seed % 2 == 0 ? blob(seed, points) : curved_surface(seed, points);
    for (std::size_t k = 0; k < 30; ++k) {
      const ss::Point center = cloud.at(37 * k);
      const Estimate made = estimate(cloud, center);
      REQUIRE(made.status == Status::ok);
      CHECK(ss::validate(made.frame) == Status::ok);
      CHECK(std::memcmp(made.frame.z, shot_frame(cloud, center).z, sizeof made.frame.z) == 0);
      const Expected expected = expected_x(cloud, center, made.frame.z);
      if (expected.length < 1e-3) continue;  // what is short turns by roundings
      for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(static_cast<double>(made.frame.x[i]) - expected.x[i]) < 1e-4);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
        const float cross = made.frame.z[j] * made.frame.x[l] - made.frame.z[l] * made.frame.x[j];
        CHECK(made.frame.y[i] == doctest::Approx(static_cast<double>(cross)).epsilon(1e-6));
      }
      ++compared;
    }
  }
  CHECK(compared > 100);
}

TEST_CASE("fixed lamp: without a gradient it is SHOT's frame, bit for bit") {
  TestCloud plain = curved_surface(5, points);
  for (std::size_t i = 0; i < plain.size(); ++i)
    std::fill_n(plain.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, 77);
  TestCloud upwards;  // the gradient is along z alone
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    const float x = random.between(0.0f, 0.03f), y = random.between(0.0f, 0.02f), z = random.between(-0.005f, 0.005f);
    const auto gray = static_cast<std::uint8_t>(128.0f + 20000.0f * z);
    for (const float sign : {1.0f, -1.0f}) {
      for (const float other : {1.0f, -1.0f}) upwards.add(sign * x, other * y, 1.0f + z, {gray, gray, gray});
    }
  }
  for (std::size_t k = 0; k < 20; ++k) {
    CHECK(same_bits(estimate(plain, plain.at(50 * k)).frame, shot_frame(plain, plain.at(50 * k))));
  }
  const ss::Point middle{0.0f, 0.0f, 1.0f};
  CHECK(estimate(upwards, middle).status == Status::ok);
  CHECK(same_bits(estimate(upwards, middle).frame, shot_frame(upwards, middle)));
}

TEST_CASE("fixed lamp: the frame turns with the cloud, and with the lamp") {
  Random random(7);
  const TestCloud cloud = curved_surface(8, points);
  for (std::size_t k = 0; k < 20; ++k) {
    const ss::Point center = cloud.at(31 * k);
    const Motion motion = random_motion(random);
    const TestCloud there = moved(cloud, motion);
    const ss::Viewpoint towards = ss::Viewpoint::towards(motion(ss::Point{0.0f, 0.0f, 0.0f}));
    const Estimate made = estimate(there.view(), there.at(31 * k), colors_of(there.view()), towards);
    const ss::Frame expected = motion(estimate(cloud, center).frame);
    CHECK(angle(made.frame.x, expected.x) < 2e-3);
    CHECK(angle(made.frame.z, expected.z) < 2e-3);
  }
  const TestCloud before = lit(cloud, 1.0f, 0.0f), after = lit(cloud, 0.0f, 1.0f);
  for (std::size_t k = 0; k < 20; ++k) {
    const ss::Point center = cloud.at(31 * k);
    if (std::abs(center.x) > 0.06f || std::abs(center.y) > 0.06f) continue;
    CHECK(angle(estimate(before, center).frame.x, estimate(after, center).frame.x) > 1.0);
    CHECK(same_bits(shot_frame(before, center), shot_frame(after, center)));
  }
}

TEST_CASE("fixed lamp: a gain of the brightness leaves x where it is") {
  const TestCloud cloud = curved_surface(9, points);
  TestCloud dark = cloud;
  for (std::uint8_t& byte : dark.rgb) byte = static_cast<std::uint8_t>(std::lround(0.8 * static_cast<double>(byte)));
  for (std::size_t k = 0; k < 20; ++k) {
    const ss::Point center = cloud.at(29 * k);
    const ss::Frame frame = estimate(cloud, center).frame;
    const Dimmed dimmed{colors_of(cloud.view()), 0.6f};
    if (expected_x(cloud, center, frame.z).length < 3e-3) continue;
    CHECK(angle(estimate(cloud.view(), center, dimmed).frame.x, frame.x) < 1e-3);
    CHECK(angle(estimate(dark, center).frame.x, frame.x) < 0.1);
  }
}

TEST_CASE("fixed lamp: the same bits in any order, from stored colors, and in little memory") {
  const TestCloud cloud = curved_surface(10, points);
  std::vector<ss::Lab> lab(cloud.size());
  REQUIRE(ss::convert_colors<ss::PublishedLab>(cloud.view(), lab.data()) == Status::ok);
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::reverse(order.begin(), order.end());
  std::rotate(order.begin(), order.begin() + 401, order.end());
  TestCloud shuffled;
  for (const std::size_t i : order) shuffled.add(cloud.at(i), cloud.color_at(i));
  static ss::CompactWorkspace<points> compact;
  for (std::size_t k = 0; k < 20; ++k) {
    const ss::Point center = cloud.at(29 * k);
    const ss::Frame frame = estimate(cloud, center).frame;
    CHECK(same_bits(estimate(shuffled, center).frame, frame));
    CHECK(same_bits(estimate(cloud.view(), center, ss::LabColors{lab.data(), {}}).frame, frame));
    auto n = ss::neighborhood_in(compact, cloud.view());
    REQUIRE(ss::BruteSearch{cloud.view()}.gather(center, radius, n) == Status::ok);
    ss::Frame from_indices{};
    REQUIRE(ss::estimate_frame_under_fixed_lamp(n, colors_of(cloud.view()), radius, from_indices, camera) ==
            Status::ok);
    CHECK(same_bits(from_indices, frame));
  }
}

TEST_CASE("fixed lamp: statuses, and zeros where there is no frame") {
  const TestCloud cloud = curved_surface(11, points);
  const ss::Point center = cloud.at(3);
  const ss::CloudView without = ss::view_xyz(cloud.xyz.data(), cloud.size());
  const Estimate estimates[] = {
      estimate(without, center, colors_of(without)), estimate(cloud, {5.0f, 0.0f, 0.0f}),
      estimate(cloud.view(), center, colors_of(cloud.view()), ss::Viewpoint::towards({not_a_number, 0.0f, 0.0f}))};
  const Status expected[] = {Status::missing_colors, Status::too_few_neighbors, Status::bad_viewpoint};
  for (int i = 0; i < 3; ++i) {
    CHECK(estimates[i].status == expected[i]);
    CHECK(same_bits(estimates[i].frame, ss::Frame{}));
  }
}

}  // namespace test_fixed_lamp_frame
