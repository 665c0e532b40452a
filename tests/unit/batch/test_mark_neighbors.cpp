// Normals only where they are needed: SHOT and CSHOT have the same rows, whoever estimates them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "depth_images.hpp"
#include "fixtures.hpp"

namespace test_mark_neighbors {
namespace {

using namespace unit;
using ss::Status;

using Normals = std::vector<ss::SurfaceNormal>;
using Marks = std::vector<std::uint8_t>;

constexpr float radius = 0.03f;
constexpr float support = 0.06f;

DepthImage scene() {
  DepthImage image = with_holes(noisy_ball(1, 0.001f), 2, 20);
  Random random(3);
  for (std::uint8_t& channel : image.cloud.rgb) channel = random.byte();
  return image;
}

bool same_bits(const ss::SurfaceNormal& a, const ss::SurfaceNormal& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

template <class D>
std::vector<float> rows(const ss::CloudView& view, const ss::GridSearch& search,
                        const std::vector<std::uint32_t>& keypoints, const Normals& normals) {
  ss::Features<D> features;
  REQUIRE(ss::extract(ss::with_normals(view, normals.data()), search, keypoints, support, features) == Status::ok);
  for (const Status status : features.status) REQUIRE(status == Status::ok);
  return features.values;
}

void check_rows(const DepthImage& image, const std::vector<std::uint32_t>& keypoints, const Marks& marks,
                const Normals& everywhere, const Normals& needed) {
  REQUIRE(needed.size() == everywhere.size());
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] != 0) REQUIRE(same_bits(needed[i], everywhere[i]));
    left_out += std::isnan(needed[i].x) && !std::isnan(everywhere[i].x) ? 1 : 0;
  }
  CHECK(left_out > marks.size() / 3);
  const ss::GridSearch search(image.view(), support);
  CHECK(rows<ss::Shot352>(image.view(), search, keypoints, needed) ==
        rows<ss::Shot352>(image.view(), search, keypoints, everywhere));
  CHECK(rows<ss::Cshot1344>(image.view(), search, keypoints, needed) ==
        rows<ss::Cshot1344>(image.view(), search, keypoints, everywhere));
}

}  // namespace

TEST_CASE("mark_neighbors: the points within the radius, and no others") {
  const DepthImage image = scene();
  const ss::GridSearch search(image.view(), support);
  const std::vector<ss::KeyPoint> keypoints{
      {{0.0f, 0.05f, 0.62f}, {}}, {{0.4f, 0.3f, 1.3f}, {}}, {{not_a_number, 0.0f, 0.0f}, {}}};
  Marks marks(3, 9);
  REQUIRE(ss::mark_neighbors(image.view(), search, keypoints, support, marks) == Status::ok);
  REQUIRE(marks.size() == image.cloud.size());
  std::size_t marked = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    bool near = false;
    for (std::size_t k = 0; k < 2; ++k) {
      near = near || ss::squared_distance(image.cloud.at(i), keypoints[k].position) < ss::Radius(support).squared;
    }
    REQUIRE(marks[i] == (near ? 1 : 0));
    marked += marks[i];
  }
  CHECK(marked > 100);
  const std::vector<int> indices{-1, 1 << 30};
  REQUIRE(ss::mark_neighbors(image.view(), search, indices, support, marks) == Status::ok);
  CHECK(std::count(marks.begin(), marks.end(), 0) == static_cast<std::ptrdiff_t>(image.cloud.size()));
}

TEST_CASE("normals where they are needed: the same rows of SHOT and CSHOT") {
  const DepthImage image = scene();
  const ss::CloudView view = image.view();
  std::vector<std::uint32_t> keypoints;
  for (const std::size_t row : {50u, 60u, 70u}) {
    for (std::size_t column = 70; column < 90; column += 3) {
      const std::size_t i = row * DepthImage::width + column;
      if (ss::is_finite(image.cloud.at(i))) keypoints.push_back(static_cast<std::uint32_t>(i));
    }
  }
  Marks marks;
  const ss::GridSearch search(view, support);
  REQUIRE(ss::mark_neighbors(view, search, keypoints, support, marks) == Status::ok);
  const ss::Viewpoint camera = ss::Viewpoint::towards({});
  Normals everywhere, needed;
  SUBCASE("the exact ones") {
    const ss::GridSearch near(view, radius);
    REQUIRE(ss::estimate_normals(view, near, radius, camera, everywhere) == Status::ok);
    for (const unsigned threads : {1u, 3u}) {
      REQUIRE(ss::estimate_normals(view, near, radius, camera, marks, needed, threads) == Status::ok);
      check_rows(image, keypoints, marks, everywhere, needed);
    }
  }
  SUBCASE("those of the image") {
    ss::ImageNormalEstimator estimator;
    REQUIRE(estimator.estimate(view, radius, camera, everywhere) == Status::ok);
    for (const unsigned threads : {1u, 3u}) {
      REQUIRE(estimator.estimate(view, radius, camera, marks, needed, threads) == Status::ok);
      check_rows(image, keypoints, marks, everywhere, needed);
    }
  }
}

TEST_CASE("normals where they are needed: what is wrong has a status") {
  const DepthImage image = scene();
  const DepthImage other = noisy_ball(8, 0.003f);
  const ss::CloudView view = image.view();
  const ss::GridSearch search(view, support);
  const std::vector<std::uint32_t> keypoints{60 * DepthImage::width + 80};
  Marks marks(3);
  CHECK(ss::mark_neighbors(view, search, keypoints, -1.0f, marks) == Status::bad_radius);
  CHECK(marks.empty());
  CHECK(ss::mark_neighbors(ss::view_xyz(nullptr, 9), search, keypoints, support, marks) == Status::bad_view);
  CHECK(ss::mark_neighbors(ss::view_xyz(image.cloud.xyz.data(), 9), search, keypoints, support, marks) ==
        Status::bad_view);
  CHECK(ss::mark_neighbors(other.view(), search, keypoints, support, marks) == Status::other_cloud);
  CHECK(marks.empty());

  Normals normals(3);
  const ss::Viewpoint camera = ss::Viewpoint::towards({});
  const Marks few(view.size - 1, 1);
  CHECK(ss::estimate_normals(view, search, radius, camera, few, normals) == Status::sizes_differ);
  CHECK(normals.empty());
  normals.resize(3);
  CHECK(ss::ImageNormalEstimator().estimate(view, radius, camera, few, normals) == Status::sizes_differ);
  CHECK(normals.empty());
  const Marks none(view.size, 0);
  REQUIRE(ss::estimate_normals(view, search, radius, camera, none, normals) == Status::ok);
  CHECK(std::all_of(normals.begin(), normals.end(), [](const auto& n) { return std::isnan(n.x); }));
  REQUIRE(ss::ImageNormalEstimator().estimate(view, radius, camera, none, normals) == Status::ok);
  CHECK(std::all_of(normals.begin(), normals.end(), [](const auto& n) { return std::isnan(n.x); }));
}

}  // namespace test_mark_neighbors
