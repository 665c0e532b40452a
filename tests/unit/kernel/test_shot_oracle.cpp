// SHOT and CSHOT of the library against a naive oracle in double precision, over several grids and histograms; and the
// two ways in which PCL's own differ from the default.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"
#include "oracle_shot.hpp"

namespace test_shot_oracle {
namespace {

using namespace unit;
using ss::Status;

template <int R, int E, int A>
using Grid = ss::SphericalGrid<R, E, A>;

constexpr std::size_t keypoints_per_cloud = 30;
// Positions in float are good to about 1e-6 cells. Closer to a jump than that, either side is right.
constexpr double near_border = 1e-6;

/// What a comparison over many key points comes to.
struct Tally {
  int compared = 0;
  int excluded = 0;
  double worst_l2 = 0.0;     // of all key points
  double worst_value = 0.0;  // of those where no vote hangs on a rounding
};

std::vector<float> flat(const std::vector<ss::SurfaceNormal>& normals) {
  std::vector<float> values;
  for (const ss::SurfaceNormal& n : normals) values.insert(values.end(), {n.x, n.y, n.z});
  return values;
}

ss::Frame to_frame(const oracle::ShotFrame& f) {
  return {{f.x[0], f.x[1], f.x[2]}, {f.y[0], f.y[1], f.y[2]}, {f.z[0], f.z[1], f.z[2]}};
}

oracle::ShotFrame from_frame(const ss::Frame& f) { return oracle::given_frame(f.x, f.y, f.z); }

oracle::ShotDescription expected_of(const TestCloud& cloud, std::size_t key, const oracle::ShotFrame& frame,
                                    float radius, const oracle::ShotConfig& config) {
  const ss::Point p = cloud.at(key);
  const ss::Rgb color = cloud.color_at(key);
  return oracle::describe_shot(oracle::neighbors(cloud.xyz, {p.x, p.y, p.z}, radius * radius), flat(cloud.normals),
                               cloud.rgb, {color.r, color.g, color.b}, frame, static_cast<double>(radius), config);
}

double largest_difference(const std::vector<float>& ours, const std::vector<double>& expected) {
  REQUIRE(ours.size() == expected.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(ours[i]) - expected[i]));
  }
  return largest;
}

void count(const std::vector<float>& ours, const oracle::ShotDescription& expected, Tally& tally) {
  REQUIRE(expected.exists);
  const double largest = largest_difference(ours, expected.values);
  double squares = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i)
    squares += std::pow(static_cast<double>(ours[i]) - expected.values[i], 2);
  const bool on_border = expected.border < near_border;
  ++tally.compared;
  tally.excluded += on_border ? 1 : 0;
  tally.worst_l2 = std::max(tally.worst_l2, std::sqrt(squares));
  if (!on_border) tally.worst_value = std::max(tally.worst_value, largest);
}

template <class D, std::size_t MaxNeighbors = 2000>
std::vector<float> described_in(const TestCloud& cloud, std::size_t key, const ss::Frame& frame, float radius) {
  static ss::Workspace<MaxNeighbors> workspace;
  std::vector<float> out = garbage<D>();
  REQUIRE(ss::describe_at<D>(cloud.view(), ss::BruteSearch{cloud.view()}, ss::keypoint(cloud.view(), key), frame,
                             radius, workspace, out.data()) == Status::ok);
  return out;
}

