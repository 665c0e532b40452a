// CIELAB and the color distance, against the published tables.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"
#include "oracle.hpp"

namespace test_color {
namespace {

using namespace unit;

template <class Rule>
double worst_deviation(oracle::LabRule rule) {
  double worst = 0.0;
  for (const ss::Rgb& c : many_colors()) {
    const ss::Lab ours = ss::to_lab<Rule>(c);
    const auto expected = oracle::lab({c.r, c.g, c.b}, rule);
    const double deviation = std::max({std::abs(static_cast<double>(ours.L) - expected[0]),
                                       std::abs(static_cast<double>(ours.a) - expected[1]),
                                       std::abs(static_cast<double>(ours.b) - expected[2])});
    worst = std::max(worst, std::isnan(deviation) ? 1e9 : deviation);
  }
  return worst;
}

}  // namespace

TEST_CASE("color: Lab within the promised 1e-3 of the published tables, on any color") {
  // One step of the 4,000-entry table is up to 0.1 in L and 0.5 in a: no color may fall into another step.
  CHECK(worst_deviation<ss::PublishedLab>(oracle::LabRule::published) < 1e-3);
  CHECK(worst_deviation<ss::CshotLab>(oracle::LabRule::pcl) < 1e-3);
}

TEST_CASE("color: the table of linear values is the published one to the last bit") {
  for (std::size_t v = 0; v < 256; ++v) {
    const float c = static_cast<float>(v) / 255.0f;
    const auto base = static_cast<double>((c + 0.055f) / 1.055f);
    const float power = static_cast<float>(std::pow(base, static_cast<double>(2.4f)));
    CHECK(ss::detail::srgb_to_linear[v] == (c > 0.04045f ? power : c / 12.92f));
  }
}

TEST_CASE("color: the two rules are not the same") {
  CHECK(worst_deviation<ss::PublishedLab>(oracle::LabRule::pcl) > 0.1);
  CHECK(worst_deviation<ss::CshotLab>(oracle::LabRule::published) > 0.1);
}

TEST_CASE("color: white is defined, though it lies beyond the end of the published table") {
  const ss::Lab white = ss::to_lab<ss::PublishedLab>({255, 255, 255});
  CHECK(white.L == 100.0f);
  CHECK(std::abs(white.a) < 0.1f);  // X and Z of white fall one step short of the table's end, Y does not
  CHECK(std::abs(white.b) < 0.1f);
  const ss::Lab nearly = ss::to_lab<ss::PublishedLab>({254, 254, 254});
  CHECK(nearly.L < white.L);
  CHECK(ss::color_distance(white, nearly) < 0.01f);
}

TEST_CASE("color: PCL's white is what PCL reads there, and no other color differs from the corrected rule") {
  const ss::Lab white = ss::to_lab<ss::PclLab>({255, 255, 255});
  CHECK(white.L == -16.0f);
  CHECK(white.a == 120.0f);
  CHECK(white.b == -120.0f);
  for (int i = 0; i < (1 << 24) - 1; i += 37) {
    const ss::Rgb c{static_cast<std::uint8_t>(i >> 16), static_cast<std::uint8_t>(i >> 8),
                    static_cast<std::uint8_t>(i)};
    const ss::Lab pcl = ss::to_lab<ss::PclLab>(c);
    const ss::Lab corrected = ss::to_lab<ss::CshotLab>(c);
    if (pcl.L != corrected.L || pcl.a != corrected.a || pcl.b != corrected.b) FAIL(i);
  }
}

TEST_CASE("color: black is 0, 0, 0 but for the rounding of 16 / 116") {
  for (const ss::Lab& black : {ss::to_lab<ss::PublishedLab>({0, 0, 0}), ss::to_lab<ss::PclLab>({0, 0, 0})}) {
    CHECK(std::abs(black.L) < 1e-5f);
    CHECK(black.a == 0.0f);
    CHECK(black.b == 0.0f);
  }
}

TEST_CASE("color: grays get lighter from black to white") {
  float last = -1.0f;
  for (int v = 0; v < 256; ++v) {
    const auto gray = static_cast<std::uint8_t>(v);
    const float lightness = ss::to_lab<ss::PublishedLab>({gray, gray, gray}).L;
    CHECK(lightness >= last);
    last = lightness;
  }
}

TEST_CASE("color: the distance is the oracle's, symmetric, 0 for equal colors and within 0..1") {
  Random random(2);
  for (int k = 0; k < 5000; ++k) {
    const ss::Rgb p{random.byte(), random.byte(), random.byte()};
    const ss::Rgb q{random.byte(), random.byte(), random.byte()};
    const ss::Lab lab_p = ss::to_lab<ss::PublishedLab>(p);
    const ss::Lab lab_q = ss::to_lab<ss::PublishedLab>(q);
    const float distance = ss::color_distance(lab_p, lab_q);
    const double expected = oracle::color_distance(oracle::lab({p.r, p.g, p.b}, oracle::LabRule::published),
                                                   oracle::lab({q.r, q.g, q.b}, oracle::LabRule::published));
    REQUIRE(std::abs(static_cast<double>(distance) - expected) < 1e-6);
    REQUIRE(ss::color_distance(lab_q, lab_p) == distance);
    REQUIRE(ss::color_distance(lab_p, lab_p) == 0.0f);
    REQUIRE(distance >= 0.0f);
  }
  CHECK(ss::color_distance({0.0f, -120.0f, -120.0f}, {100.0f, 120.0f, 120.0f}) == 1.0f);
}

TEST_CASE("color: the largest distance of sRGB colors is that of pure green and pure blue") {
  const ss::Lab green = ss::to_lab<ss::PublishedLab>({0, 255, 0});
  const ss::Lab blue = ss::to_lab<ss::PublishedLab>({0, 0, 255});
  CHECK(ss::color_distance(green, blue) == doctest::Approx(0.6802).epsilon(1e-3));
  std::vector<ss::Lab> corners;
  for (int k = 0; k < 729; ++k) {
    const auto level = [](int step) { return static_cast<std::uint8_t>(std::min(255, 32 * step)); };
    corners.push_back(ss::to_lab<ss::PublishedLab>({level(k % 9), level(k / 9 % 9), level(k / 81)}));
  }
  float largest = 0.0f;
  for (const ss::Lab& p : corners) {
    for (const ss::Lab& q : corners) largest = std::max(largest, ss::color_distance(p, q));
  }
  CHECK(largest == ss::color_distance(green, blue));
}

TEST_CASE("color: a cloud's colors converted at once are those converted one by one") {
  const TestCloud cloud = curved_surface(3, 100);
  std::vector<ss::Lab> lab(cloud.size());
  REQUIRE(ss::convert_colors<ss::PclLab>(cloud.view(), lab.data()) == ss::Status::ok);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const ss::Lab one = ss::to_lab<ss::PclLab>(cloud.color_at(i));
    CHECK(lab[i].L == one.L);
    CHECK(lab[i].a == one.a);
    CHECK(lab[i].b == one.b);
  }
}

}  // namespace test_color
