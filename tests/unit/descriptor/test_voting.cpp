// The voting rules at the borders of cells: linear votes are whole and continuous, the published ones jump.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace test_voting {
namespace {

using namespace unit;
using ss::Status;

constexpr int radial = 3, elevation = 4, azimuth = 8, bins = 5;

template <class Voting>
using Tested = ss::Descriptor<Voting, ss::Part<ss::SphericalGrid<radial, elevation, azimuth>, ss::ColorDistance<bins>>>;

/// A place in a descriptor, in cells along each axis.
struct Position {
  double r, e, a, signal;
};

/// Colors by index, as numbers: only L differs from the reference, so the distance is L / 300.
struct GivenColors {
  const std::vector<ss::Lab>* lab;
  ss::Lab reference;
  ss::Lab operator()(std::uint32_t index) const { return (*lab)[index]; }
  static ss::Status status() { return ss::Status::ok; }
};

/// The descriptor (radius 1, upright frame) of points at these positions.
template <class Voting>
std::vector<float> describe(const std::vector<Position>& positions) {
  const double pi = std::acos(-1.0);
  TestCloud cloud;
  std::vector<ss::Lab> lab;
  for (const Position& p : positions) {
    const double r = p.r / radial;
    const double theta = p.e / elevation * pi;
    const double phi = p.a / azimuth * 2.0 * pi - pi;
    cloud.add(static_cast<float>(r * std::sin(theta) * std::cos(phi)),
              static_cast<float>(r * std::sin(theta) * std::sin(phi)), static_cast<float>(r * std::cos(theta)));
    lab.push_back({static_cast<float>(300.0 * p.signal / bins), 0.0f, 0.0f});
  }
  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather({0.0f, 0.0f, 0.0f}, 1.0f, n) == Status::ok);
  REQUIRE(n.size == positions.size());
  std::vector<float> out = garbage<Tested<Voting>>();
  const ss::Frame upright{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  REQUIRE(ss::describe<Tested<Voting>>(n, GivenColors{&lab, {0.0f, 0.0f, 0.0f}}, upright, 1.0f, out.data()) ==
          Status::ok);
  return out;
}

/// How far the descriptor of a dozen points moves when one of them steps over each border, or middle, of its cells.
struct Steps {
  double smallest = 10.0;
  double largest = 0.0;
  int taken = 0;
};

template <class Voting>
Steps step_over_borders(double step) {
  std::vector<Position> positions;
  for (int k = 0; k < 12; ++k) {
    const double t = 0.05 + 0.07 * k;
    positions.push_back({radial * t, elevation * (1.0 - t), azimuth * t, bins * 0.3 * t});
  }
  const Position start{1.3, 1.7, 2.2, 0.8};
  double Position::*const axes[] = {&Position::r, &Position::e, &Position::a, &Position::signal};
  const double ends[] = {radial, elevation, azimuth, bins / 3.0 * 0.99};  // L ends at 100, a distance of a third
  Steps steps;
  for (int axis = 0; axis < 4; ++axis) {
    for (double border = 0.5; border < ends[axis]; border += 0.5) {
      Position before = start;
      Position after = start;
      before.*axes[axis] = border - step;
      after.*axes[axis] = border + step;
      positions.push_back(before);
      const std::vector<float> from = describe<Voting>(positions);
      positions.back() = after;
      const double moved = l2_distance(from, describe<Voting>(positions));
      positions.pop_back();
      steps.smallest = std::min(steps.smallest, moved);
      steps.largest = std::max(steps.largest, moved);
      ++steps.taken;
    }
  }
  return steps;
}

/// The unit of votes in these tests.
constexpr ss::extend::VoteUnit unit_of_votes{19, 1 << 19};

std::int32_t first_lane(const ss::extend::simd::I32& value) {
  std::int32_t lanes[ss::extend::simd::lanes];
  ss::extend::simd::store(lanes, value);
  return lanes[0];
}

/// A position in cells along an axis, split.
template <class Voting>
ss::extend::Share split(const ss::extend::Axis& axis, float cells) {
  return Voting::split(axis, ss::extend::simd::all_int(static_cast<std::int32_t>(cells * axis.one())), unit_of_votes);
}

/// The weights of all votes of one point at a position in cells, added up.
template <class Voting, int R, int E, int A, int H>
double sum_of_votes(float r, float e, float a, float h) {
  using Part = ss::Part<ss::SphericalGrid<R, E, A>, ss::ColorDistance<H>>;
  const float position[4] = {r, e, a, h};
  ss::extend::Share shares[4];
  for (int axis = 0; axis < 4; ++axis)
    shares[axis] = split<Voting>(Part::template axes<Part::values>[axis], position[axis]);
  const auto votes = Voting::template combine<4>(Part::template axes<Part::values>, shares, unit_of_votes);
  double sum = 0.0;
  for (const ss::extend::simd::I32& weight : votes.weight) {
    CHECK(first_lane(weight) >= 0);
    sum += first_lane(weight) / static_cast<double>(unit_of_votes.one);
  }
  return sum;
}

template <class Voting, int R, int E, int A, int H>
void check_partition_of_unity(Random& random) {
  for (int k = 0; k < 500; ++k) {
    const auto position = [&random](int cells) {  // the upper ends themselves included
      const float t = random.below(9) == 0 ? 1.0f : random.between(0.0f, 1.0f);
      return t * static_cast<float>(cells);
    };
    const float r = position(R), e = position(E), a = position(A), h = position(H);
    REQUIRE(std::abs(sum_of_votes<Voting, R, E, A, H>(r, e, a, h) - 1.0) < 16 * 0.5 / (1 << 19));  // sixteen roundings
  }
}

}  // namespace

