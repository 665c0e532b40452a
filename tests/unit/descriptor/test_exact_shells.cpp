// Neighbors on the borders and in the middles of shells, where one bit decides who gets a vote, against the published
// rule (golden README, "Authors' SSH / SCSH"): double, and shells rounded to float once.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "fixtures.hpp"
#include "synthetic_objects.hpp"

namespace test_exact_shells {

using namespace unit;
using ss::Status;

namespace {

constexpr ss::Frame upright{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};

double along(const float (&axis)[3], const ss::Point& p) {
  return static_cast<double>((axis[0] * p.x + axis[2] * p.z) + axis[1] * p.y);
}

/// Which of the shells get votes of a neighbor, by the published rule.
template <std::size_t Shells>
std::array<bool, Shells> published_shells(const ss::Point& p, const ss::Frame& frame, float radius) {
  const double local[] = {along(frame.x, p), along(frame.y, p), along(frame.z, p)};
  const double r = std::sqrt(local[0] * local[0] + local[1] * local[1] + local[2] * local[2]);
  const auto raw = static_cast<float>(static_cast<double>(Shells) * r / static_cast<double>(radius));
  const int shell = std::min(static_cast<int>(raw), static_cast<int>(Shells) - 1);
  const int partner = raw - static_cast<float>(shell) <= 0.5f ? shell - 1 : shell + 1;
  std::array<bool, Shells> shells{};
  for (int i = 0; i < static_cast<int>(Shells); ++i)
    shells.at(static_cast<std::size_t>(i)) = i == shell || i == partner;
  return shells;
}

template <std::size_t First, std::size_t Second>
std::array<bool, First + Second> published_shells_of_two(const ss::Point& p, const ss::Frame& frame, float radius) {
  const auto first = published_shells<First>(p, frame, radius);
  const auto second = published_shells<Second>(p, frame, radius);
  std::array<bool, First + Second> all{};
  std::copy(second.begin(), second.end(), std::copy(first.begin(), first.end(), all.begin()));
  return all;
}

/// Which values of the library's descriptor have votes.
template <class D>
std::array<bool, static_cast<std::size_t>(D::size)> votes_of(const ss::Point& p, const ss::Frame& frame, float radius) {
  TestCloud cloud;
  cloud.add(0.0f, 0.0f, 0.0f);
  cloud.add(p);
  std::array<float, D::size> row{};
  ss::Workspace<16> workspace;
  REQUIRE(ss::describe_at<D>(cloud.view(), ss::BruteSearch{cloud.view()}, 0, frame, ss::Radius(radius), workspace,
                             row.data()) == Status::ok);
  std::array<bool, static_cast<std::size_t>(D::size)> votes{};
  for (std::size_t i = 0; i < votes.size(); ++i) votes.at(i) = row.at(i) > 0.0f;
  return votes;
}

template <int Shells>
using OneGrid = ss::Ssh<ss::SphericalGrid<Shells, 1, 1>>;
template <int First, int Second>
using TwoGrids = ss::Scsh<ss::SphericalGrid<First, 1, 1>, ss::SphericalGrid<Second, 1, 1>, 1>;

/// Neighbors of a lattice at whole multiples of R / (2 shells), in random frames.
template <class Published, class Ours>
void check_lattice(int shells, float radius, Published published, Ours ours) {
  CAPTURE(shells);
  CAPTURE(radius);
  constexpr std::array<std::array<int, 4>, 6> directions{
      {{1, 0, 0, 1}, {3, 4, 0, 5}, {1, 2, 2, 3}, {2, 3, 6, 7}, {4, 4, 7, 9}, {0, 0, 1, 1}}};
  Random random(static_cast<std::uint32_t>(shells));
  std::size_t others = 0;
  constexpr std::size_t tries = 3000;
  for (std::size_t k = 0; k < tries; ++k) {
    const auto& [x, y, z, length] = directions.at(random.below(directions.size()));
    const auto multiple = 1.0 + static_cast<double>(random.below(2 * static_cast<std::size_t>(shells) - 1));
    const double scale = static_cast<double>(radius) * multiple / (2 * shells) / length;
    const ss::Point p{static_cast<float>(scale * x), static_cast<float>(scale * y), static_cast<float>(scale * z)};
    const ss::Frame frame = random_motion(random)(upright);
    others += published(p, frame, radius) != ours(p, frame, radius) ? 1U : 0U;
  }
  CHECK(others <= tries / 1000);  // double has a few bits more than two floats
}

template <int Shells>
void check_one_grid(float radius) {
  check_lattice(Shells, radius, published_shells<Shells>, votes_of<OneGrid<Shells>>);
}

template <int First, int Second>
void check_two_grids(int multiple, float radius) {
  check_lattice(multiple, radius, published_shells_of_two<First, Second>, votes_of<TwoGrids<First, Second>>);
}

}  // namespace

TEST_CASE("exact shells: neighbors on a lattice vote as in the published code, for any radius and number of shells") {
  for (const float radius : {0.5f, 0.15f, 0.06f, 37.0f}) {
    check_one_grid<2>(radius);
    check_one_grid<3>(radius);
    check_one_grid<4>(radius);
    check_one_grid<5>(radius);
    check_one_grid<6>(radius);
    check_one_grid<8>(radius);
  }
}

TEST_CASE("exact shells: each of two grids with unlike numbers of shells rounds by itself") {
  for (const float radius : {0.5f, 0.15f, 0.06f, 37.0f}) {
    check_two_grids<3, 2>(6, radius);
    check_two_grids<3, 1>(3, radius);
    check_two_grids<4, 2>(4, radius);
    check_two_grids<5, 2>(10, radius);
  }
}

TEST_CASE("exact shells: in the middle of the second of three, a frame's rounding makes the outer one the partner") {
  const ss::Frame frame{{0x1.62235cp-2f, 0x1.ce3d2ep-1f, -0x1.05bafcp-2f},
                        {-0x1.b169bep-1f, 0x1.abbd18p-2f, 0x1.51fa06p-2f},
                        {0x1.9e750cp-2f, 0x1.a2b04ep-4f, 0x1.d14104p-1f}};
  const ss::Point p{0.25f, 0.0f, 0.0f};
  const std::array<bool, 3> outer{false, true, true};
  REQUIRE(published_shells<3>(p, frame, 0.5f) == outer);
  CHECK(votes_of<OneGrid<3>>(p, frame, 0.5f) == outer);
}

TEST_CASE("exact shells: a frame that is not orthonormal moves no neighbor from shell to shell") {
  const ss::Frame stretched{{1.0002f, 0.0f, 0.0f}, {0.0f, 1.0002f, 0.0f}, {0.0f, 0.0f, 1.0002f}};
  const std::array<bool, 3> inner{true, true, false};
  CHECK(votes_of<OneGrid<3>>({0.25f, 0.0f, 0.0f}, stretched, 0.5f) == inner);
}

}  // namespace test_exact_shells
