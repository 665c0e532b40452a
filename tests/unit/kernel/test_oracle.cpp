// The library against a naive oracle in double precision, over many configurations and random clouds.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"
#include "oracle.hpp"

namespace test_oracle {
namespace {

using namespace unit;
using oracle::LabRule;
using oracle::Voting;

constexpr std::size_t keypoints_per_cloud = 30;

/// What a comparison over many key points comes to.
struct Tally {
  int compared = 0;
  int excluded = 0;
  double worst_l2 = 0.0;       // of all key points
  double worst_value = 0.0;    // of those where no vote hangs on a rounding
  double worst_degrees = 0.0;  // of the frames with distinct principal axes
  int unclear_frames = 0;
};

double degrees_between(const float (&a)[3], const oracle::Vec3f& b) {
  // From the chord, not the cosine: that one cannot see small angles.
  double chord2 = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = static_cast<double>(a[k]) - static_cast<double>(b[k]);
    chord2 += d * d;
  }
  return 2.0 * std::asin(std::min(1.0, std::sqrt(chord2) / 2.0)) * 180.0 / std::acos(-1.0);
}

ss::Frame to_frame(const oracle::ShotFrame& f) {
  return {{f.x[0], f.x[1], f.x[2]}, {f.y[0], f.y[1], f.y[2]}, {f.z[0], f.z[1], f.z[2]}};
}

void require_same_neighbors(const ss::Neighborhood& n, const std::vector<oracle::Neighbor>& expected) {
  std::vector<std::uint32_t> ours(n.index, n.index + n.size);
  std::vector<std::uint32_t> theirs;
  for (const oracle::Neighbor& each : expected) theirs.push_back(static_cast<std::uint32_t>(each.index));
  std::sort(ours.begin(), ours.end());
  std::sort(theirs.begin(), theirs.end());
  REQUIRE(ours == theirs);
}

/// One key point: neighbors equal, frames close, and D in the oracle's own frame against the oracle's description.
template <class D>
void compare_one(const TestCloud& cloud, std::size_t key, float radius, float frame_radius,
                 const oracle::Config& config, Tally& tally) {
  const ss::Point p = cloud.at(key);
  const oracle::Vec3f center{p.x, p.y, p.z};
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  const ss::BruteSearch search{cloud.view()};
  REQUIRE(search.gather(p, std::max(radius, frame_radius), n) == ss::Status::ok);
  const float widest = std::max(radius, frame_radius);
  require_same_neighbors(n, oracle::neighbors(cloud.xyz, center, widest * widest));

  const auto members = oracle::neighbors(cloud.xyz, center, frame_radius * frame_radius);
  const oracle::ShotFrame expected_frame = oracle::shot_frame(members, static_cast<double>(frame_radius));
  REQUIRE(expected_frame.exists);
  ss::Frame frame{};
  REQUIRE(ss::estimate_frame(n, frame_radius, frame) == ss::Status::ok);
  if (expected_frame.clear) {
    tally.worst_degrees =
        std::max({tally.worst_degrees, degrees_between(frame.x, expected_frame.x),
                  degrees_between(frame.y, expected_frame.y), degrees_between(frame.z, expected_frame.z)});
  } else {
    ++tally.unclear_frames;
  }

  const ss::Rgb color = cloud.color_at(key);
  const auto described = oracle::neighbors(cloud.xyz, center, radius * radius);
  const oracle::Description expected =
      oracle::describe(described, cloud.rgb, {color.r, color.g, color.b}, expected_frame, radius, config);
  std::vector<float> ours = garbage<D>();
  REQUIRE(expected.values.size() == ours.size());
  const ss::KeyPoint here({center[0], center[1], center[2]}, color);
  const auto sources = ss::detail::sources_at(typename D::Sources{}, cloud.view(), here);
  REQUIRE(ss::describe<D>(n, sources, to_frame(expected_frame), radius, ours.data()) == ss::Status::ok);
  double l2 = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const double d = static_cast<double>(ours[i]) - expected.values[i];
    l2 += d * d;
    largest = std::max(largest, std::abs(d));
  }
  // Positions in float are good to about 1e-6 cells. Closer to a jump than that, either side is right.
  const bool on_border = expected.border < 1e-6;
  ++tally.compared;
  tally.excluded += on_border ? 1 : 0;
  tally.worst_l2 = std::max(tally.worst_l2, std::sqrt(l2));
  if (!on_border) tally.worst_value = std::max(tally.worst_value, largest);
}

