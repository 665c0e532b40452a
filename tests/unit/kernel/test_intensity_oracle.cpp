// The signal of lidars and time-of-flight cameras against an oracle of its own, in double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"
#include "intensities.hpp"
#include "oracle.hpp"

namespace test_intensity_oracle {
namespace {

using namespace unit;

template <int R, int E, int A>
using Grid = ss::SphericalGrid<R, E, A>;

constexpr float radius = echo_radius;
constexpr std::size_t points = 1500;

double ratio(float own, float reference) {
  const double echo = std::max(0.0, static_cast<double>(own));
  const double sum = echo + std::max(0.0, static_cast<double>(reference));
  return sum > 0.0 ? echo / sum : 0.5;
}

/// Where a point lies along the axes of a part, in cells.
std::vector<oracle::detail::AxisPosition> position(const oracle::Neighbor& n, const ss::Frame& frame,
                                                   const oracle::Part& part, double place) {
  const auto along = [&n](const float(&axis)[3]) {
    return static_cast<double>((n.v[0] * axis[0] + n.v[2] * axis[2]) + n.v[1] * axis[1]);
  };
  const double x = along(frame.x), y = along(frame.y), z = along(frame.z);
  const double r = std::sqrt(x * x + y * y + z * z), pi = std::acos(-1.0);
  const auto rounded = [](double raw) { return static_cast<double>(static_cast<float>(raw)); };
  std::vector<oracle::detail::AxisPosition> axes{
      {rounded(part.radial * r / static_cast<double>(radius)), part.radial, false},
      {rounded(part.elevation * std::acos(std::max(-1.0, std::min(1.0, z / r))) / pi), part.elevation, false},
      {rounded(part.azimuth * (std::atan2(y, x) + pi) / (2.0 * pi)), part.azimuth, true}};
  const bool exact = place < 1e-20 || place == 0.5 || place > 1.0 - 1e-9;  // in float, too
  if (part.bins > 0) axes.push_back({rounded(part.bins * place), part.bins, false, exact});
  return axes;
}

oracle::Description expected_of(const TestCloud& cloud, const std::vector<float>& intensities, const ss::KeyPoint& key,
                                const ss::Frame& frame, const oracle::Config& config) {
  oracle::Description result;
  const ss::Point& p = key.position;
  for (const oracle::Part& part : config.parts) {
    const int size = part.radial * part.elevation * part.azimuth * std::max(1, part.bins);
    const std::size_t offset = result.values.size();
    result.values.resize(offset + static_cast<std::size_t>(size), 0.0);
    for (const oracle::Neighbor& n : oracle::neighbors(cloud.xyz, {p.x, p.y, p.z}, radius * radius)) {
      if (n.d2 <= 1e-15f || !has_echo(intensities[n.index])) continue;  // left out of all parts
      auto axes = position(n, frame, part, ratio(intensities[n.index], key.intensity));
      for (oracle::detail::AxisPosition& axis : axes) {
        axis.split(config.voting);
        result.border = std::min(result.border, axis.border(config.voting));
      }
      oracle::detail::vote(part, config.voting, axes, result.values.data() + offset);
    }
  }
  double squares = 0.0;
  for (const double value : result.values) squares += value * value;
  for (double& value : result.values) value /= std::sqrt(squares);
  return result;
}

template <class Descriptor>
void compare(const oracle::Config& config) {
  int compared = 0, excluded = 0;
  double worst_value = 0.0, worst_l2 = 0.0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const TestCloud cloud = seed % 2 == 0 ? blob(seed, points) : curved_surface(seed, points);
    const std::vector<float> intensities = some_intensities(10 + seed, points);
    const ss::CloudView view = lit(cloud, intensities);
    Random random(100 + seed);
    for (int k = 0; k < 30; ++k) {
      const std::size_t index = random.below(points);
      if (!has_echo(intensities[index])) continue;
      const ss::KeyPoint key = ss::keypoint(view, index);
      const std::vector<float> ours = described<Descriptor>(view, index);
      const auto expected = expected_of(cloud, intensities, key, frame_at(view, key.position), config);
      REQUIRE(expected.values.size() == ours.size());
      double squares = 0.0, largest = 0.0;
      for (std::size_t i = 0; i < ours.size(); ++i) {
        const double difference = std::abs(static_cast<double>(ours[i]) - expected.values[i]);
        squares += difference * difference;
        largest = std::max(largest, difference);
      }
      const bool on_border = expected.border < 2e-6;  // as good as positions in float are
      ++compared;
      excluded += on_border ? 1 : 0;
      worst_l2 = std::max(worst_l2, std::sqrt(squares));
      if (!on_border) worst_value = std::max(worst_value, largest);
    }
  }
  INFO("excluded " << excluded << " of " << compared);
  CHECK(worst_value <= 1e-6);
  CHECK(worst_l2 <= 0.15);  // a vote that jumps: golden/README.md
  CHECK(4 * excluded < compared);
}

}  // namespace

TEST_CASE("intensity: the descriptor is the oracle's, under every voting rule") {
  using oracle::Voting;
  compare<ss::IntensityShape336>({Voting::published, {{3, 4, 8}, {2, 2, 4, 15}}});
  compare<ss::IntensityShape<Grid<3, 4, 8>, Grid<2, 2, 4>, 15, ss::HardVoting>>(
      {Voting::hard, {{3, 4, 8}, {2, 2, 4, 15}}});
  compare<ss::IntensityShape<Grid<2, 3, 5>, Grid<3, 1, 2>, 7, ss::MultilinearVoting>>(
      {Voting::multilinear, {{2, 3, 5}, {3, 1, 2, 7}}});
}

}  // namespace test_intensity_oracle
