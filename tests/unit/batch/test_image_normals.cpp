// The normals of depth images by sums over windows: near those of the planes that are there, on this side of every
// edge, as their definition says, the same bits for any number of threads.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "depth_images.hpp"
#include "fixtures.hpp"
#include "pinhole.hpp"
#include "thread_pool.hpp"

namespace test_image_normals {
namespace {

using namespace unit;
using ss::Status;

using Normals = std::vector<ss::SurfaceNormal>;

Normals estimated(const ss::CloudView& view, float radius,
                  const ss::Viewpoint& viewpoint = ss::Viewpoint::towards({})) {
  Normals normals;
  REQUIRE(ss::estimate_image_normals(view, radius, viewpoint, normals) == Status::ok);
  REQUIRE(normals.size() == view.size);
  return normals;
}

bool exists(const ss::SurfaceNormal& n) {
  REQUIRE(std::isnan(n.x) == std::isnan(n.y));
  REQUIRE(std::isnan(n.x) == std::isnan(n.z));
  if (!std::isnan(n.x)) REQUIRE(std::abs(n.x * n.x + n.y * n.y + n.z * n.z - 1.0f) < 1e-5f);
  return !std::isnan(n.x);
}

}  // namespace

TEST_CASE("image normals: of planes, at any depth and slope, towards the camera or away from it") {
  for (const ss::SurfaceNormal& n : {unit_normal(0.0f, 0.0f, -1.0f), unit_normal(0.7f, 0.0f, -1.0f),
                                     unit_normal(-0.5f, 1.2f, -1.0f), unit_normal(0.1f, -2.0f, -1.0f)}) {
    for (const float distance : {0.5f, 1.0f, 2.0f}) {
      const DepthImage image = depth_image([&](const ss::Point& ray) { return depth_of_plane(n, -distance, ray); });
      const Normals to = estimated(image.view(), 0.05f * distance);
      const Normals from = estimated(image.view(), 0.05f * distance, ss::Viewpoint::away_from({}));
      std::size_t rough = 0;  // at the image's rim, where windows have few pixels
      for (std::size_t i = 0; i < to.size(); ++i) {
        CAPTURE(i);
        if (!ss::is_finite(image.cloud.at(i))) continue;
        REQUIRE(exists(to[i]));
        rough += degrees_between(to[i], n) > 0.5 ? 1 : 0;
        REQUIRE(degrees_between(to[i], n) < 6.0);
        REQUIRE(to[i].x * n.x + to[i].y * n.y + to[i].z * n.z > 0.0f);
        REQUIRE(from[i].x == -to[i].x);
        REQUIRE(from[i].y == -to[i].y);
        REQUIRE(from[i].z == -to[i].z);
      }
      CHECK(rough < to.size() / 10);
    }
  }
}

TEST_CASE("image normals: near the exact ones on a curved surface with noise and holes") {
  const DepthImage image = with_holes(noisy_ball(1, 0.0005f), 2, 10);
  const float radius = 0.03f;
  const Normals normals = estimated(image.view(), radius);
  Normals exact;
  const ss::GridSearch search(image.view(), radius);
  REQUIRE(ss::estimate_normals(image.view(), search, radius, ss::Viewpoint::towards({}), exact) == Status::ok);
  std::vector<double> errors;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (exists(normals[i]) && exists(exact[i])) errors.push_back(degrees_between(normals[i], exact[i]));
    if (!ss::is_finite(image.cloud.at(i))) REQUIRE_FALSE(exists(normals[i]));
  }
  REQUIRE(errors.size() > 10000);
  std::sort(errors.begin(), errors.end());
  CHECK(errors[errors.size() / 2] < 1.0);
  CHECK(errors[errors.size() * 9 / 10] < 3.0);
}

TEST_CASE("image normals: nothing bleeds over an edge") {
  const float radius = 0.03f;
  for (const bool with_shadow : {false, true}) {
    const Silhouette scene = silhouette(with_shadow);
    const Normals normals = estimated(scene.image.view(), radius);
    std::size_t valid = 0, missing = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (!ss::is_finite(scene.image.cloud.at(i))) continue;
      CAPTURE(i);
      ++valid;
      if (!exists(normals[i])) {
        ++missing;
        continue;
      }
      REQUIRE(degrees_between(normals[i], scene.truth[i]) < 5.0);
    }
    CHECK(100 * missing < valid);
  }
}

