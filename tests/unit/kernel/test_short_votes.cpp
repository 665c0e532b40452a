// Votes with indices of 16 bits, two registers of neighbors at a time, are those with indices of 32 bits: a chunk of
// one register takes the latter. For rules, grids and conventions of all kinds, and neighbors on every border of a
// cell.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "fixtures.hpp"

namespace test_short_votes {
namespace {

using namespace unit;
using ss::Status;

constexpr std::uint32_t lanes = static_cast<std::uint32_t>(ss::extend::simd::lanes);

template <class D, std::uint32_t ChunkSize = ss::default_chunk_size>
constexpr bool has_short_votes = ss::detail::short_sums<ChunkSize>(D{}) > 0;

constexpr bool where_there_are_lanes = lanes > 1 && !ss::detail::small_code;
static_assert(has_short_votes<ss::Ssh32> == where_there_are_lanes);
static_assert(has_short_votes<ss::Scsh336> == where_there_are_lanes);
static_assert(has_short_votes<ss::Cshot1344> == where_there_are_lanes);
static_assert(has_short_votes<ss::Scsh336, 2 * lanes> == where_there_are_lanes, "any multiple of two registers");
static_assert(!has_short_votes<ss::Scsh336, lanes> && !has_short_votes<ss::Scsh336, 3 * lanes>);
static_assert(!has_short_votes<ss::PclCshot1344>, "a vote that wraps goes elsewhere");
static_assert(!has_short_votes<ss::Ssh<ss::SphericalGrid<3, 4, 8>, ss::HardVoting>>);
static_assert(!has_short_votes<ss::Ssh<ss::SphericalGrid<3, 4, 8>, ss::MultilinearVoting>>);
static_assert(!has_short_votes<ss::ShapeColor95>);
using ss::SphericalGrid;
using Largest = ss::Ssh<SphericalGrid<2, 16, 1000>>;  // and a stride of 32 behind the end
static_assert(has_short_votes<Largest> == where_there_are_lanes);
using TooLarge = ss::Ssh<SphericalGrid<1, 512, 64>>;
static_assert(!has_short_votes<TooLarge>, "more than 16 bits of indices");

/// Neighbors all over the support, and on the borders and in the middles of cells: on the frame's axes, in its planes,
/// on shells, at the very end of the azimuth, and on the surface of the support.
struct Neighbors {
  Room room{600};
  ss::Neighborhood n = room.neighborhood();
  std::vector<ss::Lab> colors;
  std::vector<ss::SurfaceNormal> normals;

