// CIELAB's powers in integers: as close to the real ones as they say, and the table's own bits where there is no table.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "fixtures.hpp"

namespace test_srgb {
namespace {

using namespace unit;

/// Neighboring floats are 1 apart.
int distance_of(float a, float b) {
  return std::abs(static_cast<int>(ss::extend::math::bits_of(a)) - static_cast<int>(ss::extend::math::bits_of(b)));
}

/// How many of the ratios above the knee have another root than the closest float, and how far off the worst one is.
template <class Rule>
void check_roots(double power, int most) {
  int wrong = 0;
  for (int step = 36; step <= 4000; ++step) {
    const float t = static_cast<float>(step) / 4000.0f;
    const int apart = distance_of(Rule::root(t), static_cast<float>(std::pow(static_cast<double>(t), power)));
    REQUIRE(apart <= 1);
    wrong += apart;
  }
  CHECK(wrong <= most);
  CHECK(Rule::root(1.0f) == 1.0f);
}

}  // namespace

TEST_CASE("srgb: the roots of CIELAB are the closest floats but for a few, and those are the next ones") {
  check_roots<ss::PublishedLab>(0.3333, 18);
  check_roots<ss::CshotLab>(1.0 / 3.0, 18);
}

TEST_CASE("srgb: without the table the gamma is undone to the same bits") {
  int powers = 0;
  for (int byte = 0; byte < 256; ++byte) {
    const float c = static_cast<float>(byte) / 255.0f;
    const float table = ss::detail::srgb_to_linear[static_cast<std::size_t>(byte)];
    CHECK(ss::detail::linear_of_srgb(static_cast<std::uint8_t>(byte)) == table);
    if (c > 0.04045f) {
      CHECK(distance_of(ss::detail::small_srgb_power((c + 0.055f) / 1.055f), table) == 0);
      ++powers;
    }
  }
  CHECK(powers == 245);
}

}  // namespace test_srgb
