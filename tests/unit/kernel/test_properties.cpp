// What a descriptor must not depend on: motion, order, place, scale, the search, the number of threads.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "fixtures.hpp"
#include "oracle.hpp"
#include "pinhole.hpp"

namespace test_properties {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Scsh336;

template <class Voting>
using Scsh336With = ss::Scsh<ss::SphericalGrid<3, 4, 8>, ss::SphericalGrid<2, 2, 4>, 15, Voting>;

constexpr float radius = 0.05f;

template <class Descriptor, class Search>
std::vector<float> describe(const TestCloud& cloud, const Search& search, std::size_t key, float r = radius) {
  static ss::Workspace<8000> workspace;
  std::vector<float> out = garbage<Descriptor>();
  REQUIRE(ss::describe_at<Descriptor>(cloud.view(), search, key, r, workspace, out.data()) == Status::ok);
  return out;
}

template <class Descriptor = D>
std::vector<float> describe(const TestCloud& cloud, std::size_t key, float r = radius) {
  return describe<Descriptor>(cloud, ss::BruteSearch{cloud.view()}, key, r);
}

template <class Function>
TestCloud moved(const TestCloud& cloud, Function f) {
  TestCloud result = cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const ss::Point p = f(cloud.at(i));
    result.xyz[3 * i] = p.x;
    result.xyz[3 * i + 1] = p.y;
    result.xyz[3 * i + 2] = p.z;
  }
  return result;
}

/// A cloud on a grid of 2^-13 m: differences are exact, near the origin and a kilometer away.
TestCloud dyadic_cloud(std::uint32_t seed, std::size_t points) {
  Random random(seed);
  return moved(blob(seed, points), [&random](const ss::Point&) {
    const float x = random.dyadic(-0.1f, 0.1f, 13);
    const float y = random.dyadic(-0.07f, 0.1f, 13);
    return ss::Point{x, y, random.dyadic(-0.05f, 0.02f, 13)};
  });
}

bool has_clear_frame(const TestCloud& cloud, std::size_t key) {
  const ss::Point p = cloud.at(key);
  return oracle::shot_frame(oracle::neighbors(cloud.xyz, {p.x, p.y, p.z}, radius * radius), static_cast<double>(radius))
      .clear;
}

}  // namespace

TEST_CASE("properties: a rigid motion of cloud and key point leaves the descriptor") {
  Random random(1);
  for (const TestCloud& cloud : {curved_surface(2, 1500), blob(3, 1500)}) {
    int compared = 0;
    double worst_published = 0.0;
    for (int round = 0; round < 40; ++round) {
      const std::size_t key = random.below(cloud.size());
      if (!has_clear_frame(cloud, key)) continue;  // a vote on the fence may fall to the other side
      ++compared;
      Eigen::Vector4f q(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
      const Eigen::Matrix3d rotation = Eigen::Quaterniond(q.cast<double>().normalized()).toRotationMatrix();
      const Eigen::Vector3d shift = Eigen::Vector3f(random.between(-1, 1), 0.5f, -0.5f).cast<double>();
      const TestCloud turned = moved(cloud, [&](const ss::Point& p) {
        const Eigen::Vector3f r = (rotation * Eigen::Vector3f(p.x, p.y, p.z).cast<double>() + shift).cast<float>();
        return ss::Point{r[0], r[1], r[2]};
      });
      // Coordinates of a meter round to 6e-8 m, 1e-6 of the radius; linear votes move by about as much.
      using Linear = Scsh336With<ss::MultilinearVoting>;
      CHECK(l2_distance(describe<Linear>(cloud, key), describe<Linear>(turned, key)) < 1e-4);
      worst_published = std::max(worst_published, l2_distance(describe(cloud, key), describe(turned, key)));
    }
    CHECK(compared > 20);
    CHECK(worst_published < 0.03);  // a vote or two of hundreds jump over a border
  }
}

TEST_CASE("properties: the order of the points changes no bit of frames and descriptors") {
  Random random(4);
  for (const TestCloud& cloud : {curved_surface(5, 1500), blob(6, 1500)}) {
    std::vector<std::size_t> order(cloud.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t k = order.size() - 1; k > 0; --k) std::swap(order[k], order[random.below(k + 1)]);
    TestCloud shuffled;
    for (const std::size_t i : order) shuffled.add(cloud.at(i), cloud.color_at(i));
    for (std::size_t k = 0; k < 60; ++k) {
      REQUIRE(same_bits(describe(shuffled, k), describe(cloud, order[k])));
    }
  }
}

TEST_CASE("properties: ten meters and a kilometer away, exact coordinates give the same bits") {
  const TestCloud cloud = dyadic_cloud(7, 1500);
  for (const float shift : {10.0f, -1000.0f}) {
    const TestCloud far = moved(cloud, [shift](const ss::Point& p) {
      return ss::Point{p.x + shift, p.y - shift, p.z + 0.5f * shift};
    });
    for (std::size_t key = 0; key < 40; ++key) REQUIRE(same_bits(describe(far, key), describe(cloud, key)));
  }
}

TEST_CASE("properties: scaling cloud and radius by a power of two changes no bit") {
  // (Down to where a squared distance of 1e-15, the published bound for copies, comes into play.)
  const TestCloud cloud = curved_surface(8, 1500);
  for (const float scale : {1.0f / 1024.0f, 0.5f, 4.0f, 1048576.0f}) {
    CAPTURE(scale);
    const TestCloud scaled = moved(cloud, [scale](const ss::Point& p) {
      return ss::Point{p.x * scale, p.y * scale, p.z * scale};
    });
    for (std::size_t key = 0; key < 40; ++key) {
      REQUIRE(same_bits(describe(scaled, key, radius * scale), describe(cloud, key)));
    }
  }
}

TEST_CASE("properties: every point twice, or the key point many times, describes the same") {
  const TestCloud cloud = curved_surface(9, 1500);
  TestCloud twice = cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i) twice.add(cloud.at(i), cloud.color_at(i));
  int compared = 0;
  for (std::size_t key = 0; key < 40; ++key) {
    if (!has_clear_frame(cloud, key)) continue;  // a tied vote looks at five points, or now at twice two and a half
    ++compared;
    const std::vector<float> once = describe(cloud, key);
    // Votes round to 2^-19 or finer, frames to the same grid; under the published rule none of them may jump.
    CHECK(l2_distance(describe(twice, key), once) < 1e-5);
    TestCloud copies = cloud;
    for (int k = 0; k < 300; ++k) copies.add(cloud.at(key), {1, 2, 3});
    CHECK(l2_distance(describe(copies, key), once) < 1e-5);
  }
  CHECK(compared > 20);
}