TEST_CASE("image normals: a row without points is an edge, and each half is as if it were alone") {
  DepthImage image = depth_image([](const ss::Point&) { return 1.0f; });
  for (std::size_t i = 0; i < image.cloud.size(); ++i) {
    const std::size_t row = i / DepthImage::width;
    if (row == 40) image.cloud.xyz[3 * i + 2] = not_a_number;
    if (row > 40) {
      for (std::size_t k = 0; k < 3; ++k) image.cloud.xyz[3 * i + k] *= 1.5f;
    }
  }
  const Normals normals = estimated(image.view(), 0.05f);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (i / DepthImage::width == 40) continue;
    REQUIRE(exists(normals[i]));
    REQUIRE(degrees_between(normals[i], {0.0f, 0.0f, -1.0f}) < 0.01);
  }
}

TEST_CASE("image normals: what the sums over windows say, summed one by one") {
  for (const std::uint32_t seed : {1u, 2u}) {
    const DepthImage image = with_holes(noisy_ball(seed, 0.002f), seed, 5);
    const float radius = seed == 1 ? 0.02f : 0.05f;
    const Normals normals = estimated(image.view(), radius);
    const WindowOracle oracle(image, radius);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < normals.size(); i += 7) {
      CAPTURE(i);
      ss::SurfaceNormal expected{};
      double ratio = 1.0;  // of the smallest to the next eigenvalue
      if (!oracle.normal(i, expected, ratio) || ratio > 0.2) continue;
      REQUIRE(exists(normals[i]));
      REQUIRE(degrees_between(normals[i], expected) < 0.02 + 60.0 * std::pow(ratio, 4.0));
      ++compared;
    }
    CHECK(compared > 1000);
  }
}

TEST_CASE("image normals: any number of threads and any executor gives the same bits") {
  const DepthImage image = with_holes(noisy_ball(3, 0.002f), 3, 5);
  ss::ImageNormalEstimator estimator;
  for (const float radius : {0.004f, 0.03f, 0.3f}) {
    const Normals normals = estimated(image.view(), radius);
    Normals others(3);
    for (const int threads : {-1, 0, 2, 3, 64}) {
      REQUIRE(estimator.estimate(image.view(), radius, ss::Viewpoint::towards({}), others, threads) == Status::ok);
      CHECK(same_bits(others, normals));
    }
    ThreadPool pool(3);
    REQUIRE(estimator.estimate(image.view(), radius, ss::Viewpoint::towards({}), others, pool) == Status::ok);
    CHECK(same_bits(others, normals));
  }
}

TEST_CASE("image normals: images of any width, padded points, a camera that looks along -z") {
  for (const std::size_t width : {2u, 3u, 7u, 9u, 33u}) {
    const TestCloud cloud = pinhole_image(4, {});
    TestCloud part;
    std::vector<float> padded;
    for (std::size_t v = 0; v < 20; ++v) {
      for (std::size_t u = 0; u < width; ++u) {
        const ss::Point p = cloud.at(v * image_width + u + 10);
        part.add(p);
        padded.insert(padded.end(), {p.x, p.y, p.z, 7.0f});
      }
    }
    const Normals normals = estimated(ss::organized(part.view(), width, 20), 0.1f);
    CHECK(same_bits(estimated(ss::organized(ss::view_xyz(padded.data(), part.size(), 16), width, 20), 0.1f), normals));
    std::size_t found = 0;
    for (const ss::SurfaceNormal& n : normals) found += exists(n) ? 1 : 0;
    if (width > 2) CHECK(found > normals.size() / 2);
    for (float& v : part.xyz) v = -v;
    const Normals mirrored = estimated(ss::organized(part.view(), width, 20), 0.1f);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      REQUIRE(exists(mirrored[i]) == exists(normals[i]));
      if (exists(normals[i])) REQUIRE(degrees_between(mirrored[i], normals[i]) < 1e-3);
    }
  }
}

TEST_CASE("image normals: (0, 0, 0) is a hole, as NaN is") {
  DepthImage holes = with_holes(noisy_ball(5, 0.001f), 5, 4);
  DepthImage zeros = holes;
  for (std::size_t i = 0; i < holes.cloud.size(); ++i) {
    if (!ss::is_finite(holes.cloud.at(i))) std::fill_n(&zeros.cloud.xyz[3 * i], 3, 0.0f);
  }
  CHECK(same_bits(estimated(holes.view(), 0.03f), estimated(zeros.view(), 0.03f)));
}

