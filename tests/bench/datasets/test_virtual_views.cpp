// Virtual RGB-D views of textured meshes.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "cube_scan.hpp"
#include "paper/datasets/virtual_views.hpp"
#include "real_data.hpp"

namespace test_virtual_views {
namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::datasets;
using namespace cube_scan;

constexpr double degree = 3.14159265358979323846 / 180.0;

VirtualViewSet cubes(const VirtualViewOptions& options) {
  const dataset_test::Folder folder;
  add_set(folder);
  return open_virtual_views(folder.path(), options);  // it needs the files no longer
}

// No noise, nothing dropped or hidden, always from 1 m.
VirtualViewOptions exact() {
  VirtualViewOptions options;
  options.nearest_m = options.farthest_m = 1.0;
  options.azimuth_jitter_deg = options.depth_noise_scale = options.disparity_step_px = options.least_cos_incidence =
      0.0;
  options.dropped_share = options.largest_hidden_share = options.gain_spread = options.color_noise = 0.0;
  return options;
}

Vec3 point(const RgbdCloud& cloud, std::size_t i) {
  return Eigen::Vector3f(cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]).cast<double>();
}

// From the frame of a camera 1 m away to the cube's: its center is the origin, half of an edge is 1 long.
Vec3 in_cube(const Vec3& seen, const VirtualView& view) {
  const double azimuth = 30.0 * view.azimuth_index * degree;
  const double elevation = view.elevation_deg * degree;
  const double nearer = 1.0 - seen.z();
  const double outward = std::cos(elevation) * nearer + std::sin(elevation) * seen.y();  // from the cube's z axis
  const double up = std::sin(elevation) * nearer - std::cos(elevation) * seen.y();
  return Vec3(std::cos(azimuth) * outward - std::sin(azimuth) * seen.x(),
              std::sin(azimuth) * outward + std::cos(azimuth) * seen.x(), up) /
         (0.5 * side);
}

bool is_on_top(const Vec3& in_cube) { return in_cube.z() > 1.0 - 1e-4; }

double deviation(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  const double mean = sum / static_cast<double>(values.size());
  return std::sqrt(squares / static_cast<double>(values.size()) - mean * mean);
}

bool is_near(double value, double expected, double tolerance) {
  return std::fabs(value - expected) <= tolerance * std::fabs(expected);
}

bool is_same(const RgbdCloud& a, const RgbdCloud& b) { return a.xyz == b.xyz && a.rgb == b.rgb; }

}  // namespace

TEST_CASE("24 views of each object: half of them from 45 degrees, to be recognized") {
  const VirtualViewSet set = cubes(exact());
  REQUIRE(set.views.size() == 48);
  for (std::size_t i = 0; i < set.views.size(); ++i) {
    const VirtualView& view = set.views[i];
    CHECK(view.object == (i < 24 ? "one" : "other"));
    CHECK(view.object_class == (i < 24 ? "cube" : "box"));
    CHECK(view.is_training == (i % 24 < 12));
    CHECK(view.elevation_deg == (i % 24 < 6 ? 30 : i % 24 < 12 ? 60 : 45));
    const std::size_t azimuth = view.is_training ? 2 * (i % 6) : i % 12;
    CHECK(view.azimuth_index == static_cast<int>(azimuth));
  }
  CHECK(is_near(static_cast<double>(set.load(47).size()), 0.25 * static_cast<double>(set.load(23).size()), 0.1));
  CHECK_THROWS_AS(set.load(48), std::out_of_range);
}

TEST_CASE("without noise all points lie on the object, with the color that is there") {
  const VirtualViewSet set = cubes(exact());
  for (std::size_t i = 0; i < 24; ++i) {
    const RgbdCloud cloud = set.load(i);
    CHECK(cloud.size() > 3000);  // 100 mm at 1 m are 52 pixels
    CHECK(cloud.size() < 5400);  // the largest section of a cube is 1.73 faces
    CHECK(cloud.width == cloud.size());
    CHECK(cloud.height == 1);
    std::size_t away = 0, discolored = 0, on_top = 0;
    for (std::size_t k = 0; k < cloud.size(); ++k) {
      const Vec3 in = in_cube(point(cloud, k), set.views[i]);
      if (std::fabs(in.cwiseAbs().maxCoeff() - 1.0) > 1e-5) ++away;
      const bool is_top = is_on_top(in);
      if (is_top) ++on_top;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        if (cloud.rgb[3 * k + channel] != colors[is_top ? 0 : 1][channel]) ++discolored;
      }
    }
    CHECK(away == 0);
    CHECK(discolored < 3 * 5);  // what lies on an edge may belong to either side
    // The top is nearer than the center: 53.4 pixels wide.
    CHECK(is_near(static_cast<double>(on_top), 53.4 * 53.4 * std::sin(set.views[i].elevation_deg * degree), 0.1));
  }
}

