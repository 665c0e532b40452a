// Bad input gets a Status and zeros, never NaN: every value of Status is reached, and every refusal leaves no trace.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "recognition_statuses.hpp"
#include "view_statuses.hpp"

namespace test_status {
namespace {
using namespace unit;
using ss::Status;
using D = ss::Scsh336;
using ShapeOnly = ss::Ssh32;

constexpr float radius = 0.05f;
// The last three are numbers above zero whose squares leave float's range.
constexpr float bad_radii[] = {0.0f, -0.0f, -1.0f, not_a_number, infinity, -infinity, 1e-40f, 1e-25f, 1e30f};

/// describe_at() into garbage; whatever is not ok must leave zeros.
template <class Descriptor, class Key>
Status describe_into_garbage(const ss::CloudView& view, const Key& key, const ss::Support& support = radius) {
  static ss::Workspace<2000> workspace;
  std::vector<float> out = garbage<Descriptor>();
  const Status status = ss::describe_at<Descriptor>(view, ss::BruteSearch{view}, key, support, workspace, out.data());
  if (status == Status::ok) {
    CHECK(!all_zero(out));
    for (const float value : out) REQUIRE(ss::extend::math::is_finite(value));
  } else {
    CHECK(all_zero(out));
  }
  return status;
}

Status describe_in_frame(const TestCloud& cloud, const ss::Frame& frame, ss::Radius r = radius) {
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(cloud.at(0), radius, n) == Status::ok);
  std::vector<float> out = garbage<ShapeOnly>();
  const Status status = ss::describe<ShapeOnly>(n, ss::sources(), frame, r, out.data());
  if (status != Status::ok) CHECK(all_zero(out));
  return status;
}

constexpr ss::Frame upright{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

[[gnu::noinline]] ss::CloudView of_size(std::size_t size) {  // never read, as compilers that look inside suspect
  static const float somewhere[3] = {};
  return ss::view_xyz(somewhere, size);
}

}  // namespace

TEST_CASE("status: message() has a sentence of its own for every value") {
  std::set<std::string> sentences;
  for (int value = 0; value < ss::status_count; ++value) {
    const std::string sentence = ss::message(static_cast<Status>(value));
    CHECK(!sentence.empty());
    CHECK(sentence != ss::message(static_cast<Status>(ss::status_count)));  // not one of them
    sentences.insert(sentence);
  }
  CHECK(sentences.size() == static_cast<std::size_t>(ss::status_count));
}

TEST_CASE("status: every value is reached by some call") {
  const TestCloud cloud = blob(1, 500);
  TestCloud line;
  for (int k = 0; k < 20; ++k) line.add(0.001f * static_cast<float>(k), 0.0f, 0.0f);
  TestCloud alone;
  alone.add(0.0f, 0.0f, 0.0f);
  ss::Workspace<5> tiny;
  std::vector<float> out = garbage<D>();
  std::vector<std::uint32_t> keypoints;
  std::uint32_t no_cells[1];
  std::uint32_t order[500];
  ss::GridIndex<> grid{};
  ss::OrganizedSearch organized{};
  const ss::KeyPoint nowhere{{0.0f, not_a_number, 0.0f}, {}};
  const ss::Point no_place{0.0f, not_a_number, 0.0f};
  ss::Support blind = radius;
  blind.viewpoint = ss::Viewpoint::towards(no_place);

  std::set<Status> reached{
      describe_into_garbage<D>(cloud.view(), std::size_t{0}),
      describe_into_garbage<D>(ss::CloudView{}, std::size_t{0}),
      describe_into_garbage<D>(of_size(std::size_t{1} << 32), std::size_t{0}),
      describe_into_garbage<D>(cloud.view(), std::size_t{0}, -1.0f),
      describe_into_garbage<D>(cloud.view(), cloud.size()),
      describe_into_garbage<D>(cloud.view(), nowhere),
      describe_into_garbage<D>(ss::view_xyz(cloud.xyz.data(), cloud.size()), std::size_t{0}),
      describe_into_garbage<ss::Shot352>(cloud.view(), std::size_t{0}),
      describe_into_garbage<D>(alone.view(), std::size_t{0}),
      ss::describe_at<D>(cloud.view(), ss::BruteSearch{cloud.view()}, 0, radius, tiny, out.data()),
      describe_into_garbage<D>(line.view(), std::size_t{0}),
      describe_in_frame(cloud, ss::Frame{}),
      ss::sample_uniform(cloud.view(), 0.0f, keypoints),
      grid.build(cloud.view(), radius, {order, no_cells, nullptr, 500, 0}),
      organized.build(cloud.view()),
      describe_into_garbage<D>(cloud.view(), std::size_t{0}, blind),
      describe_into_garbage<ss::IntensityShape336>(cloud.view(), std::size_t{0}),
  };
  reached.merge(reached_by_recognition(upright));
  reached.merge(reached_by_views());
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud.view(), ss::BruteSearch{cloud.view()}, std::vector{1, 2}, radius, features) == Status::ok);
  REQUIRE(ss::keep_best_frames(features, 0.5f) == Status::ok);
  reached.insert(features.status.begin(), features.status.end());
  const TestCloud other = blob(2, 500);
  const std::vector<ss::KeyPoint> far{{{1e7f, 0.0f, 0.0f}, {}}};
  reached.insert(ss::extract(cloud.view(), ss::BruteSearch{other.view()}, std::vector{1, 2}, radius, features));
  reached.insert(ss::extract(cloud.view(), ss::BruteSearch{cloud.view()}, far, radius, features));
  for (int value = 0; value < ss::status_count; ++value) {
    const auto status = static_cast<Status>(value);
    CAPTURE(status);
    CHECK(reached.count(status) == 1);
  }
}

