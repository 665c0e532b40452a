#include "origin_shift.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace shortshot_bench {
namespace {

constexpr std::size_t sample_size = 4096;
// Radii are a small part of a cloud's extent, and a float's spacing is to be a small part of a radius: 2^-23 of a
// coordinate beyond 128 extents is more than 2^-16 of the extent.
constexpr double most_extents = 128;
// Here the spacing is 2^-7: whatever the unit, it has got too few digits behind the point.
constexpr double most_units = 65536;

struct Axis {
  double middle = 0;
  double extent = 0;
};

/// Middle and extent without the outermost hundredth on either side.
Axis axis_of(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const std::size_t margin = values.size() / 100;
  return {values[values.size() / 2], values[values.size() - 1 - margin] - values[margin]};
}

/// A round number, so that people recognize it.
double rounded_to_extent(double value, double extent) {
  const double step = std::pow(10.0, std::ceil(std::log10(std::max(extent, 1e-8 * std::abs(value)))));
  return step * std::round(value / step);
}

bool is_measured(const std::array<double, 3>& p) {
  const auto fits = [](double value) { return std::isfinite(to_float(value)); };
  return fits(p[0]) && fits(p[1]) && fits(p[2]) && (p[0] != 0 || p[1] != 0 || p[2] != 0);
}

std::array<Axis, 3> sampled_axes(const PointTable& table) {
  std::array<std::vector<double>, 3> values;
  const std::size_t step = table.size() / sample_size + 1;
  for (std::size_t point = 0; point < table.size(); point += step) {
    const std::array<double, 3> p{table.channel(Role::x)->values.at(point), table.channel(Role::y)->values.at(point),
                                  table.channel(Role::z)->values.at(point)};
    if (!is_measured(p)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) values[axis].push_back(p[axis]);
  }
  std::array<Axis, 3> axes;
  for (std::size_t axis = 0; axis < 3 && !values[axis].empty(); ++axis) axes[axis] = axis_of(values[axis]);
  return axes;
}

}  // namespace

OriginShift find_origin(const PointTable& table) {
  OriginShift shift;
  const std::array<Axis, 3> axes = sampled_axes(table);
  const double extent = std::max({axes[0].extent, axes[1].extent, axes[2].extent});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double distance = std::abs(axes[axis].middle);
    const bool is_far =
        (extent > 0 && distance > most_extents * extent) || (distance >= most_units && distance >= extent);
    if (!is_far) continue;
    const ScalarType& type = table.channel(static_cast<Role>(axis))->values.type;
    shift.spacing = std::max(shift.spacing, std::exp2(std::floor(std::log2(distance)) - 23));
    if (type.kind == ScalarKind::floating && type.size_bytes == 4) {
      shift.lost = true;
    } else {
      shift.origin[axis] = rounded_to_extent(axes[axis].middle, extent);
    }
  }
  return shift;
}

}  // namespace shortshot_bench
