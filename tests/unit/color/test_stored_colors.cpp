// Colors converted once for a whole cloud: by a table of roots, and kept in 12 bytes or in 4.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "fixtures.hpp"

namespace test_stored_colors {
namespace {

using namespace unit;
using ss::Status;
using D = ss::Scsh336;

static_assert(sizeof(ss::PackedLab) == 4 && std::is_trivial<ss::PackedLab>::value, "for arrays in firmware");

constexpr double stated_error = 2.9e-4;  // of the color distance, by packing
constexpr float radius = 0.05f;

bool same_bits(const ss::Lab& a, const ss::Lab& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// many_colors(), and every fourth level of each byte, up to 255: 274,625 colors.
std::vector<ss::Rgb> dense_colors() {
  std::vector<ss::Rgb> colors = many_colors();
  const auto level = [](int step) { return static_cast<std::uint8_t>(std::min(255, 4 * step)); };
  for (int k = 0; k < 65 * 65 * 65; ++k) colors.push_back({level(k % 65), level(k / 65 % 65), level(k / 4225)});
  return colors;
}

template <class Rule>
void check_table() {
  ss::LabTable<Rule> table;
  table.fill();
  table.fill();  // once is enough, twice no harm
  for (const ss::Rgb& c : dense_colors()) REQUIRE(same_bits(table(c), ss::to_lab<Rule>(c)));
}

double error(const ss::Lab& reference, const ss::Lab& exact, const ss::Lab& packed) {
  return std::abs(static_cast<double>(ss::color_distance(packed, reference)) -
                  static_cast<double>(ss::color_distance(exact, reference)));
}

/// Largest error of the distance to black, white and the corners of a cube in Lab around it.
template <class Rule>
double worst_error() {
  ss::LabTable<Rule> table;
  table.fill();
  double worst = 0.0;
  for (const ss::Rgb& c : dense_colors()) {
    const ss::Lab exact = table(c);
    const ss::Lab packed = ss::PackedLab(exact);
    for (int corner = 0; corner < 8; ++corner) {
      const auto side = [corner](int bit) { return (corner >> bit & 1) != 0 ? 1.0f : -1.0f; };
      const ss::Lab reference{exact.L + side(0), exact.a + side(1), exact.b + side(2)};
      worst = std::max(worst, error(reference, exact, packed));
    }
    worst = std::max(worst, std::max(error({0, 0, 0}, exact, packed), error({100, 0, 0}, exact, packed)));
  }
  return worst;
}

}  // namespace

TEST_CASE("stored colors: the table gives the bits that to_lab() computes, white included") {
  check_table<ss::PublishedLab>();
  check_table<ss::CshotLab>();
  check_table<ss::PclLab>();
}

TEST_CASE("stored colors: packing changes the color distance by no more than stated, and by nearly that much") {
  for (const double worst : {worst_error<ss::PublishedLab>(), worst_error<ss::CshotLab>()}) {
    CHECK(worst <= stated_error);
    CHECK(worst > 0.9 * stated_error);
  }
}

TEST_CASE("stored colors: packing keeps black, white and neutral exactly, and what was packed before") {
  for (const float lightness : {0.0f, 50.0f, 100.0f}) {
    const ss::Lab neutral{lightness, 0.0f, 0.0f};
    CHECK(same_bits(ss::PackedLab(neutral), neutral));
  }
  for (const ss::Rgb& c : many_colors()) {
    const ss::Lab once = ss::PackedLab(ss::to_lab<ss::PublishedLab>(c));
    REQUIRE(same_bits(ss::PackedLab(once), once));
  }
}

TEST_CASE("stored colors: registers of colors have the bits of single ones") {
  std::vector<ss::Lab> exact;
  for (const ss::Rgb& c : many_colors()) exact.push_back(ss::to_lab<ss::PublishedLab>(c));
  const std::vector<ss::PackedLab> packed(exact.begin(), exact.end());
  const ss::LabColors labs{exact.data(), {}};
  const ss::PackedColors packed_labs{packed.data(), {}};
  const auto check = [](const auto& colors, const std::uint32_t* index) {
    const ss::extend::LabLanes lanes = ss::extend::colors_at(colors, index);
    float L[ss::extend::simd::lanes], a[ss::extend::simd::lanes], b[ss::extend::simd::lanes];
    ss::extend::simd::store(L, lanes.L);
    ss::extend::simd::store(a, lanes.a);
    ss::extend::simd::store(b, lanes.b);
    for (std::size_t k = 0; k < ss::extend::simd::lanes; ++k) REQUIRE(same_bits({L[k], a[k], b[k]}, colors(index[k])));
  };
  Random random(5);
  for (int repeat = 0; repeat < 1000; ++repeat) {
    std::uint32_t index[ss::extend::simd::lanes];
    for (std::uint32_t& i : index) i = static_cast<std::uint32_t>(random.below(exact.size()));
    check(labs, index);
    check(packed_labs, index);
  }
}

TEST_CASE("stored colors: what no sRGB color is, is clamped") {
  const ss::Lab most = ss::PackedLab({1e9f, infinity, 120.0f});
  CHECK(most.L == 100.0f);
  CHECK((most.a > 98.3f && most.a < 120.0f));
  CHECK((most.b > 94.6f && most.b < 120.0f));
  const ss::Lab least = ss::PackedLab({-1.0f, -infinity, -120.0f});
  CHECK(least.L == 0.0f);
  CHECK((least.a < -86.3f && least.a > -120.0f));
  CHECK((least.b < -108.0f && least.b > -120.0f));
  CHECK(same_bits(ss::PackedLab({not_a_number, not_a_number, not_a_number}), least));
}

TEST_CASE("stored colors: describe() takes packed colors, with the bits that extract() gets from them") {
  const TestCloud cloud = curved_surface(21, 1500);
  std::vector<ss::PackedLab> packed(cloud.size());
  REQUIRE(ss::convert_colors<ss::PublishedLab>(cloud.view(), packed.data()) == Status::ok);
  const ss::GridSearch grid(cloud.view(), radius);
  ss::Extractor<D, ss::PackedLab> extractor;
  ss::Features<D> features;
  REQUIRE(extractor.extract(cloud.view(), grid, std::vector<std::uint32_t>{7}, radius, features) == Status::ok);

  Room room(cloud.size());
  ss::Neighborhood n = room.neighborhood();
  REQUIRE(grid.gather(cloud.at(7), radius, n) == Status::ok);
  ss::Frame frame;
  REQUIRE(ss::estimate_frame(n, radius, frame) == Status::ok);
  const ss::Lab reference = ss::to_lab<ss::PublishedLab>(cloud.color_at(7));
  std::vector<float> out = garbage<D>();
  REQUIRE(ss::describe<D>(n, ss::PackedColors{packed.data(), reference}, frame, radius, out.data()) == Status::ok);
  CHECK(unit::same_bits(out, features.values));
  CHECK(ss::describe<D>(n, ss::PackedColors{nullptr, reference}, frame, radius, out.data()) == Status::missing_colors);
  CHECK(all_zero(out));
}

TEST_CASE("stored colors: converting into an array needs a cloud with colors") {
  const TestCloud cloud = curved_surface(22, 10);
  std::vector<ss::PackedLab> packed(cloud.size());
  CHECK(ss::convert_colors<ss::PclLab>(ss::view_xyz(cloud.xyz.data(), 10), packed.data()) == Status::missing_colors);
  CHECK(ss::convert_colors<ss::PclLab>(ss::CloudView{}, packed.data()) == Status::empty_cloud);
}

}  // namespace test_stored_colors