TEST_CASE("status: an empty cloud, a cloud of nothing finite, and no memory at all") {
  TestCloud nothing;
  for (int k = 0; k < 10; ++k) nothing.add(not_a_number, infinity, 0.0f);
  CHECK(describe_into_garbage<D>(nothing.view(), std::size_t{0}) == Status::invalid_keypoint);
  CHECK(describe_into_garbage<D>(nothing.view(), ss::KeyPoint({0.0f, 0.0f, 0.0f}, {1, 2, 3})) ==
        Status::too_few_neighbors);
  CHECK(ss::GridSearch(nothing.view(), radius).status() == Status::empty_cloud);
  std::vector<std::uint32_t> keypoints{7};
  CHECK(ss::sample_uniform(nothing.view(), radius, keypoints) == Status::empty_cloud);
  CHECK(keypoints.empty());
  CHECK(ss::GridSearch(ss::CloudView{}, radius).status() == Status::empty_cloud);
  CHECK(ss::GridSearch().status() == Status::empty_cloud);

  ss::CloudView no_points{};
  no_points.size = 5;
  CHECK(ss::validate(no_points) == Status::bad_view);
  CHECK(describe_into_garbage<D>(no_points, std::size_t{0}) == Status::bad_view);
  CHECK(ss::GridSearch(no_points, radius).status() == Status::bad_view);
  CHECK(ss::sample_uniform(no_points, radius, keypoints) == Status::bad_view);
  ss::OrganizedSearch organized{};
  CHECK(organized.build(ss::organized(no_points, 1, 5)) == Status::bad_view);
}

TEST_CASE("status: half a channel is a bad view") {
  const TestCloud cloud = blob(2, 20);
  ss::CloudView view = cloud.view();
  view.points.y = nullptr;
  CHECK(ss::validate(view) == Status::bad_view);
  view = cloud.view();
  view.colors.b = nullptr;
  CHECK(describe_into_garbage<D>(view, std::size_t{0}) == Status::bad_view);
  view = cloud.view();
  view.normals = {view.points.x, view.points.y, nullptr, 12};
  CHECK(ss::validate(view) == Status::bad_view);
}

TEST_CASE("status: null pointers given to the views' makers are refused by whoever reads the view") {
  const TestCloud cloud = blob(3, 20);
  CHECK(ss::validate(ss::view_xyz(nullptr, 5)) == Status::bad_view);
  CHECK(describe_into_garbage<D>(ss::view_xyz_rgb(nullptr, cloud.rgb.data(), 5), std::size_t{0}) == Status::bad_view);
  const ss::CloudView colorless = ss::view_xyz_rgb(cloud.xyz.data(), nullptr, cloud.size());
  CHECK(describe_into_garbage<D>(colorless, std::size_t{0}) == Status::missing_colors);
  CHECK(describe_into_garbage<ShapeOnly>(ss::view_xyz(nullptr, 0), std::size_t{0}) == Status::empty_cloud);
}

