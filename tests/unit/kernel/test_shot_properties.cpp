// What SHOT and CSHOT must not depend on, what a missing normal means, and where in the layout a neighbor counts.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "fixtures.hpp"
#include "oracle_shot.hpp"

namespace test_shot_properties {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Cshot1344;

constexpr float radius = 0.05f;
constexpr ss::Frame upright{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const double pi = std::acos(-1.0);

template <class Descriptor = D>
std::vector<float> describe(const TestCloud& cloud, std::size_t key, float r = radius) {
  static ss::Workspace<8000> workspace;
  std::vector<float> out = garbage<Descriptor>();
  REQUIRE(ss::describe_at<Descriptor>(cloud.view(), ss::BruteSearch{cloud.view()}, key, r, workspace, out.data()) ==
          Status::ok);
  return out;
}

template <class Descriptor>
std::vector<float> describe_in(const ss::Frame& frame, const TestCloud& cloud, std::size_t key, float r,
                               Status expected = Status::ok) {
  static ss::Workspace<8000> workspace;
  std::vector<float> out = garbage<Descriptor>();
  CHECK(ss::describe_at<Descriptor>(cloud.view(), ss::BruteSearch{cloud.view()}, ss::keypoint(cloud.view(), key), frame,
                                    r, workspace, out.data()) == expected);
  return out;
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

TestCloud surface(std::uint32_t seed) { return with_surface_normals(curved_surface(seed, 1500), seed); }
TestCloud random_blob(std::uint32_t seed) { return with_random_normals(blob(seed, 1500), seed); }

bool has_clear_frame(const TestCloud& cloud, std::size_t key) {
  const ss::Point p = cloud.at(key);
  return oracle::shot_frame(oracle::neighbors(cloud.xyz, {p.x, p.y, p.z}, radius * radius), static_cast<double>(radius))
      .clear;
}

/// The cloud turned and shifted, and its normals turned with it.
TestCloud rigidly_moved(const TestCloud& cloud, Random& random) {
  const Eigen::Vector4f q(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
  const Eigen::Matrix3d rotation = Eigen::Quaterniond(q.cast<double>().normalized()).toRotationMatrix();
  const Eigen::Vector3d shift = Eigen::Vector3f(random.between(-1, 1), 0.5f, -0.5f).cast<double>();
  TestCloud result = moved(cloud, [&](const ss::Point& p) {
    const Eigen::Vector3f r = (rotation * Eigen::Vector3f(p.x, p.y, p.z).cast<double>() + shift).cast<float>();
    return ss::Point{r[0], r[1], r[2]};
  });
  for (ss::SurfaceNormal& n : result.normals) {
    const Eigen::Vector3f r = (rotation * Eigen::Vector3f(n.x, n.y, n.z).cast<double>()).cast<float>();
    n = {r[0], r[1], r[2]};
  }
  return result;
}

/// A lone neighbor in the middle of a cell, with its cosine on the center of a bin, for every value of SHOT.
template <class Grid, int Bins, class Voting>
void check_layout() {
  using G = Grid;
  using P = ss::Part<Grid, ss::NormalCosine<Bins>, ss::LinearRadius, ss::ShotCells>;
  using Descriptor = ss::Descriptor<Voting, P>;
  constexpr int bins = Bins + 1;
  for (int k = 0; k < P::size; ++k) {
    const int bin = k % bins;
    const int e = k / bins % G::elevation;  // from -z upwards
    const int r = k / bins / G::elevation % G::radial;
    const int a = k / bins / G::elevation / G::radial;
    REQUIRE(P::index(r, e, a, bin) == k);
    const double distance = (r + 0.5) / G::radial;
    const double angle = pi * (1.0 - (e + 0.5) / G::elevation);
    const double azimuth = 2.0 * pi * (a + 0.5) / G::azimuth - pi;
    TestCloud cloud;
    cloud.add(static_cast<float>(distance * std::sin(angle) * std::cos(azimuth)),
              static_cast<float>(distance * std::sin(angle) * std::sin(azimuth)),
              static_cast<float>(distance * std::cos(angle)));
    for (int copy = 0; copy < 4; ++copy) cloud.add(0.0f, 0.0f, 0.0f);
    const auto cosine = static_cast<float>(2.0 * bin / (bins - 1) - 1.0);
    cloud.normals.assign(5, {0.0f, std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)), cosine});
    const std::vector<float> values = describe_in<Descriptor>(upright, cloud, 4, 1.0f);
    REQUIRE(values[static_cast<std::size_t>(k)] > 0.99999f);  // all four shares; partners' ones are roundings
  }
}

}  // namespace

TEST_CASE("shot properties: a rigid motion of points, normals and key point leaves the descriptor") {
  Random random(1);
  for (const TestCloud& cloud : {surface(2), random_blob(3)}) {
    int compared = 0;
    double worst = 0.0;
    std::vector<double> distances;
    for (int round = 0; round < 40; ++round) {
      const std::size_t key = random.below(cloud.size());
      if (!has_clear_frame(cloud, key)) continue;  // a vote on the fence may fall to the other side
      ++compared;
      const TestCloud turned = rigidly_moved(cloud, random);
      distances.push_back(l2_distance(describe(cloud, key), describe(turned, key)));
      worst = std::max(worst, distances.back());
    }
    CHECK(compared > 20);
    // Coordinates of a meter round to 6e-8 m, 1e-6 of the radius: of the many votes, one or two jump over a border.
    CHECK(worst < 0.03);
    std::sort(distances.begin(), distances.end());
    CHECK(distances[distances.size() / 2] < 1e-4);
  }
}

TEST_CASE("shot properties: the order of the points changes no bit") {
  Random random(4);
  for (const TestCloud& cloud : {surface(5), random_blob(6)}) {
    std::vector<std::size_t> order(cloud.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t k = order.size() - 1; k > 0; --k) std::swap(order[k], order[random.below(k + 1)]);
    TestCloud shuffled;
    for (const std::size_t i : order) {
      shuffled.add(cloud.at(i), cloud.color_at(i));
      shuffled.normals.push_back(cloud.normals[i]);
    }
    for (std::size_t k = 0; k < 60; ++k) {
      REQUIRE(same_bits(describe(shuffled, k), describe(cloud, order[k])));
      REQUIRE(same_bits(describe<ss::PclShot352>(shuffled, k), describe<ss::PclShot352>(cloud, order[k])));
    }
  }
}

TEST_CASE("shot properties: ten meters and a kilometer away, exact coordinates give the same bits") {
  Random random(7);
  const TestCloud cloud = moved(random_blob(7), [&random](const ss::Point&) {
    const float x = random.dyadic(-0.1f, 0.1f, 13);
    const float y = random.dyadic(-0.07f, 0.1f, 13);
    return ss::Point{x, y, random.dyadic(-0.05f, 0.02f, 13)};
  });
  for (const float shift : {10.0f, -1000.0f}) {
    const TestCloud far = moved(cloud, [shift](const ss::Point& p) {
      return ss::Point{p.x + shift, p.y - shift, p.z + 0.5f * shift};
    });
    for (std::size_t key = 0; key < 40; ++key) REQUIRE(same_bits(describe(far, key), describe(cloud, key)));
  }
}

TEST_CASE("shot properties: scaling cloud and radius by a power of two changes no bit") {
  const TestCloud cloud = surface(8);
  for (const float scale : {1.0f / 1048576.0f, 0.5f, 4.0f, 1048576.0f}) {
    CAPTURE(scale);
    const TestCloud scaled = moved(cloud, [scale](const ss::Point& p) {
      return ss::Point{p.x * scale, p.y * scale, p.z * scale};
    });
    for (std::size_t key = 0; key < 40; ++key) {
      REQUIRE(same_bits(describe(scaled, key, radius * scale), describe(cloud, key)));
    }
  }
}

TEST_CASE("shot properties: every point twice, or the key point many times, describes the same") {
  const TestCloud cloud = surface(9);
  TestCloud twice = cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    twice.add(cloud.at(i), cloud.color_at(i));
    twice.normals.push_back(cloud.normals[i]);
  }
  int compared = 0;
  for (std::size_t key = 0; key < 40; ++key) {
    if (!has_clear_frame(cloud, key)) continue;  // a tied vote looks at five points, or now at twice two and a half
    ++compared;
    const std::vector<float> once = describe(cloud, key);
    CHECK(l2_distance(describe(twice, key), once) < 1e-5);
    TestCloud copies = cloud;
    for (int k = 0; k < 300; ++k) {  // whatever their colors and normals are
      copies.add(cloud.at(key), {1, 2, 3});
      copies.normals.push_back({1.0f, 0.0f, 0.0f});
    }
    CHECK(l2_distance(describe(copies, key), once) < 1e-5);
  }
  CHECK(compared > 20);
}

