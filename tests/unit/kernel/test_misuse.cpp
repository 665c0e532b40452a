// Mistakes that are easy to make: each gets its Status and zeros, and none of them reads foreign memory.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "fixtures.hpp"

namespace test_misuse {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Scsh336;

constexpr float radius = 0.1f;

}  // namespace

TEST_CASE("misuse: a search over another cloud is refused, also in bulk") {
  const TestCloud big = blob(1, 500);
  const TestCloud small = blob(2, 20);
  const ss::GridSearch search(big.view(), radius);
  const auto workspace = std::make_unique<ss::Workspace<512>>();
  std::vector<float> out = garbage<D>();
  CHECK(ss::describe_at<D>(small.view(), search, 0, radius, *workspace, out.data()) == Status::bad_view);
  CHECK(all_zero(out));
  ss::Features<D> features;
  CHECK(ss::extract(small.view(), search, std::vector<std::uint32_t>{0, 1}, radius, features) == Status::bad_view);
  CHECK(features.status == std::vector<Status>{Status::bad_view, Status::bad_view});
  CHECK(all_zero(features.values));
}

TEST_CASE("misuse: a color source without colors is missing_colors") {
  const TestCloud cloud = blob(3, 200);
  Room room(200);
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(cloud.at(0), radius, n) == Status::ok);
  const ss::Frame frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<float> out = garbage<D>();
  const ss::CloudView colorless = ss::view_xyz(cloud.xyz.data(), cloud.size());
  CHECK(ss::describe<D>(n, ss::RgbColors<ss::PublishedLab>{colorless, {}}, frame, radius, out.data()) ==
        Status::missing_colors);
  CHECK(all_zero(out));
  CHECK(ss::describe<D>(n, ss::LabColors{nullptr, {}}, frame, radius, out.data()) == Status::missing_colors);
}

TEST_CASE("misuse: indices of any integer type, and negative ones lie outside the cloud") {
  const TestCloud cloud = blob(4, 300);
  const ss::GridSearch search(cloud.view(), radius);
  ss::Features<D> expected, features;
  REQUIRE(ss::extract(cloud.view(), search, std::vector<std::uint32_t>{3, 7}, radius, expected) == Status::ok);
  REQUIRE(ss::extract(cloud.view(), search, std::vector<int>{3, -1, 7}, radius, features) == Status::ok);
  CHECK(features.status[1] == Status::bad_keypoint);
  const auto row = [](const ss::Features<D>& f, std::size_t i) { return std::vector<float>(f[i], f[i] + D::size); };
  CHECK(same_bits(row(features, 0), row(expected, 0)));
  CHECK(all_zero(row(features, 1)));
  CHECK(same_bits(row(features, 2), row(expected, 1)));
}

TEST_CASE("misuse: more threads than key points, or than the machine has, change nothing") {
  const TestCloud cloud = blob(5, 300);
  const ss::GridSearch search(cloud.view(), radius);
  const std::vector<int> keypoints{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18};
  ss::Features<D> one, many;
  REQUIRE(ss::extract(cloud.view(), search, keypoints, radius, one, 0) == Status::ok);
  REQUIRE(ss::extract(cloud.view(), search, keypoints, radius, many, 1000000) == Status::ok);
  CHECK(same_bits(one.values, many.values));
}

TEST_CASE("misuse: a copied search searches its own memory") {
  const TestCloud cloud = blob(6, 300);
  auto original = std::make_unique<ss::StaticGrid<400, 1000>>();
  REQUIRE(original->build(cloud.view(), radius) == Status::ok);
  const auto copy = std::make_unique<ss::StaticGrid<400, 1000>>(*original);
  auto hosted = std::make_unique<ss::GridSearch>(cloud.view(), radius);
  const ss::GridSearch hosted_copy = *hosted;
  Room room(300);
  const auto expected = found_by(*original, cloud.at(1), radius, room);
  original.reset();
  hosted.reset();
  CHECK(expected.size() > 10);
  CHECK(found_by(*copy, cloud.at(1), radius, room) == expected);
  CHECK(found_by(hosted_copy, cloud.at(1), radius, room) == expected);
}

