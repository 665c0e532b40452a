#include "read_colors.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "color_range.hpp"
#include "packed_colors.hpp"

namespace shortshot_bench {
namespace {

constexpr std::array<Role, 3> color_roles{Role::red, Role::green, Role::blue};

struct Facts {
  double largest = 0;
  double smallest = 0;
  std::size_t not_finite = 0;
  bool are_whole = true;
};

Facts facts_of(const std::array<const Channel*, 3>& colors, std::size_t points) {
  Facts facts;
  for (const Channel* const color : colors) {
    for_each_value(color->values, points, [&](std::size_t, double value) {
      if (!std::isfinite(value)) {
        ++facts.not_finite;
      } else {
        facts.largest = std::max(facts.largest, value);
        facts.smallest = std::min(facts.smallest, value);
        facts.are_whole = facts.are_whole && value == std::floor(value);
      }
    });
  }
  return facts;
}

/// The least that all three can hold; of mixed types, a float's range is the question.
ScalarType type_of(const std::array<const Channel*, 3>& colors) {
  ScalarType type = colors[0]->type;
  for (const Channel* const color : colors) {
    if (color->type.kind == ScalarKind::floating || color->type.size_bytes > type.size_bytes) type = color->type;
  }
  return type;
}

std::string names_of(const std::array<const Channel*, 3>& colors) {
  if (colors[0]->name == colors[1]->name) return colors[0]->name;
  return colors[0]->name + " " + colors[1]->name + " " + colors[2]->name;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

void read_separate(const std::array<const Channel*, 3>& colors, RgbdCloud& cloud, std::vector<std::string>& ignored) {
  const std::size_t points = cloud.size();
  const Facts facts = facts_of(colors, points);
  ScalarType type = type_of(colors);
  if (!facts.are_whole) type = {ScalarKind::floating, std::max<std::uint8_t>(type.size_bytes, 4)};  // text may say so
  const double full = full_brightness(type, facts.largest);
  if (full == 0) {
    ignored.push_back(names_of(colors) + " (" + type_name(type) + " up to " + number(facts.largest) +
                      ": colors are 0 to 1, 255 or 65535)");
    return;
  }
  const bool is_wrapped = type.kind == ScalarKind::signed_integer && type.size_bytes == 1 && facts.smallest < 0;
  cloud.rgb.resize(3 * points);
  std::size_t clamped = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    for_each_value(colors[k]->values, points, [&](std::size_t point, double value) {
      if (is_wrapped && value < 0) value += 256;
      clamped += value < 0 || value > full ? 1 : 0;
      cloud.rgb[3 * point + k] = to_color_byte(value, full);
    });
  }
  if (type.kind == ScalarKind::unsigned_integer && type.size_bytes == 1) return;  // as nearly everywhere
  std::string note = "colors are " + names_of(colors) + ", " + type_name(type) + ": taken as 0 to " + number(full);
  note += is_wrapped ? ", as below 0 for 128 to 255" : ", as the largest is " + number(facts.largest);
  if (clamped > 0) note += ", " + std::to_string(clamped) + " values beyond that clamped";
  if (facts.not_finite > 0) note += ", " + std::to_string(facts.not_finite) + " values not finite: 0";
  cloud.notes.push_back(note);
}

}  // namespace

void read_colors(const PointTable& table, RgbdCloud& cloud, std::vector<std::string>& ignored) {
  std::array<const Channel*, 3> colors{};
  std::string given;
  for (std::size_t k = 0; k < 3; ++k) {
    colors[k] = table.channel(color_roles[k]);
    if (colors[k] != nullptr) given += (given.empty() ? "" : ", ") + colors[k]->name;
  }
  const bool has_all = colors[0] != nullptr && colors[1] != nullptr && colors[2] != nullptr;
  const Channel* const packed = table.channel(Role::packed_color);
  if (packed != nullptr) read_packed_colors(*packed, cloud, ignored);
  if (given.empty()) return;
  if (cloud.has_colors()) {
    ignored.push_back(given + " (" + packed->name + " has the colors)");
  } else if (!has_all) {
    ignored.push_back(given + " (a color needs all of red, green and blue)");
  } else {
    read_separate(colors, cloud, ignored);
  }
}

}  // namespace shortshot_bench
