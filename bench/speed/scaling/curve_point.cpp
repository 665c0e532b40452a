#include "speed/scaling/curve_point.hpp"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "speed/scaling/json_rows.hpp"
#include "tools/io/binary_file.hpp"

namespace shortshot_bench::scaling {

void write_curves(const std::string& path, const std::vector<CurvePoint>& points) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CurvePoint& p : points) {
    list.push_back({{"curve", p.curve},
                    {"x", p.x},
                    {"x_name", p.x_name},
                    {"series", p.series},
                    {"value", p.value},
                    {"unit", p.unit},
                    {"extra_bytes", static_cast<std::uint64_t>(p.extra_bytes)},
                    {"repetitions", p.repetitions}});
  }
  write_file(path, list.dump(1) + "\n");
}

std::vector<CurvePoint> read_curves(const std::string& path) {
  std::vector<CurvePoint> points;
  for (const JsonRow& row : read_rows(path)) {
    points.push_back({row.text("curve"), row.number("x"), row.text("x_name"), row.text("series"), row.number("value"),
                      row.text("unit"), row.number("extra_bytes"), static_cast<int>(row.number("repetitions"))});
  }
  return points;
}

std::vector<std::string> distinct(const std::vector<CurvePoint>& points, std::string CurvePoint::*member) {
  std::vector<std::string> values;
  for (const CurvePoint& p : points) {
    if (std::find(values.begin(), values.end(), p.*member) == values.end()) values.push_back(p.*member);
  }
  return values;
}

std::vector<CurvePoint> with(const std::vector<CurvePoint>& points, std::string CurvePoint::*member,
                             const std::string& value) {
  std::vector<CurvePoint> found;
  std::copy_if(points.begin(), points.end(), std::back_inserter(found),
               [&](const CurvePoint& p) { return p.*member == value; });
  return found;
}

}  // namespace shortshot_bench::scaling
