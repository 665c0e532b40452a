#include "paper/figures.hpp"

#include <algorithm>
#include <sstream>

namespace shortshot_bench::paper {

campaign::Section section_of(const std::vector<FigureValue>& figures) {
  campaign::Table table("All figures", {"data", "descriptor", "figure", "value", "low", "high"});
  for (const FigureValue& f : figures) {
    const auto cell = [](double value) { return campaign::Cell(value, 4); };
    table.add({f.data, f.descriptor, f.figure, cell(f.interval.value), cell(f.interval.low), cell(f.interval.high)});
  }
  return {"All figures", "With their 95 % intervals.", {{"figures", table}}, {}};
}

std::vector<std::string> broken_bands(const std::vector<FigureValue>& figures, const nlohmann::ordered_json& bands) {
  std::vector<std::string> broken;
  bool any = false;
  for (const auto& band : bands) {
    const std::string data = band.at("data");
    if (std::none_of(figures.begin(), figures.end(), [&](const FigureValue& f) { return f.data == data; })) continue;
    any = true;
    const std::string descriptor = band.at("descriptor");
    const std::string name = band.at("figure");
    const double at_least = band.at("at_least");
    const double at_most = band.at("at_most");
    std::ostringstream text;
    text << data << ", " << descriptor << ", " << name << ": ";
    const auto found = std::find_if(figures.begin(), figures.end(), [&](const FigureValue& f) {
      return f.data == data && f.descriptor == descriptor && f.figure == name;
    });
    if (found == figures.end()) {
      broken.push_back(text.str() + "not measured");
    } else if (!(found->interval.value >= at_least && found->interval.value <= at_most)) {
      text << found->interval.value << " is not from " << at_least << " to " << at_most;
      broken.push_back(text.str());
    }
  }
  if (!any) broken.push_back("no band is known for these data");
  return broken;
}

}  // namespace shortshot_bench::paper
