// match: objects that are there from all sides.

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "tools/io/view_of_cloud.hpp"
#include "tools/match/match.hpp"

namespace test_match_whole {
namespace {

using namespace shortshot_bench;

/// A colored surface around 0 0 0, as big as a fist, of points 2 mm apart.
RgbdCloud bumpy_ball() {
  constexpr std::size_t count = 30000;
  RgbdCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {  // a spiral from pole to pole
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / count, turn = 2.399963 * static_cast<double>(i);
    const double x = std::sqrt(1.0 - z * z) * std::cos(turn), y = std::sqrt(1.0 - z * z) * std::sin(turn);
    const double radius = 0.1 * (1.0 + 0.1 * std::sin(5.0 * x + 3.0 * y * z) + 0.07 * std::sin(7.0 * y - 4.0 * z));
    for (const double axis : {x, y, z}) cloud.xyz.push_back(static_cast<float>(radius * axis));
    for (const double wave : {9.0 * x + y, 8.0 * y - 3.0 * z, 11.0 * z + 2.0 * x * y}) {
      cloud.rgb.push_back(static_cast<std::uint8_t>(128.0 + 100.0 * std::sin(wave)));
    }
  }
  return cloud;
}

/// What a camera 0.6 m above it sees, in coordinates turned by a right angle, with the camera at 0 0 0.
RgbdCloud seen_from_above(const RgbdCloud& whole) {
  RgbdCloud view;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const float* const p = &whole.xyz[3 * i];
    if (p[2] < 0.03f) continue;
    view.xyz.insert(view.xyz.end(), {-p[1], p[0], p[2] - 0.6f});
    view.rgb.insert(view.rgb.end(), &whole.rgb[3 * i], &whole.rgb[3 * i] + 3);
  }
  return view;
}

}  // namespace

TEST_CASE("match: a view of an object is found in the whole of it, whose frames look outwards") {
  RgbdCloud whole = bumpy_ball();
  CHECK(surrounds_its_viewpoint(whole));
  const RgbdCloud view = seen_from_above(whole);
  CHECK_FALSE(surrounds_its_viewpoint(view));
  const std::size_t inwards = match_clouds(whole, view, {}).inliers.size();
  whole.is_whole = true;
  const MatchResult result = match_clouds(whole, view, {});
  CHECK(result.is_found);
  CHECK(result.inliers.size() > 4 * inwards);
  CHECK(degrees_of(result.pose) == doctest::Approx(90.0).epsilon(0.02));
}

}  // namespace test_match_whole
