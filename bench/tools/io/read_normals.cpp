#include "read_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace shortshot_bench {
namespace {

constexpr double unit_tolerance = 1e-3;  // of a length that is left as it is

struct Lengths {
  std::size_t missing = 0;
  std::size_t not_unit = 0;
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
};

void set_normal(const std::array<double, 3>& n, float* out, Lengths& lengths) {
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!std::isfinite(length) || !(length > 0)) {
    ++lengths.missing;
    std::fill_n(out, 3, std::numeric_limits<float>::quiet_NaN());
    return;
  }
  lengths.least = std::min(lengths.least, length);
  lengths.most = std::max(lengths.most, length);
  const bool is_unit = std::abs(length - 1) <= unit_tolerance;
  lengths.not_unit += is_unit ? 0 : 1;
  for (std::size_t k = 0; k < 3; ++k) out[k] = static_cast<float>(is_unit ? n[k] : n[k] / length);
}

std::string note_about(const std::string& names, std::size_t points, const Lengths& lengths) {
  std::string note = "normals are " + names;
  if (lengths.not_unit > 0) {
    char range[96];
    std::snprintf(range, sizeof range, ", %zu of them made unit length (they are %.3g to %.3g long)", lengths.not_unit,
                  lengths.least, lengths.most);
    note += range;
  }
  if (lengths.missing > 0) {
    note += ", " + std::to_string(lengths.missing) + " of " + std::to_string(points) + " missing (zero or not finite)";
  }
  return note;
}

}  // namespace

void read_normals(const PointTable& table, RgbdCloud& cloud, std::vector<std::string>& ignored) {
  std::array<const Channel*, 3> channels{};
  std::string names;
  bool has_all = true;
  bool has_sign = true;
  for (std::size_t k = 0; k < 3; ++k) {
    channels[k] = table.channel(static_cast<Role>(static_cast<std::size_t>(Role::normal_x) + k));
    has_all = has_all && channels[k] != nullptr;
    if (channels[k] == nullptr) continue;
    has_sign = has_sign && channels[k]->type.kind != ScalarKind::unsigned_integer;
    if (k == 0 || names != channels[k]->name) names += (names.empty() ? "" : " ") + channels[k]->name;
  }
  if (names.empty()) return;
  if (!has_all || !has_sign) {
    ignored.push_back(names + (has_all ? " (a normal needs signs)" : " (a normal needs all of x, y and z)"));
    return;
  }
  const std::size_t points = cloud.size();
  cloud.normals.resize(3 * points);
  Lengths lengths;
  for (std::size_t point = 0; point < points; ++point) {
    set_normal({channels[0]->values.at(point), channels[1]->values.at(point), channels[2]->values.at(point)},
               &cloud.normals[3 * point], lengths);
  }
  if (lengths.missing == points) {
    cloud.normals.clear();
    ignored.push_back(names + " (all zero or not finite)");
    return;
  }
  cloud.notes.push_back(note_about(names, points, lengths));
}

}  // namespace shortshot_bench