TEST_CASE("shot properties: points without a normal have no vote, but count as neighbors and for the frame") {
  const float missing[] = {not_a_number, infinity, -infinity};
  TestCloud cloud = random_blob(10);
  TestCloud rest;  // without them
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ss::SurfaceNormal& n = cloud.normals[i];
    const std::size_t kind = i % 9;
    if (kind < 3) (kind == 0 ? n.x : kind == 1 ? n.y : n.z) = missing[i / 9 % 3];  // one of three is enough
    if (kind < 3 || !ss::extend::math::is_finite(n.x)) continue;
    rest.add(cloud.at(i), cloud.color_at(i));
    rest.normals.push_back(n);
    kept.push_back(i);
  }
  for (std::size_t k = 0; k < 40; ++k) {
    CHECK(l2_distance(describe_in<D>(upright, cloud, kept[k], radius), describe_in<D>(upright, rest, k, radius)) <
          1e-6);
  }
  TestCloud few;  // five entries, one vote
  for (int k = 0; k < 5; ++k) few.add(0.1f * static_cast<float>(k), 0.05f, 0.02f);
  few.normals.assign(5, no_normal);
  few.normals[3] = {0.0f, 0.0f, 1.0f};
  CHECK(!all_zero(describe_in<D>(upright, few, 0, 1.0f)));
  few.normals[3] = no_normal;
  few.normals[0] = {0.0f, 0.0f, 1.0f};  // the key point's own: no vote either
  CHECK(all_zero(describe_in<D>(upright, few, 0, 1.0f, Status::too_few_neighbors)));
  few.normals[0] = no_normal;
  CHECK(all_zero(describe_in<D>(upright, few, 0, 1.0f, Status::too_few_neighbors)));
}