/// One key point, in the oracle's frame and in the library's own.
template <class D>
void compare_one(const TestCloud& cloud, std::size_t key, float radius, const oracle::ShotConfig& config,
                 Tally& tally) {
  const ss::Point p = cloud.at(key);
  const ss::BruteSearch search{cloud.view()};
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(search.gather(p, radius, n) == Status::ok);
  const oracle::ShotFrame given =
      oracle::shot_frame(oracle::neighbors(cloud.xyz, {p.x, p.y, p.z}, radius * radius), static_cast<double>(radius));
  REQUIRE(given.exists);
  std::vector<float> ours = garbage<D>();
  const auto sources = ss::detail::sources_at(typename D::Sources{}, cloud.view(), ss::keypoint(cloud.view(), key));
  REQUIRE(ss::describe<D>(n, sources, to_frame(given), radius, ours.data()) == Status::ok);
  count(ours, expected_of(cloud, key, given, radius, config), tally);
  CHECK(same_bits(described_in<D>(cloud, key, to_frame(given), radius), ours));

  ss::Frame own{};
  REQUIRE(ss::estimate_frame(n, radius, own) == Status::ok);
  static ss::Workspace<2000> workspace;
  REQUIRE(ss::describe_at<D>(cloud.view(), search, key, radius, workspace, ours.data()) == Status::ok);
  count(ours, expected_of(cloud, key, from_frame(own), radius, config), tally);
}

template <class D>
void compare(const oracle::ShotConfig& config, float radius = 0.05f) {
  Tally tally;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const TestCloud cloud = seed % 2 == 0 ? with_random_normals(blob(seed, 1500), seed)
                                          : with_surface_normals(curved_surface(seed, 1000), seed);
    Random random(100 + seed);
    for (std::size_t k = 0; k < keypoints_per_cloud; ++k) {
      compare_one<D>(cloud, random.below(cloud.size()), radius, config, tally);
    }
  }
  INFO("excluded " << tally.excluded << " of " << tally.compared << ", worst L2 " << tally.worst_l2);
  CHECK(tally.worst_value <= 1e-6);
  CHECK(tally.worst_l2 <= 0.15);  // a vote that jumps: golden/README.md
  CHECK(20 * tally.excluded < tally.compared);
}

/// Points of a lattice of R / 4 in the frame of the axes: on shells, on sectors' borders, on the equator, on the poles;
/// with colors and normals on borders and centers of bins.
TestCloud lattice(std::uint32_t seed) {
  Random random(seed);
  TestCloud cloud;
  const auto level = [&random](std::uint8_t step) { return static_cast<std::uint8_t>(step * random.below(5)); };
  const float tilts[] = {-1.0f, -0.5f, 0.0f, 0.5f, 0.75f, 0.875f, 1.0f};
  cloud.add(0.0f, 0.0f, 0.0f, {100, 100, 100});
  cloud.normals.push_back({0.0f, 0.0f, 1.0f});
  for (int k = 0; k < 9 * 9 * 9; ++k) {
    if (k == 364) continue;  // the center
    const auto coordinate = [](int step) { return 0.25f * static_cast<float>(step - 4); };
    cloud.add(coordinate(k % 9), coordinate(k / 9 % 9), coordinate(k / 81), {level(50), level(60), level(40)});
    const float z = tilts[random.below(7)];
    cloud.normals.push_back({std::sqrt(1.0f - z * z), 0.0f, z});
  }
  return cloud;
}

/// Four copies of the key point at the origin, and whatever one adds.
TestCloud few() {
  TestCloud cloud;
  for (int k = 0; k < 4; ++k) {
    cloud.add(0.0f, 0.0f, 0.0f);
    cloud.normals.push_back({0.0f, 0.0f, 1.0f});
  }
  return cloud;
}

constexpr ss::Frame upright{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

const oracle::ShotPart shape{2, 2, 8, 10};
const oracle::ShotPart color{2, 2, 8, 30, true};

}  // namespace

TEST_CASE("shot oracle: SHOT and CSHOT of the published sizes") {
  compare<ss::Shot352>({{shape}});
  compare<ss::Cshot1344>({{shape, color}});
}

TEST_CASE("shot oracle: the same with PCL's defects") {
  compare<ss::PclShot352>({{shape}, true, true});
  compare<ss::PclCshot1344>({{shape, color}, true, true});
}

