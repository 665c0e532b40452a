// What is known before a program runs: sizes, offsets, layouts, and types that are plain memory.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "fixtures.hpp"

namespace test_descriptor_types {
namespace {

namespace ss = shortshot;

template <int R, int E, int A>
using Grid = ss::SphericalGrid<R, E, A>;

// The paper's sizes, and a configuration of one's own.
static_assert(ss::Ssh32::size == 32 && ss::Ssh32::size_bytes == 128, "2 x 2 x 8");
static_assert(ss::Ssh96::size == 96 && ss::Ssh96::size_bytes == 384, "3 x 4 x 8");
static_assert(ss::Scsh336::size == 96 + 16 * 15 && ss::Scsh336::size_bytes == 4 * 336, "3 x 4 x 8 + 2 x 2 x 4 x 15");
static_assert(ss::Scsh696::size == 96 + 24 * 25 && ss::Scsh696::size_bytes == 4 * 696, "3 x 4 x 8 + 2 x 2 x 6 x 25");
static_assert(ss::Ssh<Grid<1, 1, 1>>::size == 1, "one cell");
static_assert(ss::Scsh<Grid<5, 7, 9>, Grid<1, 2, 3>, 4>::size == 315 + 24, "any grids");
static_assert(!ss::Ssh96::needs_colors && ss::Scsh336::needs_colors, "only SCSH looks at colors");

// Parts lie one after the other.
static_assert(ss::Scsh336::parts == 2, "shape and color");
static_assert(ss::Scsh336::offset(0) == 0 && ss::Scsh336::offset(1) == 96 && ss::Scsh336::offset(2) == 336, "in order");

// Within a part: histogram bin fastest, then radius, elevation, azimuth.
using Color = ss::Part<Grid<2, 3, 4>, ss::ColorDistance<5>>;
static_assert(Color::size == 2 * 3 * 4 * 5, "bins times cells");
static_assert(Color::index(0, 0, 0, 0) == 0 && Color::index(0, 0, 0, 1) == 1, "bin");
static_assert(Color::index(1, 0, 0) == 5 && Color::index(0, 1, 0) == 10 && Color::index(0, 0, 1) == 30, "r, e, a");
static_assert(Color::index(1, 2, 3, 4) == Color::size - 1, "the last value");
using Shape = ss::Part<Grid<2, 3, 4>, ss::Occupancy>;
static_assert(Shape::size == 24 && Shape::index(1, 2, 3) == 23 && Shape::index(0, 1, 0) == 2, "no histogram");
static_assert(!Shape::has_histogram && Color::has_histogram, "a plain sum, a histogram");
static_assert(ss::Part<Grid<1, 1, 1>, ss::ColorDistance<1>>::has_histogram, "of one bin");

// Plain memory: no constructors, no padding surprises, nothing that asks for more alignment than its members.
template <class T>
constexpr bool is_plain = std::is_trivial<T>::value&& std::is_standard_layout<T>::value;
static_assert(is_plain<ss::Workspace<100>> && is_plain<ss::CloudView> && is_plain<ss::Frame>, "memory");
static_assert(is_plain<ss::Neighborhood> && is_plain<ss::KeyPoint> && is_plain<ss::Lab> && is_plain<ss::Point>,
              "memory");
// Not trivial, on purpose: a support without a radius, or a search without a cloud, would be made of garbage.
static_assert(std::is_trivially_copyable<ss::Radius>::value && std::is_trivially_copyable<ss::Support>::value &&
                  std::is_trivially_copyable<ss::BruteSearch>::value,
              "memory");
static_assert(!std::is_default_constructible<ss::Radius>::value, "a radius has a value");
static_assert(!std::is_default_constructible<ss::Support>::value, "a support has a radius");
static_assert(std::is_trivial<ss::GridIndex<std::uint16_t>>::value && std::is_trivial<ss::GridIndex<>>::value,
              "memory");
static_assert(std::is_trivial<ss::StaticGrid<10, 10>>::value && std::is_trivial<ss::OrganizedSearch>::value, "memory");
static_assert(std::is_empty<ss::Scsh336>::value, "a descriptor type is no data");

static_assert(alignof(ss::Frame) == 4 && alignof(ss::Lab) == 4 && alignof(ss::Point) == 4, "floats");
static_assert(alignof(ss::Workspace<100>) == 4 && alignof(ss::Radius) == 4 && alignof(ss::KeyPoint) == 4, "floats");
static_assert(alignof(ss::CloudView) == alignof(void*) && alignof(ss::Neighborhood) == alignof(void*), "pointers");
static_assert(alignof(ss::Support) == 4 && alignof(ss::Viewpoint) == 4, "floats");
static_assert(alignof(ss::GridIndex<>) == alignof(void*), "pointers");

static_assert(sizeof(ss::Workspace<100>) == 2000 && sizeof(ss::Workspace<5>) == 100, "20 bytes a neighbor");
static_assert(sizeof(ss::Frame) == 36 && sizeof(ss::Lab) == 12 && sizeof(ss::Rgb) == 3, "no padding");

// 2 bytes a point and a cell up to 65,535 points, then 4; the rest is the index itself.
template <std::size_t Points, std::size_t Cells>
constexpr std::size_t memory_of = sizeof(ss::StaticGrid<Points, Cells>) - sizeof(ss::StaticGrid<1, 1>);
static_assert(std::is_same<ss::StaticGrid<65535, 1>::Index, std::uint16_t>::value, "16 bits suffice");
static_assert(std::is_same<ss::StaticGrid<65536, 1>::Index, std::uint32_t>::value, "16 bits do not");
static_assert(memory_of<1025, 513> == 2 * (1024 + 512), "2 bytes each");

static_assert(std::is_same<std::underlying_type_t<ss::Status>, std::uint8_t>::value, "one byte a key point");
static_assert(static_cast<int>(ss::Status::ok) == 0, "zeroed memory says ok");
static_assert(std::is_copy_constructible<ss::GridSearch>::value, "its memory goes along");
static_assert(!std::is_copy_constructible<ss::NanoflannSearch>::value, "its tree refers to itself");

}  // namespace

TEST_CASE("descriptor types: every value has exactly one index") {
  bool seen[Color::size] = {};
  for (int a = 0; a < 4; ++a) {
    for (int e = 0; e < 3; ++e) {
      for (int r = 0; r < 2; ++r) {
        for (int bin = 0; bin < 5; ++bin) {
          const int index = Color::index(r, e, a, bin);
          REQUIRE(index >= 0);
          REQUIRE(index < Color::size);
          CHECK(!seen[index]);
          seen[index] = true;
        }
      }
    }
  }
}

TEST_CASE("descriptor types: a value's index says where the point lies, bin, shell, elevation and azimuth") {
  // One red point: outer shell, upper half, azimuth 45 degrees past +x, against a black key point.
  unit::TestCloud cloud;
  cloud.add(0.4f, 0.4f, 0.3f, {255, 0, 0});
  unit::Room room(1);
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(ss::BruteSearch{cloud.view()}.gather({0.0f, 0.0f, 0.0f}, 1.0f, n) == ss::Status::ok);
  using D = ss::Scsh<Grid<2, 3, 4>, Grid<2, 3, 4>, 5, ss::HardVoting>;
  std::vector<float> out = unit::garbage<D>();
  const ss::Frame upright{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const ss::RgbColors<D::LabRule> colors{cloud.view(), {0, 0, 0}};
  REQUIRE(ss::describe<D>(n, colors, upright, 1.0f, out.data()) == ss::Status::ok);
  // r = 0.64: shell 1 of 2. theta = 62 degrees: cell 1 of 3. phi = 45: cell 2 of 4. Distance 0.38: bin 1 of 5.
  for (int i = 0; i < D::size; ++i) {
    const bool hit = i == Shape::index(1, 1, 2) || i == D::offset(1) + Color::index(1, 1, 2, 1);
    CHECK((out[static_cast<std::size_t>(i)] > 0.0f) == hit);
  }
}

}  // namespace test_descriptor_types