template <class D>
void compare(const oracle::Config& config, float radius = 0.05f, float frame_radius = 0.05f) {
  Tally tally;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const TestCloud cloud = seed % 2 == 0 ? blob(seed, 1500) : curved_surface(seed, 1000);
    Random random(100 + seed);
    for (std::size_t k = 0; k < keypoints_per_cloud; ++k) {
      compare_one<D>(cloud, random.below(cloud.size()), radius, frame_radius, config, tally);
    }
  }
  INFO("excluded " << tally.excluded << " and unclear frames " << tally.unclear_frames << " of " << tally.compared);
  CHECK(tally.worst_value <= 1e-6);
  CHECK(tally.worst_l2 <= 0.15);  // the published jump: golden/README.md
  CHECK(tally.worst_degrees < 0.02);
  CHECK(4 * tally.excluded < tally.compared);
  CHECK(4 * tally.unclear_frames < tally.compared);
}

template <int R, int E, int A>
using Grid = ss::SphericalGrid<R, E, A>;

}  // namespace

TEST_CASE("oracle: SSH of the published sizes") {
  compare<ss::Ssh32>({Voting::published, {{2, 2, 8}}});
  compare<ss::Ssh96>({Voting::published, {{3, 4, 8}}});
  compare<ss::Ssh<Grid<1, 1, 8>>>({Voting::published, {{1, 1, 8}}});
}

TEST_CASE("oracle: SCSH of the published sizes") {
  compare<ss::Scsh336>({Voting::published, {{3, 4, 8}, {2, 2, 4, 15}}});
  compare<ss::Scsh696>({Voting::published, {{3, 4, 8}, {2, 2, 6, 25}}});
}

TEST_CASE("oracle: grids of one cell, of one and two azimuth cells, and of odd sizes") {
  compare<ss::Ssh<Grid<1, 1, 1>>>({Voting::published, {{1, 1, 1}}});
  compare<ss::Ssh<Grid<5, 7, 9>>>({Voting::published, {{5, 7, 9}}});
  compare<ss::Ssh<Grid<4, 3, 1>>>({Voting::published, {{4, 3, 1}}});
  compare<ss::Ssh<Grid<3, 1, 2>>>({Voting::published, {{3, 1, 2}}});
}

TEST_CASE("oracle: histograms of one bin and of many") {
  compare<ss::Scsh<Grid<2, 2, 4>, Grid<2, 2, 2>, 1>>({Voting::published, {{2, 2, 4}, {2, 2, 2, 1}}});
  compare<ss::Scsh<Grid<1, 2, 3>, Grid<1, 1, 1>, 64>>({Voting::published, {{1, 2, 3}, {1, 1, 1, 64}}});
  compare<ss::Descriptor<ss::PublishedVoting, ss::Part<Grid<3, 2, 5>, ss::ColorDistance<7>>>>(
      {Voting::published, {{3, 2, 5, 7}}});
}

TEST_CASE("oracle: the additive rule without the published quirk") {
  using Additive = ss::AdditiveVoting<false>;
  compare<ss::Scsh<Grid<3, 4, 8>, Grid<2, 2, 4>, 15, Additive>>({Voting::additive, {{3, 4, 8}, {2, 2, 4, 15}}});
}