TEST_CASE("status: a size that no cloud has is refused before any memory is asked for") {
  for (const std::size_t size : {~std::size_t{0} / 64, ~std::size_t{0}}) {  // more than any machine would give
    ss::GridSearch grid;
    CHECK(grid.build(of_size(size), radius) == Status::bad_view);
    std::vector<std::uint32_t> keypoints;
    CHECK(ss::sample_uniform(of_size(size), radius, keypoints) == Status::bad_view);
    CHECK(ss::NanoflannSearch(of_size(size)).status() == Status::bad_view);
  }
}

TEST_CASE("status: radii, cell and voxel sizes that cannot be used") {
  const TestCloud cloud = blob(4, 200);
  for (const float bad : bad_radii) {
    CAPTURE(bad);
    ss::Support frame_only = radius;
    frame_only.frame_radius = bad;
    CHECK(describe_into_garbage<D>(cloud.view(), std::size_t{0}, bad) == Status::bad_radius);
    CHECK(describe_into_garbage<D>(cloud.view(), std::size_t{0}, frame_only) == Status::bad_radius);
    CHECK(describe_in_frame(cloud, upright, bad) == Status::bad_radius);
    ss::Neighborhood none{};
    ss::Frame frame = upright;
    CHECK(ss::estimate_frame(none, bad, frame) == Status::bad_radius);
    CHECK(frame.x[0] == 0.0f);
    CHECK(ss::GridSearch(cloud.view(), bad).status() == Status::bad_radius);
    const bool no_number_above_zero = !(bad > 0.0f) || bad == infinity;
    std::vector<std::uint32_t> keypoints;
    if (no_number_above_zero) CHECK(ss::sample_uniform(cloud.view(), bad, keypoints) == Status::bad_leaf);
  }
}

TEST_CASE("status: radii at the very ends of what is allowed describe or refuse, but stay finite") {
  const TestCloud cloud = blob(5, 300);
  for (const float extreme : {1.2e-19f, 1e-10f, 1e-6f, 1e6f, 1.8e19f}) {
    for (const float frame_radius : {1.2e-19f, radius, 1.8e19f}) {
      CAPTURE(extreme);
      CAPTURE(frame_radius);
      ss::Support support = extreme;
      support.frame_radius = frame_radius;
      const Status status = describe_into_garbage<D>(cloud.view(), std::size_t{0}, support);
      // No two points of the blob are as close; and in a huge frame radius all of them are one point.
      const bool nobody = extreme < 1e-5f || frame_radius < 1e-5f;
      if (nobody) CHECK(status != Status::ok);
      if (extreme == 1e6f && frame_radius == radius) CHECK(status == Status::ok);
    }
  }
}

TEST_CASE("status: far-off points within a huge frame radius add nothing to a tiny support") {
  // Nobody but the key point lies within the support: there is nothing to describe, whatever the others' distance.
  TestCloud cloud;
  Random random(6);
  for (int k = 0; k < 50; ++k) {
    const float y = random.between(-4e18f, 4e18f);
    cloud.add(random.between(-9e18f, 9e18f), y, random.between(-2e18f, 2e18f));
  }
  cloud.add(0.0f, 0.0f, 0.0f);
  ss::Support support = 1.2e-19f;
  support.frame_radius = 1.8e19f;
  CHECK(describe_into_garbage<ShapeOnly>(cloud.view(), std::size_t{50}, support) == Status::too_few_neighbors);
  CHECK(describe_into_garbage<ss::Ssh<ss::SphericalGrid<64, 2, 2>, ss::MultilinearVoting>>(
            cloud.view(), std::size_t{50}, support) == Status::too_few_neighbors);
}

