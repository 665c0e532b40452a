#include "make_cloud.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

#include "origin_shift.hpp"
#include "read_colors.hpp"
#include "read_normals.hpp"
#include "repeated_points.hpp"

namespace shortshot_bench {
namespace {

void note_shift(const PointTable& table, const OriginShift& shift, RgbdCloud& cloud) {
  char text[200];
  if (cloud.is_shifted()) {
    std::snprintf(text, sizeof text, "origin %.10g %.10g %.10g subtracted: floats are %.2g apart out there",
                  shift.origin[0], shift.origin[1], shift.origin[2], shift.spacing);
    cloud.notes.emplace_back(text);
  }
  if (shift.spacing > 0 && table.viewpoint == std::array<double, 3>{0, 0, 0}) {
    cloud.notes.emplace_back(
        "the viewpoint is 0 0 0, far away, or not given: what turns towards the camera turns there");
  }
  if (shift.lost) {
    std::snprintf(text, sizeof text,
                  "coordinates are 4-byte floats, %.2g apart so far from the origin: the file has lost what is finer; "
                  "subtract an origin before it is written, or write doubles",
                  shift.spacing);
    cloud.notes.emplace_back(text);
  }
}

void read_coordinates(const PointTable& table, RgbdCloud& cloud) {
  const OriginShift shift = find_origin(table);
  cloud.origin = shift.origin;
  cloud.xyz.resize(3 * table.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double origin = shift.origin[axis];
    for_each_value(table.channel(static_cast<Role>(axis))->values, table.size(),
                   [&](std::size_t point, double value) { cloud.xyz[3 * point + axis] = to_float(value - origin); });
    cloud.viewpoint[axis] = to_float(table.viewpoint[axis] - origin);
  }
  note_shift(table, shift, cloud);
  const ScalarType& type = table.channel(Role::x)->type;
  if (type.kind != ScalarKind::floating) {
    cloud.notes.push_back("coordinates are whole numbers (" + type_name(type) +
                          "): --radius and --leaf are in their unit");
  }
}

void read_intensities(const PointTable& table, RgbdCloud& cloud) {
  const Channel* const channel = table.channel(Role::intensity);
  if (channel == nullptr) return;
  cloud.intensity.resize(table.size());
  for_each_value(channel->values, table.size(),
                 [&](std::size_t point, double value) { cloud.intensity[point] = to_float(value); });
  if (channel->name != "intensity") cloud.notes.push_back("intensities are " + channel->name);
}

/// A channel that says the same of all points is usable and yet of no use.
template <typename Value>
bool is_constant(const std::vector<Value>& values, std::size_t per_point) {
  return values.size() > per_point &&
         std::equal(values.begin() + static_cast<std::ptrdiff_t>(per_point), values.end(), values.begin());
}

void note_constant_channels(RgbdCloud& cloud) {
  if (is_constant(cloud.rgb, 3)) {
    cloud.notes.push_back("all points have one color, " + std::to_string(cloud.rgb[0]) + " " +
                          std::to_string(cloud.rgb[1]) + " " + std::to_string(cloud.rgb[2]));
  }
  if (is_constant(cloud.intensity, 1)) cloud.notes.push_back("all points have one intensity");
  if (is_constant(cloud.normals, 3)) cloud.notes.push_back("all points have one normal");
}

/// The channels that nobody looked at, each name once.
void list_unused(const PointTable& table, std::vector<std::string>& ignored) {
  for (const Channel& channel : table.channels) {
    if (table.uses(channel) || is_padding(channel.name)) continue;
    std::string name = channel.name;
    if (channel.count == 0) name += " (a list)";
    if (channel.count > 1) name += " (COUNT " + std::to_string(channel.count) + ")";
    if (channel.count == 1 && channel.named.role != Role::none) {
      name += " (" + table.channel(channel.named.role)->name + " counts)";
    }
    if (std::find(ignored.begin(), ignored.end(), name) == ignored.end()) ignored.push_back(name);
  }
}

/// A file may have more names than anybody reads.
std::string joined(const std::vector<std::string>& words, const char* separator) {
  constexpr std::size_t most = 24;
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), most); ++i) text += (i == 0 ? "" : separator) + words[i];
  if (words.size() > most) text += separator + std::to_string(words.size() - most) + " more";
  return text;
}

}  // namespace

RgbdCloud make_cloud(PointTable& table) {
  RgbdCloud cloud;
  cloud.width = table.width;
  cloud.height = table.height;
  cloud.notes = std::move(table.notes);
  read_coordinates(table, cloud);
  std::vector<std::string> ignored;
  read_colors(table, cloud, ignored);
  read_intensities(table, cloud);
  read_normals(table, cloud, ignored);
  note_constant_channels(cloud);
  note_repeated_points(cloud);
  list_unused(table, ignored);
  const std::string channels = joined(ignored, ", ");
  const std::string others = joined(table.unused, ", ");
  if (!channels.empty() || !others.empty()) {
    cloud.notes.push_back("ignored: " + channels + (channels.empty() || others.empty() ? "" : "; ") + others);
  }
  for (std::string& note : cloud.notes) {  // names may hold anything
    std::replace_if(
        note.begin(), note.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  }
  return cloud;
}

}  // namespace shortshot_bench
