#include "tools/plot/axis.hpp"

#include <cmath>
#include <sstream>

namespace shortshot_bench {
namespace {

constexpr double rim = 0.04;  // of the axis, on either side

std::string text_of(double value) {
  std::ostringstream text;
  text.precision(6);
  text << value;
  return text.str();
}

std::string range(const std::string& name, double low, double high) {
  return "set " + name + "range [" + text_of(low) + ':' + text_of(high) + "]; ";
}

std::vector<double> places_within(double low, double high) {
  std::vector<double> places;
  for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= high; decade *= 10.0) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      if (digit * decade >= low && digit * decade <= high) places.push_back(digit * decade);
    }
  }
  return places;
}

}  // namespace

std::string positive_axis(const std::string& name, double least, double most) {
  if (most < 10.0 * least) {
    const double wider = most > least ? rim * (most - least) : 0.1 * most;
    return "unset logscale " + name + "; " + range(name, least - wider, most + wider) + "set " + name +
           "tics autofreq; ";
  }
  const double factor = std::pow(most / least, rim);
  const double low = least / factor;
  const double high = most * factor;
  const std::string scale = "set logscale " + name + " 10; " + range(name, low, high);
  return scale + (most < 100.0 * least ? ticks_at(name, places_within(low, high)) : "set " + name + "tics autofreq; ");
}

std::string ticks_at(const std::string& name, const std::vector<double>& places) {
  std::string text = "set " + name + "tics (";
  for (const double& place : places) text += std::string(&place == &places.front() ? "" : ", ") + text_of(place);
  return text + "); ";
}

double round_step(double span, int most) {
  const double least = span / most;
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (least <= digit * decade * (1.0 + 1e-9)) return digit * decade;
  }
  return 10.0 * decade;
}

}  // namespace shortshot_bench
