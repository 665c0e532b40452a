// The signal of lidars and time-of-flight cameras: what it says of neighbors, and what must not change a bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"
#include "intensities.hpp"

namespace test_intensity {
namespace {

using namespace unit;
using ss::Status;
using D = ss::IntensityShape336;

constexpr float radius = echo_radius;
constexpr std::size_t points = 1500;

/// Whole numbers from 0 to 255: what all types of channels can hold.
template <class Scalar>
std::vector<Scalar> bytes_as(std::uint32_t seed) {
  Random random(seed);
  std::vector<Scalar> intensities(points);
  for (Scalar& each : intensities) each = static_cast<Scalar>(random.below(256));
  return intensities;
}

}  // namespace

TEST_CASE(
    "intensity: black beside bright is the first bin, as bright the middle one, bright beside black the last one") {
  using Histogram = ss::Descriptor<ss::HardVoting, ss::Part<ss::SphericalGrid<1, 1, 1>, ss::Intensity<15>>>;
  const TestCloud cloud = curved_surface(1, points);
  const auto bin_of = [&](float own, float reference) {
    const std::vector<float> all(points, own);
    ss::KeyPoint key = ss::keypoint(lit(cloud, all), 5);
    key.intensity = reference;
    std::vector<float> out;
    REQUIRE(describe<Histogram>(lit(cloud, all), key, frame_at(cloud.view(), key.position), out) == Status::ok);
    const auto bin = std::find(out.begin(), out.end(), 1.0f) - out.begin();
    CHECK(std::count(out.begin(), out.end(), 0.0f) == 14);
    return bin;
  };
  CHECK(bin_of(0.0f, 3.0f) == 0);
  CHECK(bin_of(-7.0f, 3.0f) == 0);
  CHECK(bin_of(3.0f, 3.0f) == 7);
  CHECK(bin_of(0.0f, 0.0f) == 7);
  CHECK(bin_of(-1.0f, 0.0f) == 7);
  CHECK(bin_of(0.0f, -2.0f) == 7);
  CHECK(bin_of(3.0f, 0.0f) == 14);
  CHECK(bin_of(3.0f, -3.0f) == 14);
  CHECK(bin_of(1.0f, 3.0f) == 3);    // 15 / 4
  CHECK(bin_of(3.0f, 1.0f) == 11);   // 45 / 4
  CHECK(bin_of(1e30f, 1e30f) == 7);  // beyond any sensor
}

TEST_CASE("intensity: a neighbor without a finite one is left out of the whole descriptor") {
  const TestCloud cloud = curved_surface(2, points);
  std::vector<float> intensities = bytes_as<float>(3);
  const std::size_t key = 17;
  const ss::Frame frame = frame_at(cloud.view(), cloud.at(key));
  TestCloud fewer;
  std::vector<float> echoes;
  for (std::size_t i = 0; i < points; ++i) {
    if (i % 3 == 0 && i > key) continue;
    fewer.add(cloud.at(i));
    echoes.push_back(intensities[i]);
  }
  std::vector<float> expected, all, first;
  REQUIRE(describe<D>(lit(fewer, echoes), key, frame, expected) == Status::ok);
  REQUIRE(describe<D>(lit(cloud, intensities), key, frame, all) == Status::ok);
  CHECK(l2_distance(all, expected) > 1e-2);  // it is seen
  for (const float none : {not_a_number, -not_a_number, infinity, -infinity}) {
    CAPTURE(none);
    for (std::size_t i = key + 1; i < points; ++i) {
      if (i % 3 == 0) intensities[i] = none;
    }
    REQUIRE(describe<D>(lit(cloud, intensities), key, frame, all) == Status::ok);
    CHECK(l2_distance(all, expected) < 1e-6);  // no bits: the unit of votes is that of all neighbors
    if (first.empty()) first = all;
    CHECK(same_bits(all, first));
  }
}

TEST_CASE("intensity: what a sensor multiplies all of them with does not change a bit, if it is a power of two") {
  const TestCloud cloud = curved_surface(3, points);
  const std::vector<float> intensities = some_intensities(4, points);
  for (const float factor : {0.125f, 2.0f, 1024.0f}) {
    std::vector<float> scaled = intensities;
    for (float& each : scaled) each *= factor;
    int compared = 0;
    for (std::size_t key = 0; key < 50; ++key) {
      if (!has_echo(intensities[key])) continue;
      REQUIRE(same_bits(described<D>(lit(cloud, intensities), key), described<D>(lit(cloud, scaled), key)));
      ++compared;
    }
    CHECK(compared > 30);
  }
}

TEST_CASE("intensity: floats, bytes and whole numbers of 16 bits give the same bits, packed or not") {
  const TestCloud cloud = curved_surface(5, points);
  const std::vector<float> floats = bytes_as<float>(6);
  const auto bytes = bytes_as<std::uint8_t>(6);
  const auto words = bytes_as<std::uint16_t>(6);
  std::vector<std::uint8_t> between(5 * points, 0xEE);
  for (std::size_t i = 0; i < points; ++i) between[5 * i] = bytes[i];
  const ss::CloudView view = cloud.view();
  for (std::size_t key = 0; key < 30; ++key) {
    const std::vector<float> expected = described<D>(lit(cloud, floats), key);
    REQUIRE(same_bits(described<D>(ss::with_intensities(view, bytes.data()), key), expected));
    REQUIRE(same_bits(described<D>(ss::with_intensities(view, words.data()), key), expected));
    REQUIRE(same_bits(described<D>(ss::with_intensities(view, between.data(), 5), key), expected));
  }
}

TEST_CASE("intensity: a cloud or a key point without one is missing_intensities") {
  const TestCloud cloud = curved_surface(7, points);
  const std::vector<float> intensities = bytes_as<float>(8);
  const ss::CloudView view = lit(cloud, intensities);
  const ss::Frame frame = frame_at(view, cloud.at(3));
  std::vector<float> out;
  const auto refused = [&](const ss::CloudView& of, const auto& place) {
    return describe<D>(of, place, frame, out) == Status::missing_intensities && all_zero(out);
  };
  ss::KeyPoint key = ss::keypoint(view, 3);
  CHECK(describe<D>(view, key, frame, out) == Status::ok);
  CHECK(refused(cloud.view(), std::size_t{3}));
  CHECK(refused(cloud.view(), key));
  CHECK(refused(ss::with_intensities(view, static_cast<const float*>(nullptr)), key));
  CHECK(refused(view, ss::KeyPoint(cloud.at(3), {1, 2, 3})));
  for (const float none : {not_a_number, infinity, -infinity}) {
    key.intensity = none;
    CHECK(refused(view, key));
  }

  std::vector<float> holes = intensities;
  holes[3] = not_a_number;
  ss::Features<D> features;
  const std::vector<std::uint32_t> keypoints{2, 3, 4};
  const ss::BruteSearch search{view};
  CHECK(ss::extract(cloud.view(), search, keypoints, radius, features) == Status::missing_intensities);
  REQUIRE(ss::extract(lit(cloud, holes), search, keypoints, radius, features) == Status::ok);
  CHECK(features.status == std::vector<Status>{Status::ok, Status::missing_intensities, Status::ok});
  CHECK(std::all_of(features.values.begin() + D::size, features.values.begin() + 2 * D::size,
                    [](float value) { return value == 0.0f; }));
}

TEST_CASE("intensity: extract() and describe_at() agree, at points and at centroids, which have the mean") {
  const TestCloud cloud = curved_surface(9, points);
  std::vector<float> intensities = bytes_as<float>(10);
  for (std::size_t i = 0; i < points; i += 10) intensities[i] = not_a_number;
  const ss::CloudView view = lit(cloud, intensities);
  std::vector<ss::KeyPoint> keypoints;
  REQUIRE(ss::sample_centroids(view, 0.02f, keypoints) == Status::ok);
  std::vector<std::uint32_t> indices;
  REQUIRE(ss::sample_uniform(view, 0.02f, indices) == Status::ok);
  const ss::GridSearch search(view, radius);
  ss::Features<D> at_centroids, at_points;
  REQUIRE(ss::extract(view, search, keypoints, radius, at_centroids, 2) == Status::ok);
  REQUIRE(ss::extract(view, search, indices, radius, at_points, 3) == Status::ok);
  static ss::Workspace<2048> workspace;
  const auto agree = [&](const ss::Features<D>& features, std::size_t row, const auto& place) {
    std::vector<float> one = garbage<D>();
    const Status status = ss::describe_at<D>(view, search, place, radius, workspace, one.data());
    const float* first = features.values.data() + row * one.size();
    return status == features.status[row] && same_bits(one, std::vector<float>(first, first + one.size()));
  };
  for (std::size_t k = 0; k < keypoints.size(); ++k) REQUIRE(agree(at_centroids, k, keypoints[k]));
  for (std::size_t k = 0; k < indices.size(); ++k) REQUIRE(agree(at_points, k, indices[k]));
  CHECK(std::count(at_centroids.status.begin(), at_centroids.status.end(), Status::ok) > 50);

  REQUIRE(ss::sample_centroids(view, 1e3f, keypoints) == Status::ok);  // one voxel on each side of 0: x and y
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < points; ++i) {
    const bool in_first = cloud.at(i).x < 0.0f && cloud.at(i).y < 0.0f;
    if (!in_first || !has_echo(intensities[i])) continue;
    sum += static_cast<double>(intensities[i]);
    count += 1.0;
  }
  REQUIRE(keypoints.size() == 4);
  REQUIRE(bool{keypoints[0].has_intensity});
  CHECK(static_cast<double>(keypoints[0].intensity) == doctest::Approx(sum / count).epsilon(1e-6));
  const std::vector<float> none(points, not_a_number);
  REQUIRE(ss::sample_centroids(lit(cloud, none), 1e3f, keypoints) == Status::ok);
  CHECK_FALSE(bool{keypoints[0].has_intensity});
}

}  // namespace test_intensity
