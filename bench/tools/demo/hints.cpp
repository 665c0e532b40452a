#include "tools/demo/hints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "shortshot/status.hpp"

namespace shortshot_bench {
namespace {

std::array<double, 3> extent_of(const RgbdCloud& cloud) {
  std::array<double, 3> extent{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = axis; i < cloud.xyz.size(); i += 3) {
      const auto value = static_cast<double>(cloud.xyz[i]);
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    extent[axis] = std::max(most - least, 0.0);
  }
  return extent;
}

}  // namespace

std::string hint_at_units(const RgbdCloud& cloud, const DemoOptions& options, const DemoResult& result) {
  const auto too_few = std::count(result.status.begin(), result.status.end(), shortshot::Status::too_few_neighbors);
  const bool is_sparse = 2 * too_few > static_cast<std::ptrdiff_t>(result.status.size());
  const std::array<double, 3> extent = extent_of(cloud);
  const double largest = *std::max_element(extent.begin(), extent.end());
  const auto radius = static_cast<double>(options.radius), leaf = static_cast<double>(options.leaf);
  if (!is_sparse && largest > radius) return {};
  char text[240];
  std::snprintf(text, sizeof text, "the cloud is %.3g x %.3g x %.3g large, and ", extent[0], extent[1], extent[2]);
  std::string hint = text;
  if (!is_sparse)
    return hint + "all of it is within --radius: lower it and --leaf, or is the unit another than theirs?";
  std::snprintf(text, sizeof text, "most key points have too few neighbors within %g: raise --radius", radius);
  hint += text;
  if (largest < 1000 * radius) return hint;
  std::snprintf(text, sizeof text, " and --leaf; if the cloud's unit is millimeters, to %g and %g", 1000 * radius,
                1000 * leaf);
  return hint + text;
}

}  // namespace shortshot_bench