TEST_CASE("disparities are multiples of 1/8 pixel") {
  VirtualViewOptions options = exact();
  const RgbdCloud truth = cubes(options).load(0);
  options.disparity_step_px = 0.125;
  const RgbdCloud rounded = cubes(options).load(0);
  REQUIRE(rounded.size() == truth.size());
  double farthest_from_step = 0.0, largest_change = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const double steps = 8.0 * 575.0 * 0.075 / point(rounded, k).z();
    farthest_from_step = std::max(farthest_from_step, std::fabs(steps - std::round(steps)));
    largest_change = std::max(largest_change, std::fabs(steps - 8.0 * 575.0 * 0.075 / point(truth, k).z()));
  }
  CHECK(farthest_from_step < 1e-4);
  CHECK(largest_change > 0.4);
  CHECK(largest_change < 0.5 + 1e-4);
}

TEST_CASE("noise of depth and color as told, and nothing else is changed by it") {
  VirtualViewOptions options = exact();
  const RgbdCloud truth = cubes(options).load(0);
  options.depth_noise_scale = 2.0;
  options.color_noise = 4.0;
  const RgbdCloud noisy = cubes(options).load(0);
  REQUIRE(noisy.size() == truth.size());
  std::vector<double> depth_errors, color_errors;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const double z = point(truth, k).z();
    depth_errors.push_back((point(noisy, k).z() - z) / (0.0012 + 0.0019 * (z - 0.4) * (z - 0.4)));
    color_errors.push_back(noisy.rgb[3 * k + 1] - truth.rgb[3 * k + 1]);
    CHECK(std::fabs(noisy.xyz[3 * k] / noisy.xyz[3 * k + 2] - truth.xyz[3 * k] / truth.xyz[3 * k + 2]) < 1e-6f);
  }
  CHECK(is_near(deviation(depth_errors), 2.0, 0.05));
  CHECK(is_near(deviation(color_errors), 4.0, 0.05));
}

TEST_CASE("each view has its own gain of each channel, within the spread") {
  VirtualViewOptions options = exact();
  options.gain_spread = 0.12;
  const VirtualViewSet set = cubes(options);
  std::array<std::vector<double>, 3> gains;
  for (std::size_t i = 0; i < 24; ++i) {
    const RgbdCloud cloud = set.load(i);
    std::size_t k = 0;
    while (k + 1 < cloud.size() && !(in_cube(point(cloud, k), set.views[i]).z() > 1.0 - 1e-5)) ++k;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      gains[channel].push_back(cloud.rgb[3 * k + channel] / static_cast<double>(colors[0][channel]));
      CHECK(std::fabs(gains[channel].back() - 1.0) < 0.12 + 0.5 / colors[0][channel]);
    }
  }
  double sum_of_products = 0.0;
  for (std::size_t i = 0; i < 24; ++i) sum_of_products += (gains[0][i] - 1.0) * (gains[2][i] - 1.0);
  for (const std::vector<double>& channel : gains) {
    CHECK(is_near(deviation(channel), 0.24 / std::sqrt(12.0), 0.3));
  }
  const double correlation = sum_of_products / 24.0 / deviation(gains[0]) / deviation(gains[2]);
  CHECK(std::fabs(correlation) < 0.4);
}

TEST_CASE("a half plane hides up to half of a test view, and nothing of a training view") {
  VirtualViewOptions options = exact();
  const VirtualViewSet whole = cubes(options);
  options.largest_hidden_share = 0.5;
  const VirtualViewSet covered = cubes(options);
  std::vector<double> shares;
  for (std::size_t i = 0; i < whole.views.size(); ++i) {
    const RgbdCloud all = whole.load(i), seen = covered.load(i);
    if (whole.views[i].is_training) {
      CHECK(is_same(all, seen));
      continue;
    }
    shares.push_back(1.0 - static_cast<double>(seen.size()) / static_cast<double>(all.size()));
    CHECK(shares.back() >= 0.0);
    CHECK(shares.back() <= 0.5);
    std::size_t found = 0;  // the points seen are some of all, in their order
    for (std::size_t k = 0; k < all.size() && found < seen.size(); ++k) {
      if (point(all, k) == point(seen, found)) ++found;
    }
    CHECK(found == seen.size());
  }
  REQUIRE(shares.size() == 24);
  CHECK(is_near(deviation(shares), 0.5 / std::sqrt(12.0), 0.35));
  CHECK(*std::min_element(shares.begin(), shares.end()) < 0.1);
  CHECK(*std::max_element(shares.begin(), shares.end()) > 0.4);
}

