#include "compare_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "shortshot/cloud/read.hpp"

namespace shortshot_bench::golden {

bool is_more_than(std::size_t part, std::size_t percent, std::size_t whole) { return 100 * part > percent * whole; }

std::string number_text(const char* before, double value, const char* after) {
  char text[64];
  std::snprintf(text, sizeof text, "%s%.3g%s", before, value, after);
  return text;
}

Difference difference_of(const float* ours, const float* reference, std::size_t size) {
  Difference difference;
  for (std::size_t i = 0; i < size; ++i) {
    const double d = std::fabs(static_cast<double>(ours[i]) - static_cast<double>(reference[i]));
    const double distance = std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
    difference.largest = std::max(difference.largest, distance);
    difference.l2 += distance * distance;
  }
  difference.l2 = std::sqrt(difference.l2);
  return difference;
}

std::string lacking(const Case& c, std::initializer_list<const char*> needed) {
  for (const std::string need : needed) {
    const bool has = need == "radius"       ? c.radius.has_value()
                     : need == "lrf_radius" ? c.lrf_radius.has_value()
                                            : c.find(need) != nullptr;
    if (!has) return "no " + need;
  }
  return {};
}

shortshot::Point center_of(const Case& c, std::size_t row) { return shortshot::point(c.cloud(), c.keypoints[row]); }

}  // namespace shortshot_bench::golden