TEST_CASE("shot properties: turning all normals round mirrors every cell's histogram") {
  const TestCloud cloud = random_blob(11);
  TestCloud flipped = cloud;
  for (ss::SurfaceNormal& n : flipped.normals) n = {-n.x, -n.y, -n.z};
  for (std::size_t key = 0; key < 40; ++key) {
    std::vector<float> mirrored = describe<ss::Shot352>(flipped, key);
    for (std::size_t cell = 0; cell < 32; ++cell) {
      const auto first = mirrored.begin() + static_cast<std::ptrdiff_t>(11 * cell);
      std::reverse(first, first + 11);
    }
    // Cosines round on either side alike, but positions from 0 to 10 do not.
    CHECK(l2_distance(describe<ss::Shot352>(cloud, key), mirrored) < 1e-5);
  }
}

TEST_CASE("shot properties: a neighbor in the middle of a cell and a bin counts at that place of the layout") {
  check_layout<ss::SphericalGrid<2, 2, 8>, 10, ss::ShotVoting>();
  check_layout<ss::SphericalGrid<2, 2, 8>, 10, ss::PclVoting>();
  check_layout<ss::SphericalGrid<3, 4, 6>, 7, ss::ShotVoting>();
  check_layout<ss::SphericalGrid<4, 1, 3>, 1, ss::ShotVoting>();
  check_layout<ss::SphericalGrid<3, 4, 6>, 7, ss::HardVoting>();
  check_layout<ss::SphericalGrid<3, 4, 6>, 7, ss::MultilinearVoting>();
}

TEST_CASE(
    "shot properties: one and three threads give the same bits, and those of describe_at(), in the frames that they "
    "report") {
  const TestCloud cloud = surface(12);
  const ss::GridSearch grid(cloud.view(), radius);
  std::vector<std::uint32_t> keypoints;
  for (std::uint32_t i = 0; i < 1500; i += 17) keypoints.push_back(i);
  ss::Features<D> one, three;
  REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, one, 1) == Status::ok);
  REQUIRE(ss::extract(cloud.view(), grid, keypoints, radius, three, 3) == Status::ok);
  CHECK(same_bits(one.values, three.values));
  CHECK(one.status == three.status);
  for (std::size_t row = 0; row < keypoints.size(); ++row) {
    const std::vector<float> values(one[row], one[row] + D::size);
    REQUIRE(same_bits(values, describe(cloud, keypoints[row])));
    REQUIRE(same_bits(values, describe_in<D>(one.frames[row], cloud, keypoints[row], radius)));
  }
}

}  // namespace test_shot_properties
