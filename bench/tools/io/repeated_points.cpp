#include "repeated_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "scalar_type.hpp"

namespace shortshot_bench {
namespace {

using Place = std::array<std::uint32_t, 3>;  // the bits of a point

constexpr std::size_t most_places = 65536;  // that are compared
constexpr double many = 0.05;               // of the points

/// What (0, 0, 0) has become by the origin's shift.
std::array<float, 3> zero_of(const RgbdCloud& cloud) {
  return {to_float(0 - cloud.origin[0]), to_float(0 - cloud.origin[1]), to_float(0 - cloud.origin[2])};
}

bool is_at(const RgbdCloud& cloud, std::size_t point, const std::array<float, 3>& place) {
  const float* const p = &cloud.xyz[3 * point];
  return p[0] == place[0] && p[1] == place[1] && p[2] == place[2];
}

std::uint32_t hash(const Place& place) {
  return place[0] * 0x9e3779b1u + place[1] * 0x85ebca77u + place[2] * 0xc2b2ae3du;
}

/// The share of points that are in the place of an earlier one. Of large clouds those places are compared whose hash is
/// below a limit: all points of a place, or none.
double share_of_repeated(const RgbdCloud& cloud) {
  const std::array<float, 3> zero = zero_of(cloud);
  const std::size_t step = cloud.size() / most_places + 1;
  const auto limit = static_cast<std::uint32_t>(0xffffffffu / step);
  std::vector<Place> places;
  for (std::size_t point = 0; point < cloud.size(); ++point) {
    Place place;
    std::memcpy(place.data(), &cloud.xyz[3 * point], sizeof place);
    if (hash(place) > limit) continue;
    const float sum = cloud.xyz[3 * point] + cloud.xyz[3 * point + 1] + cloud.xyz[3 * point + 2];
    if (std::isfinite(sum) && !is_at(cloud, point, zero)) places.push_back(place);
  }
  if (places.empty()) return 0;
  const auto all = static_cast<double>(places.size());
  std::sort(places.begin(), places.end());
  const auto apart = std::unique(places.begin(), places.end()) - places.begin();
  return (all - static_cast<double>(apart)) / all;
}

constexpr const char* advice = ": --drop-zeros leaves them out";

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f %%", share < 0.0995 ? 2 : 0, 100 * share);
  return text;
}

}  // namespace

std::size_t count_zeros(const RgbdCloud& cloud) {
  const std::array<float, 3> zero = zero_of(cloud);
  std::size_t zeros = 0;
  for (std::size_t point = 0; point < cloud.size(); ++point) zeros += is_at(cloud, point, zero) ? 1 : 0;
  return zeros;
}

std::size_t drop_zeros(RgbdCloud& cloud) {
  const std::array<float, 3> zero = zero_of(cloud);
  std::size_t dropped = 0;
  for (std::size_t point = 0; point < cloud.size(); ++point) {
    if (!is_at(cloud, point, zero)) continue;
    std::fill_n(&cloud.xyz[3 * point], 3, std::numeric_limits<float>::quiet_NaN());
    ++dropped;
  }
  if (dropped == 0) return 0;
  const std::string done = std::to_string(dropped) + " points of 0 0 0 left out";
  const auto note = std::find_if(cloud.notes.begin(), cloud.notes.end(),
                                 [](const std::string& text) { return text.find(advice) != std::string::npos; });
  if (note == cloud.notes.end()) {
    cloud.notes.push_back(done);
  } else {
    *note = done;
  }
  return dropped;
}

void note_repeated_points(RgbdCloud& cloud) {
  const std::size_t zeros = count_zeros(cloud);
  if (zeros > 0) {
    cloud.notes.push_back(std::to_string(zeros) + " of " + std::to_string(cloud.size()) + " points (" +
                          percent(static_cast<double>(zeros) / static_cast<double>(cloud.size())) +
                          ") are 0 0 0, which often means \"no measurement\"" + advice);
  }
  const double repeated = share_of_repeated(cloud);
  if (repeated >= many) {
    cloud.notes.push_back((cloud.size() > most_places ? "about " : "") + percent(repeated) +
                          " of the points are in the very place of another one: duplicates, or too few digits");
  }
}

}  // namespace shortshot_bench