TEST_CASE("image normals: what cannot be estimated has a status and no normals") {
  const DepthImage image = noisy_ball(6, 0.001f);
  const auto status = [](const ss::CloudView& view, float radius, ss::Point viewpoint = {}) {
    Normals normals(3);
    const Status result = ss::estimate_image_normals(view, radius, ss::Viewpoint::towards(viewpoint), normals);
    CHECK(normals.empty());
    return result;
  };
  const ss::CloudView view = image.view();
  for (const float radius : {0.0f, -1.0f, not_a_number, infinity, 1e30f}) {
    CHECK(status(view, radius) == Status::bad_radius);
  }
  CHECK(status(view, 0.05f, {0.0f, infinity, 0.0f}) == Status::bad_viewpoint);
  CHECK(status(ss::organized(ss::view_xyz(nullptr, view.size), view.width, view.height), 0.05f) == Status::bad_view);
  CHECK(status(ss::view_xyz(image.cloud.xyz.data(), 0), 0.05f) == Status::empty_cloud);
  CHECK(status(image.cloud.view(), 0.05f) == Status::not_organized);  // one row
  for (const std::size_t width : {std::size_t{0}, std::size_t{1}, view.width - 1, view.size, ~std::size_t{0}}) {
    CHECK(status(ss::organized(view, width, view.height), 0.05f) == Status::not_organized);
    CHECK(status(ss::organized(view, view.width, width), 0.05f) == Status::not_organized);
  }
  TestCloud turned = image.cloud;  // into the coordinates of a robot: z is up
  for (std::size_t i = 0; i < turned.size(); ++i) std::swap(turned.xyz[3 * i + 1], turned.xyz[3 * i + 2]);
  CHECK(status(ss::organized(turned.view(), view.width, view.height), 0.05f) == Status::not_organized);
  TestCloud nothing = image.cloud;
  std::fill(nothing.xyz.begin(), nothing.xyz.end(), not_a_number);
  CHECK(status(ss::organized(nothing.view(), view.width, view.height), 0.05f) == Status::empty_cloud);
  std::fill(nothing.xyz.begin(), nothing.xyz.end(), 0.0f);
  CHECK(status(ss::organized(nothing.view(), view.width, view.height), 0.05f) == Status::empty_cloud);
  TestCloud far = image.cloud;
  for (float& v : far.xyz) v *= 1e6f;
  CHECK(status(ss::organized(far.view(), view.width, view.height), 0.05f) == Status::coarse_coordinates);
}

TEST_CASE("image normals: few points, and those on a line, have none; the ends of float's range do no harm") {
  const DepthImage image = depth_image([](const ss::Point& ray) { return 0.8f + 0.3f * ray.x; });
  const auto only = [&](const auto& keeps) {
    DepthImage few = image;
    for (std::size_t i = 0; i < few.cloud.size(); ++i) {
      if (!keeps(i % DepthImage::width, i / DepthImage::width)) few.cloud.xyz[3 * i] = infinity;
    }
    const Normals normals = estimated(few.view(), 0.03f);
    return std::count_if(normals.begin(), normals.end(), exists);
  };
  CHECK(only([](std::size_t u, std::size_t v) { return u == 80 && v == 60; }) == 0);
  CHECK(only([](std::size_t, std::size_t v) { return v == 60; }) == 0);
  CHECK(only([](std::size_t u, std::size_t) { return u == 80; }) == 0);
  CHECK(only([](std::size_t u, std::size_t v) { return (u == 80 || u == 81) && (v == 60 || v == 61); }) == 4);
  for (const float far : {3e38f, 1e30f, 1e-38f, 1e-30f}) {
    DepthImage wild = image;
    for (std::size_t i = 0; i < wild.cloud.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) wild.cloud.xyz[3 * i + k] *= far;
    }
    Normals normals;
    const Status status = ss::estimate_image_normals(wild.view(), 0.03f, {}, normals);
    if (status == Status::ok) std::for_each(normals.begin(), normals.end(), [](const auto& n) { exists(n); });
  }
}

}  // namespace test_image_normals
