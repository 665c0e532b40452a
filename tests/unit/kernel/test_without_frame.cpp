// Descriptors that are the same in every frame: none is estimated for them, and none can be missing.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "fixtures.hpp"

namespace test_without_frame {
namespace {

using namespace unit;
using ss::Status;

using D = ss::ColorRings27;
static_assert(!D::needs_frame);
static_assert(ss::ShapeColor95::needs_frame && ss::ShapeColor32::needs_frame && ss::RoomColor95::needs_frame);
static_assert(ss::HeightShape96::needs_frame && ss::Ssh32::needs_frame && ss::Shot352::needs_frame);
// Cells of the other conventions depend on it in any grid, and so do signals that look at where neighbors are.
static_assert(ss::Ssh<ss::SphericalGrid<3, 1, 1>>::needs_frame);
static_assert(ss::Shot<ss::SphericalGrid<2, 1, 1>, 10>::needs_frame);
template <class Signal>
using Rings = ss::Part<ss::SphericalGrid<3, 1, 1>, Signal, ss::LinearRadius, ss::HeightCells>;
static_assert(ss::Descriptor<ss::HardVoting, Rings<ss::NormalCosine<4>>>::needs_frame);
static_assert(!ss::Descriptor<ss::HardVoting, Rings<ss::ColorDistance<4>>>::needs_frame);
using Means = ss::ColorMeansPart<ss::SphericalGrid<3, 1, 1>, 100>;
using WithMeans = ss::Descriptor<ss::MultilinearVoting, Means, Rings<ss::Occupancy>>;
static_assert(!WithMeans::needs_frame);
static_assert(ss::Descriptor<ss::MultilinearVoting, ss::ColorMeansPart<ss::SphericalGrid<3, 1, 2>, 100>>::needs_frame);

constexpr float radius = 0.05f;
ss::Workspace<2000> workspace;

template <class Descriptor>
Status describe(const TestCloud& cloud, std::size_t key, std::vector<float>& out, const ss::Support& support = radius) {
  out = garbage<Descriptor>();
  return ss::describe_at<Descriptor>(cloud.view(), ss::BruteSearch{cloud.view()}, key, support, workspace, out.data());
}

/// Neighborhoods that have no frame, around their first points.
std::vector<TestCloud> without_frames() {
  Random random(1);
  const auto any_color = [&] { return ss::Rgb{random.byte(), random.byte(), random.byte()}; };
  TestCloud line, cross, few;
  for (int i = 0; i < 9; ++i) line.add(0.004f * static_cast<float>(i), 0.0f, 1.0f, any_color());
  cross.add(0.0f, 0.0f, 1.0f, any_color());
  for (const float side : {0.03125f, -0.03125f}) {
    cross.add(side, 0.0f, 1.0f, any_color());
    cross.add(0.0f, side, 1.0f, any_color());
    cross.add(0.0f, 0.0f, 1.0f + side, any_color());
  }
  for (int i = 0; i < 3; ++i) few.add(0.01f * static_cast<float>(i), 0.0f, 1.0f, any_color());
  return {line, cross, few};
}

}  // namespace

TEST_CASE("without frame: where there is none, rows are ok all the same") {
  const Status others[] = {Status::ambiguous_frame, Status::ambiguous_frame, Status::too_few_neighbors};
  const std::vector<TestCloud> clouds = without_frames();
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    std::vector<float> values, framed;
    CHECK(describe<ss::ShapeColor95>(clouds[i], 0, values) == others[i]);
    CHECK(describe<WithMeans>(clouds[i], 0, values) == Status::ok);
    REQUIRE(describe<D>(clouds[i], 0, values) == Status::ok);
    CHECK(values != std::vector<float>(values.size(), 0.0f));
    // What extract() gives is the same.
    ss::Features<D> features;
    REQUIRE(ss::extract(clouds[i].view(), ss::BruteSearch{clouds[i].view()}, std::vector<int>{0}, radius, features) ==
            Status::ok);
    CHECK(features.status[0] == Status::ok);
    CHECK(features.values == values);
  }
  TestCloud alone;
  alone.add(0.0f, 0.0f, 1.0f);
  std::vector<float> values;
  CHECK(describe<D>(alone, 0, values) == Status::too_few_neighbors);
  CHECK(values == std::vector<float>(values.size(), 0.0f));
}

TEST_CASE("without frame: a given one is not looked at, whatever it is") {
  const TestCloud cloud = curved_surface(2, 1500);
  const ss::BruteSearch search{cloud.view()};
  const ss::Frame any{{not_a_number, 0.0f, 3.0f}, {0.0f, infinity, 0.0f}, {}};
  for (const std::size_t key : {std::size_t{5}, std::size_t{700}}) {
    std::vector<float> values;
    REQUIRE(describe<D>(cloud, key, values) == Status::ok);
    for (const ss::Frame& frame : {ss::Frame{}, any, ss::Frame{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}) {
      std::vector<float> out = garbage<D>();
      CHECK(ss::describe_at<D>(cloud.view(), search, key, frame, radius, workspace, out.data()) == Status::ok);
      CHECK(out == values);
      out = garbage<ss::ShapeColor32>();
      const Status other =
          ss::describe_at<ss::ShapeColor32>(cloud.view(), search, key, frame, radius, workspace, out.data());
      CHECK(other == (frame.z[2] == 1.0f ? Status::ok : Status::bad_frame));
    }
  }
}

TEST_CASE("without frame: features have none, but for those that the caller gives") {
  const TestCloud cloud = curved_surface(3, 1500);
  const ss::BruteSearch search{cloud.view()};
  const std::vector<std::size_t> keypoints{3, 300, 900};
  ss::Support support = radius;
  support.frame_radius = 2.0f * radius;  // nobody gathers as far
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud.view(), search, keypoints, support, features) == Status::ok);
  for (std::size_t row = 0; row < features.size(); ++row) {
    CHECK(features.status[row] == Status::ok);
    const ss::Frame zeros{};
    CHECK(std::memcmp(&features.frames[row], &zeros, sizeof zeros) == 0);
    CHECK(ss::confidence(features.frame_confidence[row]) == 0.0f);
    Room room(cloud.size());
    CHECK(features.neighbors[row] == found_by(search, cloud.at(keypoints[row]), radius, room).size());
  }
  ss::Recognizer recognizer(ss::RecognizerOptions{});
  CHECK(ss::train(recognizer, features, {0.0f, 0.0f, 1.0f}, "thing", "one") == Status::bad_frame);

  const std::vector<ss::Frame> frames(keypoints.size(), ss::Frame{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}});
  ss::Features<D> framed;
  REQUIRE(ss::extract(cloud.view(), search, keypoints, frames, radius, framed) == Status::ok);
  CHECK(framed.values == features.values);
  CHECK(std::memcmp(framed.frames.data(), frames.data(), frames.size() * sizeof frames[0]) == 0);
  CHECK(ss::train(recognizer, framed, {0.0f, 0.0f, 1.0f}, "thing", "one") == Status::ok);
}

}  // namespace test_without_frame
