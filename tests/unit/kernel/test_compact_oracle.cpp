// The compact descriptors against an oracle of their own, in double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"
#include "oracle_compact.hpp"

namespace test_compact_oracle {
namespace {

using namespace unit;
using oracle::compact::Seen;

constexpr float radius = 0.05f;
constexpr std::size_t points = 1200;

/// Grids with one cell, or two, along some axes.
using Odd = ss::Descriptor<ss::MultilinearVoting, ss::ColorMeansPart<ss::SphericalGrid<1, 1, 1>, 50>,
                           ss::ColorRingsPart<1, ss::LabAxis::a, 5>, ss::HeightPart<ss::SphericalGrid<2, 1, 3>>,
                           ss::HeightPart<ss::SphericalGrid<1, 1, 5>>, ss::HeightPart<ss::SphericalGrid<1, 2, 1>>,
                           ss::ColorMeansPart<ss::SphericalGrid<2, 3, 4>, 25>, ss::ColorRingsPart<4, ss::LabAxis::b, 1>,
                           ss::HeightPart<ss::SphericalGrid<3, 4, 5>>>;
/// Too many cells for quads on the stack.
using Large = ss::Descriptor<ss::MultilinearVoting, ss::HeightPart<ss::SphericalGrid<8, 9, 20>>,
                             ss::ColorMeansPart<ss::SphericalGrid<1, 1, 3>, 100>>;

using Expected = std::vector<double> (*)(const std::vector<Seen>&);

/// D in a known frame, and what is expected of it there: the largest difference of a value's square (roots are steep
/// near 0), and the distance of both.
template <class D>
void compare(Expected expected_of) {
  static ss::Workspace<points> workspace;
  double worst_square = 0.0, worst_l2 = 0.0;
  int compared = 0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const TestCloud cloud = seed % 2 == 0 ? blob(seed, points) : curved_surface(seed, points);
    const ss::BruteSearch search{cloud.view()};
    Random random(40 + seed);
    for (int k = 0; k < 25; ++k) {
      const ss::Point center = cloud.at(random.below(points));
      const oracle::Vec3f key{center.x, center.y, center.z};
      const auto frame_members = oracle::neighbors(cloud.xyz, key, radius * radius);
      const oracle::ShotFrame frame = oracle::shot_frame(frame_members, static_cast<double>(radius));
      if (!frame.exists) continue;
      const ss::Frame ours{{frame.x[0], frame.x[1], frame.x[2]},
                           {frame.y[0], frame.y[1], frame.y[2]},
                           {frame.z[0], frame.z[1], frame.z[2]}};
      std::vector<float> out = garbage<D>();
      REQUIRE(ss::describe_at<D>(cloud.view(), search, center, ours, radius, workspace, out.data()) == ss::Status::ok);
      const std::vector<double> expected = expected_of(oracle::compact::seen(frame_members, cloud.rgb, frame, radius));
      REQUIRE(expected.size() == out.size());
      double squares = 0.0;
      for (std::size_t i = 0; i < out.size(); ++i) {
        const auto value = static_cast<double>(out[i]);
        squares += (value - expected[i]) * (value - expected[i]);
        worst_square = std::max(worst_square, std::abs(value * std::abs(value) - expected[i] * std::abs(expected[i])));
      }
      worst_l2 = std::max(worst_l2, std::sqrt(squares));
      ++compared;
    }
  }
  CHECK(compared >= 90);
  CHECK(worst_square <= 1e-6);
  CHECK(worst_l2 <= 1e-4);
}

}  // namespace

TEST_CASE("compact: each descriptor is the oracle's") {
  using namespace oracle::compact;
  compare<ss::ShapeColor95>(shape_color95);
  compare<ss::ShapeColor32>(shape_color32);
  compare<ss::RoomColor95>(room_color95);
  compare<ss::HeightShape96>(height_shape96);
  compare<ss::ColorRings27>(color_rings27);
  compare<Odd>([](const std::vector<Seen>& p) {
    return joined({means(p, {1, 1, 1}, 0.5), colors(p, 1, 1, 5), heights(p, {2, 1, 3}), heights(p, {1, 1, 5}),
                   heights(p, {1, 2, 1}), means(p, {2, 3, 4}, 0.25), colors(p, 4, 2, 1), heights(p, {3, 4, 5})});
  });
  compare<Large>([](const std::vector<Seen>& p) { return joined({heights(p, {8, 9, 20}), means(p, {1, 1, 3}, 1.0)}); });
}

}  // namespace test_compact_oracle