  explicit Neighbors(std::uint32_t seed, std::uint32_t count) {
    Random random(seed);
    const float special[] = {0.0f, -0.0f, 0.5f, -0.5f, 0.25f, -0.25f, 1.0f / 3.0f, 0.99f, -0.99f, 1e-6f};
    const auto coordinate = [&] {
      return random.between(0.0f, 1.0f) < 0.4f ? special[static_cast<int>(random.between(0.0f, 9.99f))]
                                               : random.between(-0.6f, 0.6f);
    };
    while (n.size < count) {
      const float x = coordinate(), y = coordinate(), z = coordinate();
      n.dx[n.size] = x;
      n.dy[n.size] = y;
      n.dz[n.size] = z;
      n.d2[n.size] = x * x + y * y + z * z;
      n.index[n.size] = n.size;
      ++n.size;
      const auto steps = [&] { return std::floor(random.between(0.0f, 5.0f)) * 25.0f; };
      colors.push_back({steps(), steps(), steps()});
      normals.push_back(n.size % 3 == 0 ? ss::SurfaceNormal{0.0f, 0.0f, n.size % 2 == 0 ? 1.0f : -1.0f}
                                        : unit_normal(coordinate(), coordinate(), random.between(0.1f, 1.0f)));
    }
    n.found = n.size;
  }
};

/// The same bits with and without, and nothing written behind the values.
template <class D>
void check(const Neighbors& all, std::uint32_t size) {
  CAPTURE(ss::layout_of<D>());
  CAPTURE(size);
  constexpr auto count = static_cast<std::size_t>(D::size);
  const ss::Frame frame{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  ss::Neighborhood n = all.n;
  n.size = n.found = size;
  ss::CloudView cloud{};
  cloud.size = all.normals.size();
  cloud = ss::with_normals(cloud, all.normals.data());
  const auto sources = ss::sources(ss::LabColors{all.colors.data(), all.colors[0]}, ss::CloudNormals{cloud});
  std::vector<float> shorts(count + 8, -7.0f), integers = shorts, two_registers = shorts;
  const Status status = ss::describe<D>(n, sources, frame, 1.0f, shorts.data());
  CHECK(ss::describe<D, lanes>(n, sources, frame, 1.0f, integers.data()) == status);
  CHECK(ss::describe<D, 2 * lanes>(n, sources, frame, 1.0f, two_registers.data()) == status);
  CHECK(same_bits(shorts, integers));
  CHECK(same_bits(shorts, two_registers));
  for (std::size_t k = count; k < shorts.size(); ++k) CHECK(shorts[k] == -7.0f);
}

template <class... D>
void check_all() {
  for (const std::uint32_t seed : {1u, 2u}) {
    const Neighbors all(seed, 600);
    for (const std::uint32_t size : {0u, 1u, 2u, 5u, 7u, 8u, 9u, 15u, 16u, 17u, 95u, 97u, 127u, 128u, 129u, 300u, 600u})
      (check<D>(all, size), ...);
  }
}

template <class Grid, class Voting, class Scale = ss::LinearRadius>
using ShotShape = ss::Descriptor<Voting, ss::Part<Grid, ss::Occupancy, Scale, ss::ShotCells>>;
template <class ShapeGrid, class ColorGrid, class Scale = ss::LinearRadius>
using Mixed = ss::Descriptor<ss::ShotVoting, ss::Part<ShapeGrid, ss::NormalCosine<4>, Scale, ss::ShotCells>,
                             ss::Part<ColorGrid, ss::ColorDistance<3, ss::PublishedLab>, Scale, ss::ShotCells>>;

}  // namespace

TEST_CASE("short votes: the same bits in the published cells") {
  check_all<ss::Ssh32, ss::Ssh96, ss::Scsh336, ss::Scsh<SphericalGrid<2, 2, 6>, SphericalGrid<2, 2, 6>, 25>,
            ss::Ssh<SphericalGrid<3, 4, 8>, ss::AdditiveVoting<false>>,
            ss::Scsh<SphericalGrid<3, 4, 5>, SphericalGrid<2, 3, 7>, 4, ss::ShotVoting>>();
}

TEST_CASE("short votes: the same bits in SHOT's cells") {
  check_all<ss::Shot352, Mixed<SphericalGrid<2, 2, 8>, SphericalGrid<2, 2, 8>>,
            Mixed<SphericalGrid<3, 2, 5>, SphericalGrid<2, 3, 4>>,
            ShotShape<SphericalGrid<3, 4, 6>, ss::PublishedVoting>,
            ShotShape<SphericalGrid<3, 4, 6>, ss::ShotVoting>>();
}

TEST_CASE("short votes: the same bits of axes with one cell or two, and without a beginning") {
  check_all<ss::Scsh<SphericalGrid<1, 1, 1>, SphericalGrid<2, 1, 2>, 1>,
            ss::Scsh<SphericalGrid<1, 2, 1>, SphericalGrid<1, 1, 3>, 2>,
            Mixed<SphericalGrid<1, 1, 1>, SphericalGrid<1, 2, 2>>,
            ss::Ssh<SphericalGrid<3, 4, 8>, ss::PublishedVoting, ss::LogRadius<>>,
            ss::Ssh<SphericalGrid<3, 4, 7>, ss::ShotVoting, ss::LogRadius<>>,
            Mixed<SphericalGrid<2, 2, 8>, SphericalGrid<3, 2, 8>, ss::LogRadius<1, 10>>>();
}

TEST_CASE("short votes: the same bits of descriptors as large as they may be, and larger") {
  const Neighbors all(3, 600);
  check<Largest>(all, 600);
  check<TooLarge>(all, 600);
}

TEST_CASE("short votes: sums of its own are no excuse, an output is zeroed where there is no descriptor") {
  const Neighbors all(4, 20);
  const ss::Frame frame{{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  const auto refuses = [&](float radius, const ss::Frame& used, std::uint32_t size, const ss::Lab* lab,
                           Status expected) {
    ss::Neighborhood n = all.n;
    n.size = size;
    std::vector<float> out = garbage<ss::Scsh336>();
    CHECK(ss::describe<ss::Scsh336>(n, ss::LabColors{lab, {}}, used, radius, out.data()) == expected);
    CHECK(all_zero(out));
  };
  refuses(-1.0f, frame, 20, all.colors.data(), Status::bad_radius);
  refuses(1.0f, ss::Frame{}, 20, all.colors.data(), Status::bad_frame);
  refuses(1.0f, frame, 20, nullptr, Status::missing_colors);
  refuses(1.0f, frame, 0, all.colors.data(), Status::too_few_neighbors);
  refuses(1e-12f, frame, 20, all.colors.data(), Status::too_few_neighbors);
}

}  // namespace test_short_votes