TEST_CASE("oracle: hard voting") {
  compare<ss::Ssh<Grid<5, 7, 9>, ss::HardVoting>>({Voting::hard, {{5, 7, 9}}});
  compare<ss::Scsh<Grid<3, 4, 8>, Grid<2, 2, 4>, 15, ss::HardVoting>>({Voting::hard, {{3, 4, 8}, {2, 2, 4, 15}}});
}

TEST_CASE("oracle: multilinear voting agrees on every key point, near borders too") {
  using Linear = ss::MultilinearVoting;
  compare<ss::Ssh<Grid<5, 7, 9>, Linear>>({Voting::multilinear, {{5, 7, 9}}});
  compare<ss::Ssh<Grid<1, 1, 1>, Linear>>({Voting::multilinear, {{1, 1, 1}}});
  compare<ss::Ssh<Grid<2, 3, 2>, Linear>>({Voting::multilinear, {{2, 3, 2}}});
  compare<ss::Scsh<Grid<3, 4, 8>, Grid<2, 2, 4>, 15, Linear>>({Voting::multilinear, {{3, 4, 8}, {2, 2, 4, 15}}});
  compare<ss::Scsh<Grid<3, 4, 1>, Grid<2, 2, 1>, 1, Linear>>({Voting::multilinear, {{3, 4, 1}, {2, 2, 1, 1}}});
}

TEST_CASE("oracle: logarithmic shells under every voting rule") {
  using Log = ss::LogRadius<>;
  const oracle::Part shape{4, 4, 8};
  const oracle::Part color{2, 2, 4, 15};
  compare<ss::Scsh<Grid<4, 4, 8>, Grid<2, 2, 4>, 15, ss::PublishedVoting, Log>>(
      {Voting::published, {shape, color}, LabRule::published, 0.25});
  compare<ss::Ssh<Grid<4, 4, 8>, ss::HardVoting, Log>>({Voting::hard, {shape}, LabRule::published, 0.25});
  compare<ss::Ssh<Grid<4, 4, 8>, ss::MultilinearVoting, Log>>({Voting::multilinear, {shape}, LabRule::published, 0.25});
  compare<ss::Ssh<Grid<4, 4, 8>, ss::MultilinearVoting, ss::LogRadius<1, 10>>>(
      {Voting::multilinear, {shape}, LabRule::published, 0.1});
  compare<ss::Ssh<Grid<1, 4, 8>, ss::PublishedVoting, Log>>({Voting::published, {{1, 4, 8}}, LabRule::published, 0.25});
}

TEST_CASE("oracle: PCL's color rule") {
  compare<ss::Scsh<Grid<3, 4, 8>, Grid<2, 2, 4>, 15, ss::PublishedVoting, ss::LinearRadius, ss::PclLab>>(
      {Voting::published, {{3, 4, 8}, {2, 2, 4, 15}}, LabRule::pcl});
}

TEST_CASE("oracle: a frame from a smaller or a larger radius than the descriptor's") {
  const oracle::Config config{Voting::published, {{3, 4, 8}, {2, 2, 4, 15}}};
  compare<ss::Scsh336>(config, 0.05f, 0.03f);
  compare<ss::Scsh336>(config, 0.03f, 0.05f);
}

TEST_CASE("oracle: parts are described one after the other, in the order of their types") {
  using Color = ss::Part<Grid<2, 2, 4>, ss::ColorDistance<5>>;
  using Shape = ss::Part<Grid<3, 4, 8>, ss::Occupancy, ss::LogRadius<>>;
  using ColorFirst = ss::Descriptor<ss::MultilinearVoting, Color, ss::Part<Grid<3, 1, 8>, ss::Occupancy>>;
  compare<ColorFirst>({Voting::multilinear, {{2, 2, 4, 5}, {3, 1, 8}}});
  static_assert(ss::Descriptor<ss::HardVoting, Color, Shape>::size == 80 + 96, "one after the other");
}

}  // namespace test_oracle
