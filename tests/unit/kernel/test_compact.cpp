// What compact descriptors promise besides their formulas: statuses, lengths, no dependence on gain, order or search;
// and their parts under other rules.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "fixtures.hpp"

namespace test_compact {
namespace {

using namespace unit;
using ss::Status;

constexpr float radius = 0.05f;
ss::Workspace<2000> workspace;

template <class D>
std::vector<float> described_at(const ss::CloudView& cloud, const ss::KeyPoint& key,
                                const ss::Support& support = radius) {
  std::vector<float> out = garbage<D>();
  REQUIRE(ss::describe_at<D>(cloud, ss::BruteSearch{cloud}, key, support, workspace, out.data()) == Status::ok);
  return out;
}

double length(const std::vector<float>& values, std::size_t first, std::size_t count) {
  double squares = 0.0;
  for (std::size_t i = first; i < first + count; ++i) {
    squares += static_cast<double>(values[i]) * static_cast<double>(values[i]);
  }
  return std::sqrt(squares);
}

template <class D>
double part_length(const std::vector<float>& values, int part) {
  const auto first = static_cast<std::size_t>(D::offset(part));
  return length(values, first, static_cast<std::size_t>(D::offset(part + 1)) - first);
}

TestCloud of_one_color(TestCloud cloud, ss::Rgb color) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud.rgb[3 * i] = color.r;
    cloud.rgb[3 * i + 1] = color.g;
    cloud.rgb[3 * i + 2] = color.b;
  }
  return cloud;
}

}  // namespace

TEST_CASE("compact: the whole has length 1, and each kind of part its own share of it") {
  using D = ss::ShapeColor95;
  const TestCloud cloud = curved_surface(3, 1500);
  const std::vector<float> values = described_at<D>(cloud.view(), cloud.at(7));
  CHECK(length(values, 0, values.size()) == doctest::Approx(1.0).epsilon(1e-6));
  const double shape = part_length<D>(values, 0);
  CHECK(part_length<D>(values, 1) <= 0.6 * shape);
  for (int ring_part = 2; ring_part < 5; ++ring_part) {
    CHECK(part_length<D>(values, ring_part) == doctest::Approx(0.866 * shape).epsilon(1e-5));
  }
}

TEST_CASE("compact: where all colors are equal, means are 0 and the histograms' middle has all") {
  using D = ss::ShapeColor95;
  using Room = ss::RoomColor95;
  for (const ss::Rgb color : {ss::Rgb{60, 60, 60}, ss::Rgb{201, 17, 133}, ss::Rgb{3, 250, 77}}) {
    TestCloud cloud = of_one_color(curved_surface(4, 1500), color);
    const std::vector<float> values = described_at<D>(cloud.view(), cloud.at(9));
    CHECK(part_length<D>(values, 1) == 0.0);
    CHECK(part_length<Room>(described_at<Room>(cloud.view(), cloud.at(9)), 1) == 0.0);
    for (std::size_t ring = 0; ring < 3; ++ring) {
      const auto first = static_cast<std::size_t>(D::offset(2)) + 6 * ring;
      for (const std::size_t bin : {0u, 1u, 4u, 5u}) CHECK(values[first + bin] == 0.0f);
      CHECK(values[first + 2] == doctest::Approx(static_cast<double>(values[first + 3])).epsilon(1e-3));
    }
    cloud.add(10.0f, 0.0f, 0.0f, {255, 255, 255});  // too far away
    CHECK(described_at<D>(cloud.view(), cloud.at(9)) == values);
  }
}

TEST_CASE("compact: a key point needs no color, the cloud does") {
  using D = ss::ShapeColor32;
  const TestCloud cloud = curved_surface(5, 800);
  const ss::KeyPoint bare(cloud.at(11));
  const ss::KeyPoint colored(cloud.at(11), {255, 0, 255});
  CHECK(same_bits(described_at<D>(cloud.view(), bare), described_at<D>(cloud.view(), colored)));

  ss::Features<D> features;
  REQUIRE(ss::extract(cloud.view(), ss::BruteSearch{cloud.view()}, std::vector<ss::KeyPoint>{bare}, radius, features) ==
          Status::ok);
  CHECK(features.status[0] == Status::ok);
  CHECK(same_bits(features.values, described_at<D>(cloud.view(), bare)));

  ss::CloudView colorless = cloud.view();
  colorless.colors = {};
  std::vector<float> out = garbage<D>();
  CHECK(ss::describe_at<D>(colorless, ss::BruteSearch{colorless}, bare, radius, workspace, out.data()) ==
        Status::missing_colors);
  CHECK(std::all_of(out.begin(), out.end(), [](float v) { return v == 0.0f; }));
  CHECK(described_at<ss::HeightShape96>(colorless, bare).size() == 192);
}