TEST_CASE("pixels are dropped at random and at grazing angles") {
  VirtualViewOptions options = exact();
  const VirtualViewSet whole = cubes(options);
  options.dropped_share = 0.01;
  const VirtualViewSet thinned = cubes(options);
  std::size_t all = 0, kept = 0;
  for (std::size_t i = 0; i < 24; ++i) {
    all += whole.load(i).size();
    kept += thinned.load(i).size();
  }
  CHECK(is_near(static_cast<double>(all - kept) / static_cast<double>(all), 0.01, 0.15));

  options = exact();
  options.least_cos_incidence = 0.6;  // from 60 degrees above, the top is seen at 0.87 and the sides at 0.5 or less
  const VirtualViewSet frontal = cubes(options);
  const RgbdCloud top = frontal.load(6);
  REQUIRE(frontal.views[6].elevation_deg == 60);
  CHECK(top.size() > 2000);
  std::size_t elsewhere = 0;
  for (std::size_t k = 0; k < top.size(); ++k) elsewhere += is_on_top(in_cube(point(top, k), frontal.views[6])) ? 0 : 1;
  CHECK(elsewhere == 0);
}

TEST_CASE("distances and azimuths vary within their ranges") {
  VirtualViewOptions options = exact();
  options.nearest_m = 0.8;
  options.farthest_m = 1.3;
  const VirtualViewSet set = cubes(options);
  std::vector<double> distances;
  for (std::size_t i = 0; i < 24; ++i) {
    const RgbdCloud cloud = set.load(i);
    distances.push_back(std::sqrt(4700.0 / static_cast<double>(cloud.size())));  // from the size in the image, roughly
    CHECK(distances.back() > 0.7);
    CHECK(distances.back() < 1.5);
  }
  CHECK(deviation(distances) > 0.1);
  options = exact();
  const RgbdCloud straight = cubes(options).load(3);
  options.azimuth_jitter_deg = 7.5;
  CHECK_FALSE(is_same(cubes(options).load(3), straight));
}

TEST_CASE("the same seed gives the same bytes, in any order and in any thread") {
  VirtualViewOptions options;
  const VirtualViewSet set = cubes(options);
  std::vector<RgbdCloud> clouds;
  for (std::size_t i = 0; i < set.views.size(); ++i) clouds.push_back(set.load(i));
  const VirtualViewSet again = cubes(options);
  options.seed = 2;
  const VirtualViewSet other = cubes(options);
  std::array<std::size_t, 2> different{};
  const auto compare = [&](std::size_t thread) {
    for (std::size_t i = set.views.size(); i-- > 0;) different[thread] += is_same(again.load(i), clouds[i]) ? 0 : 1;
  };
  std::thread first(compare, 0), second(compare, 1);
  first.join();
  second.join();
  CHECK(different[0] == 0);
  CHECK(different[1] == 0);
  for (std::size_t i = 0; i < set.views.size(); ++i) CHECK_FALSE(is_same(other.load(i), clouds[i]));
}

TEST_CASE("options out of range are refused") {
  const auto refused = [](double VirtualViewOptions::*option, double value) {
    VirtualViewOptions options;
    options.*option = value;
    CHECK_THROWS_AS(cubes(options), std::invalid_argument);
  };
  refused(&VirtualViewOptions::nearest_m, 0.0);
  refused(&VirtualViewOptions::nearest_m, 1.4);
  refused(&VirtualViewOptions::farthest_m, HUGE_VAL);
  refused(&VirtualViewOptions::azimuth_jitter_deg, std::nan(""));
  refused(&VirtualViewOptions::largest_hidden_share, 1.0);
  refused(&VirtualViewOptions::largest_hidden_share, -0.1);
}

TEST_CASE("the scans of the YCB objects are seen from all sides") {
  const std::string directory = real_data("data/ycb_meshes");
  if (directory.empty()) return;
  const VirtualViewSet set = open_virtual_views(directory);
  REQUIRE(set.views.size() == 22 * 24);
  for (std::size_t i = 0; i < set.views.size(); i += 24) {
    const RgbdCloud cloud = set.load(i);
    INFO(set.views[i].object);
    CHECK(cloud.size() > 200);
    CHECK(cloud.rgb.size() == cloud.xyz.size());
    CHECK(*std::max_element(cloud.rgb.begin(), cloud.rgb.end()) > 40);  // not black, as it would be beside the texture
  }
}

}  // namespace test_virtual_views