TEST_CASE("voting: multilinear and hard votes of a point add up to 1, wherever it lies") {
  Random random(1);
  check_partition_of_unity<ss::MultilinearVoting, 3, 4, 8, 15>(random);
  check_partition_of_unity<ss::MultilinearVoting, 1, 1, 1, 1>(random);
  check_partition_of_unity<ss::MultilinearVoting, 2, 1, 2, 2>(random);
  check_partition_of_unity<ss::HardVoting, 3, 4, 8, 15>(random);
}

TEST_CASE(
    "voting: published votes of a point add up to 15 in the middle of cells, 10 on their corners, 4 at the ends") {
  const double middle = sum_of_votes<ss::PublishedVoting, 3, 4, 8, 15>(1.5f, 1.5f, 2.5f, 3.5f);
  const double corner = sum_of_votes<ss::PublishedVoting, 3, 4, 8, 15>(1.0f, 1.0f, 2.0f, 3.0f);
  const double end = sum_of_votes<ss::PublishedVoting, 3, 4, 8, 15>(0.0f, 0.0f, 0.0f, 0.0f);
  CHECK(middle == doctest::Approx(4.0 + 3.0 + 3.0 + 3.0 + 2.0));  // four partners of share 0; the quirk flips r too
  CHECK(corner == doctest::Approx(5 * 2.0));
  CHECK(end == doctest::Approx(2 * 2.0));  // only azimuth has a partner
}

TEST_CASE("voting: a point that crosses a border moves a multilinear descriptor as little as it moved itself") {
  const Steps steps = step_over_borders<ss::MultilinearVoting>(1e-6);
  CHECK(steps.taken == 5 + 7 + 15 + 3);
  CHECK(steps.largest < 1e-5);
}

TEST_CASE("voting: a point that crosses a border makes the published descriptor jump, every time") {
  const Steps steps = step_over_borders<ss::PublishedVoting>(1e-6);
  CHECK(steps.smallest > 1e-2);
}

TEST_CASE("voting: a hard vote jumps at cells' borders and rests at their middles") {
  const Steps steps = step_over_borders<ss::HardVoting>(1e-6);
  CHECK(steps.smallest == 0.0);
  CHECK(steps.largest > 0.1);
}

TEST_CASE("voting: a multilinear descriptor is continuous where the azimuth wraps") {
  std::vector<Position> positions{{1.2, 1.1, 3.3, 0.2}, {2.2, 2.4, 6.1, 0.4}, {1.3, 1.7, 1e-6, 0.8}};
  const std::vector<float> behind = describe<ss::MultilinearVoting>(positions);
  positions.back().a = azimuth - 1e-6;
  CHECK(l2_distance(behind, describe<ss::MultilinearVoting>(positions)) < 1e-5);
}

TEST_CASE("voting: phi of exactly +180 degrees is the last cell; its partner is the first one only in linear votes") {
  using Part = ss::Part<ss::SphericalGrid<1, 1, 8>, ss::Occupancy>;
  TestCloud cloud;
  cloud.add(-0.5f, 0.0f, 0.0f);
  Room room(1);
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather({0.0f, 0.0f, 0.0f}, 1.0f, n) == Status::ok);
  const ss::Frame upright{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<float> published(8), linear(8);
  REQUIRE(ss::describe<ss::Descriptor<ss::PublishedVoting, Part>>(n, ss::sources(), upright, 1.0f, published.data()) ==
          Status::ok);
  REQUIRE(ss::describe<ss::Descriptor<ss::MultilinearVoting, Part>>(n, ss::sources(), upright, 1.0f, linear.data()) ==
          Status::ok);
  for (std::size_t cell = 0; cell < 8; ++cell) {
    CHECK((published[cell] > 0.0f) == (cell == 7 || cell == 6));
    CHECK((linear[cell] > 0.0f) == (cell == 7 || cell == 0));
  }
  CHECK(linear[0] == linear[7]);
}

TEST_CASE("voting: the very middle of a cell has the lower neighbor for a partner") {
  constexpr ss::extend::Axis axis{4, 10, ss::extend::Beyond::nothing, ss::extend::BelowZero::never, 27};
  const auto check_rule = [&](auto voting) {
    using Voting = decltype(voting);
    const ss::extend::Share middle = split<Voting>(axis, 1.5f);
    CHECK(first_lane(middle.cell) == 10);
    CHECK(first_lane(middle.step) == -10);
    CHECK(first_lane(middle.twice_partner) == 0);
    const ss::extend::Share above = split<Voting>(axis, std::nextafter(1.5f, 2.0f));
    CHECK(first_lane(above.step) == 10);
  };
  check_rule(ss::PublishedVoting{});
  check_rule(ss::MultilinearVoting{});
}

}  // namespace test_voting