TEST_CASE("properties: all searches give the same bits on an organized cloud") {
  const TestCloud image = pinhole_image(10, {});
  const ss::CloudView view = ss::organized(image.view(), image_width, image_height);
  const ss::GridSearch grid(view, 0.1f);
  static ss::StaticGrid<image_width * image_height, 4096> static_grid;
  REQUIRE(static_grid.build(view, 0.07f) == Status::ok);
  ss::OrganizedSearch organized{};
  REQUIRE(organized.build(view) == Status::ok);
  const ss::NanoflannSearch tree(view);
  const ss::BruteSearch brute{view};
  Room room(image.size());
  for (std::size_t key = 0; key < image.size(); key += 61) {
    const auto neighbors = found_by(brute, image.at(key), 0.1f, room);
    const std::vector<float> expected = describe<D>(image, brute, key, 0.1f);
    const auto check_search = [&](const auto& search) {
      REQUIRE(found_by(search, image.at(key), 0.1f, room) == neighbors);
      REQUIRE(same_bits(describe<D>(image, search, key, 0.1f), expected));
    };
    check_search(grid);
    check_search(static_grid);
    check_search(organized);
    check_search(tree);
  }
}

TEST_CASE("properties: one, two and five threads give the same bits, and those of describe_at()") {
  const TestCloud cloud = curved_surface(11, 1500);
  const ss::GridSearch grid(cloud.view(), radius);
  std::vector<std::uint32_t> keypoints;
  for (std::uint32_t i = 0; i < 1500; i += 7) keypoints.push_back(i);
  ss::Features<D> one, two, five;
  REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, one, 1) == Status::ok);
  REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, two, 2) == Status::ok);
  REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, five, 5) == Status::ok);
  CHECK(same_bits(one.values, two.values));
  CHECK(same_bits(one.values, five.values));
  CHECK(one.status == five.status);
  CHECK(one.neighbors == five.neighbors);
  for (std::size_t row = 0; row < keypoints.size(); ++row) {
    const std::vector<float> extracted(one[row], one[row] + D::size);
    REQUIRE(same_bits(extracted, describe(cloud, keypoints[row])));
  }
}

TEST_CASE("properties: every descriptor has L2 norm 1") {
  for (const TestCloud& cloud : {curved_surface(12, 1500), blob(13, 1500)}) {
    for (std::size_t key = 0; key < 60; ++key) {
      const auto norm_of = [](const std::vector<float>& v) {
        return l2_distance(v, std::vector<float>(v.size(), 0.0f));
      };
      // Sums of at most a few hundred floats and one rounding per value.
      CHECK(std::abs(norm_of(describe<D>(cloud, key)) - 1.0) < 1e-6);
      CHECK(std::abs(norm_of(describe<ss::Ssh32>(cloud, key)) - 1.0) < 1e-6);
      CHECK(std::abs(norm_of(describe<Scsh336With<ss::HardVoting>>(cloud, key)) - 1.0) < 1e-6);
    }
  }
}

TEST_CASE("properties: hard voting counts every neighbor once") {
  const TestCloud cloud = blob(14, 1500);
  Room room(cloud.size());
  for (std::size_t key = 0; key < 40; ++key) {
    const auto counted = found_by(ss::BruteSearch{cloud.view()}, cloud.at(key), radius, room).size() - 1;
    const std::vector<float> values = describe<ss::Ssh<ss::SphericalGrid<3, 4, 8>, ss::HardVoting>>(cloud, key);
    // Undo the normalization: the sum of all cells was the number of neighbors.
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    for (const float value : values) {
      const double count = static_cast<double>(value) * static_cast<double>(counted) / sum;
      CHECK(std::abs(count - std::round(count)) < 1e-3);
    }
    double squares = 0.0;  // and the norm was that of whole numbers with this sum
    for (const float value : values)
      squares += std::pow(std::round(static_cast<double>(value) * static_cast<double>(counted) / sum), 2);
    CHECK(std::sqrt(squares) == doctest::Approx(static_cast<double>(counted) / sum).epsilon(1e-5));
  }
}

}  // namespace test_properties
