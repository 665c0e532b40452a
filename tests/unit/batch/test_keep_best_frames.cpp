// Features know how sure their frames are, and can be thinned out to the surest.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "fixtures.hpp"

namespace test_keep_best_frames {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Ssh32;

constexpr float radius = 0.05f;

bool same_bits(const std::vector<ss::FrameConfidence>& a, const std::vector<ss::FrameConfidence>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(ss::FrameConfidence)) == 0;
}

/// Every 10th point of a surface, and two that cannot be described.
ss::Features<D> extracted(const TestCloud& cloud, unsigned threads = 1) {
  std::vector<int> keypoints{-1};
  for (std::size_t i = 0; i < cloud.size(); i += 10) keypoints.push_back(static_cast<int>(i));
  keypoints.push_back(-1);
  ss::Features<D> features;
  REQUIRE(ss::extract(cloud.view(), ss::GridSearch(cloud.view(), radius), keypoints, radius, features, threads) ==
          Status::ok);
  return features;
}

std::size_t count_of(const ss::Features<D>& features, Status status) {
  return static_cast<std::size_t>(std::count(features.status.begin(), features.status.end(), status));
}

bool is_cleared(const ss::Features<D>& features, std::size_t row) {
  const ss::Frame& f = features.frames[row];
  const ss::FrameConfidence& c = features.frame_confidence[row];
  return all_zero(std::vector<float>(features[row], features[row] + D::size)) &&
         all_zero({f.x[0], f.x[1], f.x[2], f.y[0], f.y[1], f.y[2], f.z[0], f.z[1], f.z[2]}) &&
         all_zero({c.eigenvalue_gap, c.x_margin, c.z_margin});
}

/// Five rows whose frames are as sure as that.
ss::Features<D> five_rows(const std::vector<float>& confidences) {
  ss::Features<D> features;
  features.status.assign(5, Status::ok);
  features.frames.assign(5, ss::Frame{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}});
  features.values.assign(5 * D::size, 0.5f);
  for (const float c : confidences) features.frame_confidence.push_back({c, 0.5f, 0.5f});
  return features;
}

}  // namespace

TEST_CASE("extract: keeps how sure each frame is, whatever the threads; zeros where there is none") {
  const TestCloud cloud = curved_surface(1, 1500);
  const ss::Features<D> features = extracted(cloud);
  REQUIRE(features.frame_confidence.size() == features.size());
  CHECK(is_cleared(features, 0));
  CHECK(is_cleared(features, features.size() - 1));
  Room room(cloud.size());
  for (std::size_t row = 1; row + 1 < features.size(); ++row) {
    ss::Neighborhood n = room.neighborhood();
    REQUIRE(ss::BruteSearch{cloud.view()}.gather(cloud.at(10 * (row - 1)), radius, n) == Status::ok);
    ss::Frame frame{};
    ss::FrameConfidence expected{};
    REQUIRE(ss::estimate_frame(n, radius, frame, expected) == Status::ok);
    CHECK(std::memcmp(&features.frame_confidence[row], &expected, sizeof expected) == 0);
  }
  for (const unsigned threads : {2u, 5u}) {
    CHECK(same_bits(extracted(cloud, threads).frame_confidence, features.frame_confidence));
  }
}

TEST_CASE("keep_best_frames: the surest share of what was described stays, untouched and in its place") {
  const ss::Features<D> all = extracted(curved_surface(2, 1500));
  for (const float share : {1.0f, 0.75f, 0.5f, 0.1f, 1e-9f}) {
    ss::Features<D> features = all;
    REQUIRE(ss::keep_best_frames(features, share) == Status::ok);
    const std::size_t kept = count_of(features, Status::ok);
    CHECK(kept == std::max<std::size_t>(1, static_cast<std::size_t>(150.0f * share + 0.5f)));
    CHECK(count_of(features, Status::unsure_frame) == 150 - kept);
    CHECK(count_of(features, Status::bad_keypoint) == 2);
    CHECK(features.neighbors == all.neighbors);
    float least_kept = 1.0f;
    float most_left_out = 0.0f;
    for (std::size_t row = 0; row < all.size(); ++row) {
      if (all.status[row] != Status::ok) continue;
      const float sure = ss::confidence(all.frame_confidence[row]);
      if (features.status[row] == Status::ok) {
        least_kept = std::min(least_kept, sure);
        CHECK(std::equal(features[row], features[row] + D::size, all[row]));
        CHECK(std::memcmp(&features.frames[row], &all.frames[row], sizeof(ss::Frame)) == 0);
      } else {
        most_left_out = std::max(most_left_out, sure);
        CHECK(is_cleared(features, row));
      }
    }
    CHECK(least_kept >= most_left_out);
  }
}

TEST_CASE("keep_best_frames: of equally sure rows the first stay; halves of halves are quarters") {
  ss::Features<D> features = five_rows({0.2f, 0.3f, 0.2f, 0.1f, 0.2f});
  REQUIRE(ss::keep_best_frames(features, 0.6f) == Status::ok);
  using List = std::vector<Status>;
  CHECK(features.status == List{Status::ok, Status::ok, Status::ok, Status::unsure_frame, Status::unsure_frame});
  REQUIRE(ss::keep_best_frames(features, 0.6f) == Status::ok);  // 1.8 of 3
  CHECK(features.status ==
        List{Status::ok, Status::ok, Status::unsure_frame, Status::unsure_frame, Status::unsure_frame});
  features = five_rows({0.0f, 0.0f, 0.0f, 0.0f, 0.0f});
  REQUIRE(ss::keep_best_frames(features, 0.4f) == Status::ok);
  CHECK(count_of(features, Status::ok) == 2);
  CHECK((features.status[0] == Status::ok && features.status[1] == Status::ok));
}

TEST_CASE("keep_best_frames: refuses shares that are none and changes nothing; no rows are no error") {
  for (const float bad : {0.0f, -0.5f, 1.0001f, not_a_number, infinity, -infinity}) {
    ss::Features<D> features = five_rows({0.2f, 0.3f, 0.2f, 0.1f, 0.2f});
    CHECK(ss::keep_best_frames(features, bad) == Status::bad_option);
    CHECK(count_of(features, Status::ok) == 5);
  }
  ss::Features<D> none;
  CHECK(ss::keep_best_frames(none, 0.5f) == Status::ok);
}

TEST_CASE("keep_best_frames: what was left out is matched with nothing") {
  ss::Features<D> features = extracted(curved_surface(3, 1500));
  const ss::Features<D> all = features;
  REQUIRE(ss::keep_best_frames(features, 0.25f) == Status::ok);
  std::vector<ss::MatchedPair> pairs;
  REQUIRE(ss::reciprocal_correspondences(ss::rows_of(features), ss::rows_of(all), pairs) == Status::ok);
  CHECK(pairs.size() == count_of(features, Status::ok));  // each its own partner
  for (const ss::MatchedPair& pair : pairs) {
    CHECK(pair.source == pair.target);
    CHECK(features.status[pair.source] == Status::ok);
  }
}

}  // namespace test_keep_best_frames