TEST_CASE("status: key points that are not finite, or not in the cloud") {
  TestCloud cloud = blob(7, 100);
  for (const float bad : {not_a_number, infinity, -infinity}) {
    for (std::size_t k = 0; k < 3; ++k) {
      TestCloud broken = cloud;
      broken.xyz[k] = bad;
      CHECK(describe_into_garbage<D>(broken.view(), std::size_t{0}) == Status::invalid_keypoint);
      CHECK(describe_into_garbage<D>(broken.view(), std::size_t{1}) != Status::invalid_keypoint);
    }
  }
  CHECK(describe_into_garbage<D>(cloud.view(), cloud.size()) == Status::bad_keypoint);
  CHECK(describe_into_garbage<D>(cloud.view(), ~std::size_t{0}) == Status::bad_keypoint);
}

TEST_CASE("status: colors are asked for only by descriptors that need them") {
  const TestCloud cloud = blob(8, 1500);
  const ss::CloudView colorless = ss::view_xyz(cloud.xyz.data(), cloud.size());
  CHECK(describe_into_garbage<D>(colorless, std::size_t{0}) == Status::missing_colors);
  CHECK(describe_into_garbage<ShapeOnly>(colorless, std::size_t{0}) == Status::ok);
  std::vector<ss::Lab> lab(cloud.size());
  CHECK(ss::convert_colors<ss::PublishedLab>(colorless, lab.data()) == Status::missing_colors);
  CHECK(ss::convert_colors<ss::PublishedLab>(cloud.view(), lab.data()) == Status::ok);
}

TEST_CASE("status: a workspace one neighbor too small is reported, one that fits is not") {
  TestCloud cloud = curved_surface(9, 30);  // within one support
  const float wide = 1.0f;
  std::vector<float> out = garbage<D>();
  ss::Workspace<30> fits;
  ss::Workspace<29> short_of_one;
  const ss::BruteSearch search{cloud.view()};
  CHECK(ss::describe_at<D>(cloud.view(), search, 0, wide, fits, out.data()) == Status::ok);
  CHECK(ss::describe_at<D>(cloud.view(), search, 0, wide, short_of_one, out.data()) == Status::too_many_neighbors);
  CHECK(all_zero(out));
  ss::Neighborhood n = ss::neighborhood_in(short_of_one);
  CHECK(search.gather(cloud.at(0), wide, n) == Status::too_many_neighbors);
  CHECK(n.found == 30);
}

TEST_CASE("status: given frames that are not frames") {
  const TestCloud cloud = blob(10, 1500);
  CHECK(describe_in_frame(cloud, upright) == Status::ok);
  CHECK(describe_in_frame(cloud, ss::Frame{}) == Status::bad_frame);
  CHECK(describe_in_frame(cloud, {{1, 0, 0}, {0.1f, 1, 0}, {0, 0, 1}}) == Status::bad_frame);
  CHECK(describe_in_frame(cloud, {{1, 0, not_a_number}, {0, 1, 0}, {0, 0, 1}}) == Status::bad_frame);
  CHECK(describe_in_frame(cloud, {{1, 0, 0}, {0, infinity, 0}, {0, 0, 1}}) == Status::bad_frame);
  CHECK(describe_in_frame(cloud, {{1, 0, 0}, {0, 1, 0}, {0, 0, 2e38f}}) == Status::bad_frame);
}

TEST_CASE("status: a search that could not be built says so through whoever asks it") {
  const TestCloud cloud = blob(11, 300);
  ss::Workspace<300> workspace;
  std::vector<float> out = garbage<D>();
  const auto describe = [&](const auto& search) {
    return ss::describe_at<D>(cloud.view(), search, 0, radius, workspace, out.data());
  };
  ss::OrganizedSearch no_image{};
  CHECK(no_image.status() == Status::empty_cloud);
  REQUIRE(no_image.build(cloud.view()) == Status::not_organized);
  CHECK(describe(no_image) == Status::not_organized);
  CHECK(all_zero(out));
  CHECK(describe(ss::GridSearch(cloud.view(), 0.0f)) == Status::bad_radius);
  CHECK(describe(ss::GridSearch()) == Status::empty_cloud);
  static ss::StaticGrid<200, 64> too_small;
  CHECK(too_small.status() == Status::empty_cloud);
  REQUIRE(too_small.build(cloud.view(), radius) == Status::out_of_memory);
  CHECK(describe(too_small) == Status::out_of_memory);
}
}  // namespace test_status