TEST_CASE("misuse: a viewpoint that is not finite is refused; one at the key point leaves z to the vote") {
  const TestCloud cloud = curved_surface(7, 400);
  const ss::GridSearch search(cloud.view(), radius);
  const auto workspace = std::make_unique<ss::Workspace<512>>();
  std::vector<float> by_vote = garbage<D>(), out = garbage<D>();
  ss::Support support = radius;
  REQUIRE(ss::describe_at<D>(cloud.view(), search, 9, support, *workspace, by_vote.data()) == Status::ok);
  const ss::Point nowhere{0.0f, infinity, 0.0f};
  support.viewpoint = ss::Viewpoint::towards(nowhere);
  CHECK(ss::describe_at<D>(cloud.view(), search, 9, support, *workspace, out.data()) == Status::bad_viewpoint);
  CHECK(all_zero(out));
  TestCloud far;  // so far from the viewpoint that the difference is not finite
  for (int i = 0; i < 10; ++i) far.add(-2e38f, 0.01f * static_cast<float>(i), 0.0f);
  const ss::Point opposite{2e38f, 0.0f, 0.0f};
  support.viewpoint = ss::Viewpoint::towards(opposite);
  CHECK(ss::describe_at<D>(far.view(), ss::BruteSearch{far.view()}, 0, support, *workspace, out.data()) ==
        Status::bad_viewpoint);
  CHECK(all_zero(out));
  const ss::Point here = cloud.at(9);
  support.viewpoint = ss::Viewpoint::away_from(here);
  CHECK(ss::describe_at<D>(cloud.view(), search, 9, support, *workspace, out.data()) == Status::ok);
  CHECK(same_bits(out, by_vote));
}

TEST_CASE("misuse: a frame given by the caller is used, or refused if it is none") {
  const TestCloud cloud = curved_surface(8, 400);
  const ss::GridSearch search(cloud.view(), radius);
  const auto workspace = std::make_unique<ss::Workspace<512>>();
  ss::Neighborhood n = ss::neighborhood_in(*workspace);
  REQUIRE(search.gather(cloud.at(5), radius, n) == Status::ok);
  ss::Frame frame{};
  REQUIRE(ss::estimate_frame(n, radius, frame) == Status::ok);
  const ss::KeyPoint key = ss::keypoint(cloud.view(), 5);
  std::vector<float> own = garbage<D>(), given = garbage<D>();
  REQUIRE(ss::describe_at<D>(cloud.view(), search, key, radius, *workspace, own.data()) == Status::ok);
  REQUIRE(ss::describe_at<D>(cloud.view(), search, key, frame, radius, *workspace, given.data()) == Status::ok);
  CHECK(same_bits(own, given));
  frame.x[0] += 0.5f;
  CHECK(ss::describe_at<D>(cloud.view(), search, key, frame, radius, *workspace, given.data()) == Status::bad_frame);
  CHECK(all_zero(given));
}

TEST_CASE("misuse: a frame that the fixed-point sums cannot resolve is refused, not guessed") {
  // A dense cluster at the key point, whose products round to nothing one by one, and six far points that decide.
  TestCloud cloud;
  Random random(11);
  cloud.add(0.0f, 0.0f, 0.0f);
  for (int i = 0; i < 50000; ++i) {
    cloud.add(0.0005f * random.between(-1.0f, 1.0f), 0.00025f * random.between(-1.0f, 1.0f),
              0.00016f * random.between(-1.0f, 1.0f));
  }
  for (const float sign : {-1.0f, 1.0f}) {
    cloud.add(sign * 0.09f, 0.0f, 0.001f * sign);
    cloud.add(0.0f, sign * 0.00001f, 0.0f);
    cloud.add(0.0f, 0.0f, sign * 0.00001f);
  }
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather(cloud.at(0), radius, n) == Status::ok);
  ss::Frame frame{};
  const Status status = ss::estimate_frame(n, radius, frame);
  const bool right = status == Status::ok && std::abs(frame.x[0]) > 0.999f && std::abs(frame.z[2]) > 0.99f;
  CHECK((status == Status::ambiguous_frame || right));
}

TEST_CASE("misuse: the tests themselves are built so that the bits can be the same everywhere") {
  CHECK(ss::self_check());
}

}  // namespace test_misuse