TEST_CASE("compact: zeros where nobody but the key point and its copies is there") {
  TestCloud cloud = curved_surface(5, 100);
  const ss::Point lonely{5.0f, 5.0f, 5.0f};
  for (int copies = 0; copies < 3; ++copies) cloud.add(lonely);
  const ss::Frame upright{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto check = [&](auto descriptor) {
    using D = decltype(descriptor);
    std::vector<float> out = garbage<D>();
    CHECK(ss::describe_at<D>(cloud.view(), ss::BruteSearch{cloud.view()}, ss::KeyPoint(lonely), upright, radius,
                             workspace, out.data()) == Status::too_few_neighbors);
    CHECK(same_bits(out, std::vector<float>(out.size(), 0.0f)));
  };
  check(ss::ShapeColor95{});
  check(ss::ShapeColor32{});
  check(ss::RoomColor95{});
  check(ss::HeightShape96{});
  check(ss::ColorRings27{});
}

TEST_CASE("compact: stored colors, and any order of points, give the same bits") {
  using D = ss::ShapeColor95;
  const TestCloud cloud = blob(6, 900);
  const std::vector<float> expected = described_at<D>(cloud.view(), cloud.at(3));

  std::vector<ss::Lab> lab(cloud.size());
  REQUIRE(ss::convert_colors<ss::PublishedLab>(cloud.view(), lab.data()) == Status::ok);
  std::vector<float> out = garbage<D>();
  REQUIRE(ss::describe_at<D>(cloud.view(), ss::BruteSearch{cloud.view()}, cloud.at(3), radius, workspace, out.data(),
                             lab.data()) == Status::ok);
  CHECK(same_bits(out, expected));

  TestCloud backwards;
  for (std::size_t i = cloud.size(); i-- > 0;) backwards.add(cloud.at(i), cloud.color_at(i));
  CHECK(same_bits(described_at<D>(backwards.view(), cloud.at(3)), expected));
}

TEST_CASE("compact: rings of colors do not change with the frame") {
  using D = ss::ColorRings27;
  const TestCloud cloud = blob(8, 900);
  std::vector<float> out = garbage<D>();
  const ss::Frame turned{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  REQUIRE(ss::describe_at<D>(cloud.view(), ss::BruteSearch{cloud.view()}, ss::KeyPoint(cloud.at(3)), turned, radius,
                             workspace, out.data()) == Status::ok);
  CHECK(same_bits(out, described_at<D>(cloud.view(), cloud.at(3))));
}

TEST_CASE("ingredients: the published descriptors take roots, heights and the mean color as well") {
  using Grid = ss::SphericalGrid<3, 4, 8>;
  using Rooted =
      ss::Descriptor<ss::PublishedVoting,
                     ss::Part<Grid, ss::Occupancy, ss::LinearRadius, ss::PublishedCells, ss::RootOfShares<>>>;
  const TestCloud cloud = curved_surface(9, 1500);
  const std::vector<float> plain = described_at<ss::Ssh96>(cloud.view(), cloud.at(5));
  const std::vector<float> rooted = described_at<Rooted>(cloud.view(), cloud.at(5));
  const double sum = std::accumulate(plain.begin(), plain.end(), 0.0);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    CHECK(static_cast<double>(rooted[i]) ==
          doctest::Approx(std::sqrt(static_cast<double>(plain[i]) / sum)).epsilon(1e-5));
  }

  using OfHeights =
      ss::Descriptor<ss::HardVoting,
                     ss::Part<ss::SphericalGrid<1, 4, 1>, ss::Occupancy, ss::LinearRadius, ss::HeightCells>>;
  TestCloud column;  // in the frame's z: two points in the highest slice, one each in the third and the fourth
  for (const float z : {0.0f, 0.04f, 0.03f, -0.001f, -0.02f}) column.add(0.001f * z, 0.0f, z);
  std::vector<float> out = garbage<OfHeights>();
  const ss::Frame upright{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  REQUIRE(ss::describe_at<OfHeights>(column.view(), ss::BruteSearch{column.view()}, ss::KeyPoint(column.at(0)), upright,
                                     radius, workspace, out.data()) == Status::ok);
  const std::vector<double> counts{2, 0, 1, 1};
  for (std::size_t i = 0; i < 4; ++i) CHECK(static_cast<double>(out[i]) == doctest::Approx(counts[i] / std::sqrt(6.0)));

  using AroundMean =
      ss::Descriptor<ss::PublishedVoting,
                     ss::Part<ss::SphericalGrid<2, 2, 4>, ss::ColorDistance<15, ss::PublishedLab, ss::MeanColor>>>;
  const std::vector<float> around = described_at<AroundMean>(cloud.view(), ss::KeyPoint(cloud.at(5), {0, 0, 0}));
  CHECK(same_bits(around, described_at<AroundMean>(cloud.view(), ss::KeyPoint(cloud.at(5), {255, 255, 255}))));
}

}  // namespace test_compact