TEST_CASE("shot oracle: grids and histograms of other sizes") {
  compare<ss::Shot<Grid<3, 4, 6>, 7>>({{{3, 4, 6, 7}}});
  compare<ss::Shot<Grid<1, 1, 8>, 1>>({{{1, 1, 8, 1}}});
  compare<ss::Shot<Grid<5, 3, 2>, 20>>({{{5, 3, 2, 20}}});
  compare<ss::Shot<Grid<1, 5, 3>, 4>>({{{1, 5, 3, 4}}});
  compare<ss::Cshot<Grid<1, 1, 8>, 5, 12>>({{{1, 1, 8, 5}, {1, 1, 8, 12, true}}});
  compare<ss::Cshot<Grid<3, 2, 4>, 10, 64>>({{{3, 2, 4, 10}, {3, 2, 4, 64, true}}});
  compare<ss::Cshot<Grid<2, 3, 5>, 3, 7>>({{{2, 3, 5, 3}, {2, 3, 5, 7, true}}});  // bins with a common divisor
  compare<ss::Shot<Grid<3, 2, 1>, 6>>({{{3, 2, 1, 6}}});
  compare<ss::Cshot<Grid<3, 4, 6>, 7, 20, ss::PclVoting>>({{{3, 4, 6, 7}, {3, 4, 6, 20, true}}, true});
  compare<ss::Shot<Grid<2, 2, 4>, 1, ss::PclVoting>>({{{2, 2, 4, 1}}, true});
}

TEST_CASE("shot oracle: logarithmic shells, and parts on grids of their own") {
  using Log = ss::LogRadius<>;
  compare<ss::Shot<Grid<4, 2, 8>, 10, ss::ShotVoting, Log>>({{{4, 2, 8, 10}}, false, false, 0.25});
  using Shape = ss::Part<Grid<2, 2, 8>, ss::NormalCosine<10>, ss::LinearRadius, ss::ShotCells>;
  using Color = ss::Part<Grid<1, 3, 4>, ss::ColorDistance<6, ss::CshotLab>, ss::LinearRadius, ss::ShotCells>;
  compare<ss::Descriptor<ss::ShotVoting, Color, Shape>>({{{1, 3, 4, 6, true}, shape}});
}

TEST_CASE("shot oracle: votes of ten thousand neighbors are coarser, and still add up") {
  const TestCloud cloud = with_random_normals(blob(3, 20000), 4);
  const float radius = 0.15f;
  const auto l2 = [&](auto descriptor, const oracle::ShotConfig& config) {
    using D = decltype(descriptor);
    Tally tally;
    count(described_in<D, 20000>(cloud, 10000, upright, radius),
          expected_of(cloud, 10000, from_frame(upright), radius, config), tally);
    return tally.worst_l2;
  };
  CHECK(l2(ss::Shot352{}, {{shape}}) < 2e-6);
  CHECK(l2(ss::PclCshot1344{}, {{shape, color}, true, true}) < 2e-6);
}

TEST_CASE("shot oracle: points exactly on borders and axes belong where PCL puts them") {
  const TestCloud cloud = lattice(7);
  const auto check_rows = [&](auto descriptor, const oracle::ShotConfig& config) {
    using D = decltype(descriptor);
    for (const float radius : {1.0f, 0.75f, 2.0f}) {
      const oracle::ShotDescription expected = expected_of(cloud, 0, from_frame(upright), radius, config);
      REQUIRE(expected.border == 0.0);
      const std::vector<float> ours = described_in<D>(cloud, 0, upright, radius);
      CHECK(largest_difference(ours, expected.values) <= 1e-6);
    }
  };
  check_rows(ss::Shot352{}, {{shape}});
  check_rows(ss::PclShot352{}, {{shape}, true, true});
  check_rows(ss::Cshot1344{}, {{shape, color}});
  check_rows(ss::PclCshot1344{}, {{shape, color}, true, true});
  check_rows(ss::Shot<Grid<4, 2, 8>, 10>{}, {{{4, 2, 8, 10}}});
}

