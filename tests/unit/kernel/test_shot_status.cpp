// SHOT and CSHOT refuse what they cannot describe: a Status and zeros, never NaN.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fixtures.hpp"

namespace test_shot_status {
namespace {

using namespace unit;
using ss::Status;
using Shape = ss::Shot352;
using Color = ss::Cshot1344;

constexpr float radius = 0.05f;
constexpr ss::Frame upright{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TestCloud dense(std::uint32_t seed) { return with_random_normals(blob(seed, 1500), seed); }

Status checked(Status status, const std::vector<float>& out) {
  CHECK(all_zero(out) == (status != Status::ok));
  for (const float value : out) REQUIRE(ss::extend::math::is_finite(value));
  return status;
}

template <class D>
Status describe(const ss::CloudView& view, std::size_t key = 0, const ss::Support& support = radius) {
  static ss::Workspace<2000> workspace;
  std::vector<float> out = garbage<D>();
  const Status status = ss::describe_at<D>(view, ss::BruteSearch{view}, key, support, workspace, out.data());
  return checked(status, out);
}

template <class D>
Status describe_in(const ss::CloudView& view, const ss::Frame& frame, ss::Radius r = radius) {
  static ss::Workspace<2000> workspace;
  std::vector<float> out = garbage<D>();
  const Status status =
      ss::describe_at<D>(view, ss::BruteSearch{view}, ss::keypoint(view, 0), frame, r, workspace, out.data());
  return checked(status, out);
}

/// describe() itself, of all that lies within `gathered` of the first point.
template <class D, class Sources>
Status describe_kernel(const TestCloud& cloud, const Sources& sources, const ss::Frame& frame, ss::Radius r = radius,
                       float gathered = radius) {
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(cloud.at(0), gathered, n) == Status::ok);
  std::vector<float> out = garbage<D>();
  const Status status = ss::describe<D>(n, sources, frame, r, out.data());
  return checked(status, out);
}

/// `entries` points within half a meter of the origin, `copies` of them at the origin itself.
TestCloud few(int entries, int copies) {
  TestCloud cloud;
  for (int k = 0; k < entries; ++k) {
    const float x = k < copies ? 0.0f : 0.1f * static_cast<float>(k - copies + 1);
    cloud.add(x, 0.3f * x, 0.2f * x);
  }
  cloud.normals.assign(cloud.size(), {0.0f, 0.6f, 0.8f});
  return cloud;
}

ss::CloudView without_normals(const TestCloud& cloud) {
  return ss::view_xyz_rgb(cloud.xyz.data(), cloud.rgb.data(), cloud.size());
}

ss::CloudView without_colors(const TestCloud& cloud) {
  return ss::with_normals(ss::view_xyz(cloud.xyz.data(), cloud.size()), cloud.normals.data());
}

}  // namespace

TEST_CASE("shot status: the new status has a sentence that names what is missing") {
  CHECK(std::string(ss::message(Status::missing_normals)).find("normals") != std::string::npos);
}

TEST_CASE("shot status: normals are asked for by descriptors that need them, before colors or after, but always") {
  const TestCloud cloud = dense(1);
  static_assert(Shape::needs_normals && !Shape::needs_colors, "SHOT needs normals");
  static_assert(Color::needs_normals && Color::needs_colors, "CSHOT needs both");
  static_assert(!ss::Ssh32::needs_normals && !ss::Scsh336::needs_normals, "SSH and SCSH need none");
  CHECK(describe<Shape>(cloud.view()) == Status::ok);
  CHECK(describe<Color>(cloud.view()) == Status::ok);
  CHECK(describe<Shape>(without_normals(cloud)) == Status::missing_normals);
  CHECK(describe<Color>(without_normals(cloud)) == Status::missing_normals);
  CHECK(describe<Shape>(without_colors(cloud)) == Status::ok);
  CHECK(describe<Color>(without_colors(cloud)) == Status::missing_colors);
  CHECK(describe_in<Shape>(without_normals(cloud), upright) == Status::missing_normals);
  CHECK(describe_in<Color>(without_colors(cloud), upright) == Status::missing_colors);
  CHECK(describe<ss::Scsh336>(without_normals(cloud)) == Status::ok);
  const Status neither = describe<Color>(ss::view_xyz(cloud.xyz.data(), cloud.size()));
  CHECK((neither == Status::missing_colors || neither == Status::missing_normals));
}

TEST_CASE("shot status: sources without memory say what is missing") {
  const TestCloud cloud = dense(2);
  const ss::CloudNormals normals{cloud.view()};
  const ss::CloudNormals no_normals{without_normals(cloud)};
  CHECK(describe_kernel<Shape>(cloud, normals, upright) == Status::ok);
  CHECK(describe_kernel<Shape>(cloud, no_normals, upright) == Status::missing_normals);
  const ss::RgbColors<Color::LabRule> colors{cloud.view(), cloud.color_at(0)};
  const ss::RgbColors<Color::LabRule> no_colors{without_colors(cloud), {}};
  CHECK(describe_kernel<Color>(cloud, ss::sources(colors, normals), upright) == Status::ok);
  CHECK(describe_kernel<Color>(cloud, ss::sources(colors, no_normals), upright) == Status::missing_normals);
  CHECK(describe_kernel<Color>(cloud, ss::sources(normals, no_colors), upright) == Status::missing_colors);
  // Descriptors without normals do without sources, or with any that they do not read.
  CHECK(describe_kernel<ss::Ssh32>(cloud, ss::sources(), upright) == Status::ok);
  CHECK(describe_kernel<ss::Ssh32>(cloud, no_normals, upright) == Status::ok);
}

TEST_CASE("shot status: half a channel of normals is a bad view") {
  const TestCloud cloud = dense(3);
  for (int axis = 0; axis < 2; ++axis) {
    ss::CloudView view = cloud.view();
    (axis == 0 ? view.normals.y : view.normals.z) = nullptr;
    CHECK(describe<Shape>(view) == Status::bad_view);
    CHECK(describe_in<Shape>(view, upright) == Status::bad_view);
    CHECK(describe<ss::Ssh32>(view) == Status::bad_view);
  }
  const ss::CloudView null = ss::with_normals(without_normals(cloud), nullptr);
  CHECK(!ss::has_normals(null));
  CHECK(describe<Shape>(null) == Status::missing_normals);
}

TEST_CASE("shot status: fewer than five entries are too few, the key point and its copies counted") {
  for (int entries = 1; entries < 8; ++entries) {
    for (int copies = 1; copies <= entries; ++copies) {
      CAPTURE(entries);
      CAPTURE(copies);
      const bool enough = entries >= 5 && copies < entries;  // and somebody else
      const Status expected = enough ? Status::ok : Status::too_few_neighbors;
      const TestCloud cloud = few(entries, copies);
      CHECK(describe_in<Shape>(cloud.view(), upright, 1.0f) == expected);
      CHECK(describe_in<ss::PclCshot1344>(cloud.view(), upright, 1.0f) == expected);
    }
  }
}

TEST_CASE("shot status: only entries within the descriptor's radius count, whatever was gathered") {
  TestCloud cloud = few(4, 1);
  for (int k = 0; k < 50; ++k) {
    cloud.add(0.9f - 0.001f * static_cast<float>(k % 7), 0.01f * static_cast<float>(k), 0.02f);
    cloud.normals.push_back({0.0f, 0.0f, 1.0f});
  }
  const ss::CloudNormals normals{cloud.view()};
  const auto describe_within = [&](float r) { return describe_kernel<Shape>(cloud, normals, upright, r, 1.0f); };
  CHECK(describe_within(0.5f) == Status::too_few_neighbors);
  CHECK(describe_within(1.0f) == Status::ok);
  ss::Support support = 0.5f;
  support.frame_radius = 1.0f;
  CHECK(describe<Shape>(cloud.view(), 0, support) == Status::too_few_neighbors);
  cloud.add(0.0f, 0.0f, 0.0f);  // a copy of the key point is the fifth
  cloud.normals.push_back(no_normal);
  CHECK(describe<Shape>(cloud.view(), 0, support) == Status::ok);
}

TEST_CASE("shot status: no neighbor with a normal is too few") {
  TestCloud cloud = dense(4);
  cloud.normals.assign(cloud.size(), no_normal);
  CHECK(describe<Shape>(cloud.view()) == Status::too_few_neighbors);
  CHECK(describe<Color>(cloud.view()) == Status::too_few_neighbors);
  cloud.normals[0] = {0.0f, 0.0f, 1.0f};  // the key point's own
  CHECK(describe<Shape>(cloud.view()) == Status::too_few_neighbors);
}

TEST_CASE("shot status: normals that are no unit vectors do no harm") {
  TestCloud cloud = dense(7);
  Random random(8);
  const float extremes[] = {0.0f, -0.0f, 1e-45f, 1e-30f, 1.0f, 7.0f, -1e19f, 1e30f, 3.4e38f, -3.4e38f};
  const auto any = [&] { return extremes[random.below(10)]; };
  for (ss::SurfaceNormal& n : cloud.normals) n = {any(), any(), any()};
  const float half = std::sqrt(0.5f);
  for (const ss::Frame& frame : {upright, ss::Frame{{half, 0, half}, {0, 1, 0}, {-half, 0, half}}}) {
    CHECK(describe_in<Shape>(cloud.view(), frame) == Status::ok);  // and finite, and within the array
    CHECK(describe_in<ss::PclCshot1344>(cloud.view(), frame) == Status::ok);
  }
}

TEST_CASE("shot status: radii at the very ends of what is allowed describe or refuse, but stay finite") {
  const TestCloud cloud = dense(9);
  for (const float extreme : {1.2e-19f, 1e-10f, 1e-6f, 1e6f, 1.8e19f}) {
    for (const float frame_radius : {1.2e-19f, radius, 1.8e19f}) {
      CAPTURE(extreme);
      CAPTURE(frame_radius);
      ss::Support support = extreme;
      support.frame_radius = frame_radius;
      const Status status = describe<Color>(cloud.view(), 0, support);
      if (extreme < 1e-5f || frame_radius < 1e-5f) CHECK(status != Status::ok);  // nobody is as close
      if (extreme == 1e6f && frame_radius == radius) CHECK(status == Status::ok);
    }
  }
}

TEST_CASE("shot status: frames, radii and key points that cannot be used") {
  TestCloud cloud = dense(5);
  CHECK(describe_in<Shape>(cloud.view(), upright) == Status::ok);
  CHECK(describe_in<Shape>(cloud.view(), ss::Frame{}) == Status::bad_frame);
  CHECK(describe_in<Color>(cloud.view(), {{1, 0, 0}, {0.1f, 1, 0}, {0, 0, 1}}) == Status::bad_frame);
  CHECK(describe_in<Color>(cloud.view(), {{1, 0, not_a_number}, {0, 1, 0}, {0, 0, 1}}) == Status::bad_frame);
  for (const float bad : {0.0f, -1.0f, not_a_number, infinity}) {
    CHECK(describe<Shape>(cloud.view(), 0, bad) == Status::bad_radius);
    CHECK(describe_in<Shape>(cloud.view(), upright, bad) == Status::bad_radius);
  }
  CHECK(describe<Shape>(cloud.view(), cloud.size()) == Status::bad_keypoint);
  cloud.xyz[0] = not_a_number;
  CHECK(describe<Shape>(cloud.view()) == Status::invalid_keypoint);
}

TEST_CASE("shot status: extract() gives every row its status, and zeros where it is not ok") {
  TestCloud cloud = dense(6);
  cloud.add(5.0f, 5.0f, 5.0f);
  cloud.normals.push_back({0.0f, 0.0f, 1.0f});
  const ss::GridSearch search(cloud.view(), radius);
  const std::vector<std::uint32_t> keypoints{3, 1500, 9999};
  ss::Features<Color> features;
  REQUIRE(ss::extract(cloud.view(), search, keypoints, radius, features) == Status::ok);
  CHECK(features.status == std::vector<Status>{Status::ok, Status::too_few_neighbors, Status::bad_keypoint});
  for (std::size_t row = 0; row < 3; ++row) {
    CHECK(all_zero({features[row], features[row] + Color::size}) == (row > 0));
  }
  CHECK(ss::extract(without_normals(cloud), search, keypoints, radius, features) == Status::missing_normals);
  CHECK(features.status == std::vector<Status>(3, Status::missing_normals));
  CHECK(all_zero(features.values));
}

}  // namespace test_shot_status