TEST_CASE("shot oracle: PCL's last bin but one shares with the first, the default's with the last") {
  // One neighbor, somewhere in a cell; its cosine lies between the last two bins, or nowhere near them.
  const auto differing = [](float position) {
    TestCloud cloud = few();
    cloud.add(0.3f, 0.2f, 0.1f);
    const float z = position / 5.0f - 1.0f;
    cloud.normals.push_back({std::sqrt(1.0f - z * z), 0.0f, z});
    const std::vector<float> plain = described_in<ss::Shot352>(cloud, 0, upright, 1.0f);
    const std::vector<float> pcl = described_in<ss::PclShot352>(cloud, 0, upright, 1.0f);
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      if (plain[i] != pcl[i]) places.push_back(i);
    }
    if (places.size() == 2) {
      CHECK(pcl[places[0]] == plain[places[1]]);
      CHECK(pcl[places[0]] > 0.05f);
      CHECK(plain[places[0]] == 0.0f);
      CHECK(pcl[places[1]] == 0.0f);
    }
    return places;
  };
  // Sector 4 (0 to 45 degrees), inner shell, upper half.
  const std::size_t cell = 11 * (1 + 2 * (0 + 2 * 4));
  CHECK(differing(9.3f) == std::vector<std::size_t>{cell, cell + 10});
  CHECK(differing(8.7f).empty());  // nearest to bin 9, shares with bin 8
  CHECK(differing(9.7f).empty());  // nearest to bin 10, shares with bin 9
  CHECK(differing(0.3f).empty());
}

TEST_CASE("shot oracle: white is like the lightest grays, and far from them with PCL's defects") {
  const ss::Rgb white{255, 255, 255};
  const ss::Rgb gray{250, 250, 250};
  const auto bin_of = [](auto descriptor, ss::Rgb key, ss::Rgb neighbor) {
    using D = decltype(descriptor);
    TestCloud cloud = few();
    for (std::size_t k = 0; k < 4; ++k) {
      cloud.rgb[3 * k] = key.r;
      cloud.rgb[3 * k + 1] = key.g;
      cloud.rgb[3 * k + 2] = key.b;
    }
    cloud.add(0.3f, 0.2f, 0.1f, neighbor);
    cloud.normals.push_back({0.0f, 0.0f, 1.0f});
    const std::vector<float> values = described_in<D>(cloud, 0, upright, 1.0f);
    const float* colors = values.data() + 352 + 31 * (1 + 2 * (0 + 2 * 4));
    return std::max_element(colors, colors + 31) - colors;
  };
  const auto far = [](std::array<double, 3> lab) {  // PCL's white: L = -16, a = 120, b = -120
    return std::lround(30.0 * oracle::color_distance({-16.0, 120.0, -120.0}, lab));
  };
  const auto far_from_gray = far(oracle::lab({250, 250, 250}, oracle::LabRule::pcl));
  REQUIRE(far_from_gray > 15);
  CHECK(bin_of(ss::Cshot1344{}, white, gray) == 0);
  CHECK(bin_of(ss::Cshot1344{}, gray, white) == 0);
  CHECK(bin_of(ss::PclCshot1344{}, white, gray) == far_from_gray);
  CHECK(bin_of(ss::PclCshot1344{}, gray, white) == far_from_gray);
  CHECK(bin_of(ss::PclCshot1344{}, white, white) == 0);
  CHECK(bin_of(ss::PclCshot1344{}, gray, gray) == 0);
}

TEST_CASE("shot oracle: a cloud with white points, under both rules") {
  TestCloud cloud = with_random_normals(blob(21, 1500), 22);
  for (std::size_t i = 0; i < cloud.size(); i += 7) std::fill_n(cloud.rgb.begin() + static_cast<long>(3 * i), 3, 255);
  Tally plain, pcl;
  for (const std::size_t key : {0u, 7u, 700u, 1u, 2u, 1001u}) {  // the first three are white
    compare_one<ss::Cshot1344>(cloud, key, 0.05f, {{shape, color}}, plain);
    compare_one<ss::PclCshot1344>(cloud, key, 0.05f, {{shape, color}, true, true}, pcl);
  }
  CHECK(plain.worst_value <= 1e-6);
  CHECK(pcl.worst_value <= 1e-6);
  CHECK(plain.excluded + pcl.excluded < 6);
}

}  // namespace test_shot_oracle
