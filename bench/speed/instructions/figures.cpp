#include "speed/instructions/figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace shortshot_bench {
namespace {

const std::string dump_line = "desc: Trigger: Client Request: ";
const std::string count_line = "totals: ";  // the last one of a dump
const std::string units[] = {"neighbor", "point", "key point", "frame"};

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// A whole number above zero, all of the text.
double parse_count(const std::string& text) {
  const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  const double count = digits ? std::stod(text) : 0.0;
  if (!(count > 0.0)) throw std::runtime_error("no number above zero: '" + text + "'");
  return count;
}

std::string separator(const std::string& per) { return ", " + per + "s "; }

Figure figure_of(const std::string& dump, double instructions) {
  for (const std::string& per : units) {
    const std::size_t end = dump.rfind(separator(per));
    if (end == std::string::npos) continue;
    const double count = parse_count(dump.substr(end + separator(per).size()));
    return {dump.substr(0, end), instructions / count, per};
  }
  throw std::runtime_error("a dump of another program: '" + dump + "'");
}

const Figure* find(const std::vector<Figure>& figures, const std::string& name) {
  const auto found =
      std::find_if(figures.begin(), figures.end(), [&](const Figure& figure) { return figure.name == name; });
  return found == figures.end() ? nullptr : &*found;
}

std::string describe_difference(const Figure& measured, double recorded) {
  char text[200];
  const double share = measured.instructions / recorded - 1.0;
  std::snprintf(text, sizeof text, "%s: %.2f instructions per %s, expected %.2f (%+.1f %%, allowed %g %%)%s",
                measured.name.c_str(), measured.instructions, measured.per.c_str(), recorded, 100.0 * share,
                100.0 * allowed_share, share < 0.0 ? "; better: record it" : "");
  return text;
}

}  // namespace

std::string dump_name(const std::string& figure, std::size_t count, const std::string& per) {
  return figure + separator(per) + std::to_string(count);
}

std::vector<Figure> read_callgrind(std::istream& in) {
  std::vector<Figure> figures;
  std::string name;
  for (std::string line; std::getline(in, line);) {
    if (starts_with(line, dump_line)) name = line.substr(dump_line.size());
    if (!starts_with(line, count_line) || name.empty()) continue;
    figures.push_back(figure_of(name, parse_count(line.substr(count_line.size()))));
    name.clear();
  }
  if (figures.empty()) throw std::runtime_error("callgrind counted no stage");
  return figures;
}

std::vector<std::string> differences(const std::vector<Figure>& measured, const std::vector<Figure>& recorded) {
  std::vector<std::string> lines;
  for (const Figure& figure : measured) {
    const Figure* const expected = find(recorded, figure.name);
    if (expected == nullptr) {
      lines.push_back(figure.name + ": not recorded");
    } else if (!(std::fabs(figure.instructions - expected->instructions) <= allowed_share * expected->instructions)) {
      lines.push_back(describe_difference(figure, expected->instructions));
    }
  }
  for (const Figure& figure : recorded) {
    if (find(measured, figure.name) == nullptr) lines.push_back(figure.name + ": recorded, but not measured");
  }
  return lines;
}

std::string to_json(const Record& record) {
  nlohmann::ordered_json json;
  json["compiler"] = record.compiler;
  json["flags"] = record.flags;
  json["workload"] = record.workload;
  for (const Figure& figure : record.figures)
    json["instructions_per_" + figure.per][figure.name] = std::round(100.0 * figure.instructions) / 100.0;
  return json.dump(2) + "\n";
}

Record parse_record(const std::string& json) {
  const auto parsed = nlohmann::ordered_json::parse(json);
  Record record{parsed.at("compiler"), parsed.at("flags"), parsed.at("workload"), {}};
  for (const std::string& per : units) {
    const auto figures = parsed.find("instructions_per_" + per);
    if (figures == parsed.end()) continue;
    for (const auto& [name, value] : figures->items()) {
      record.figures.push_back({name, value.get<double>(), per});
      if (!(record.figures.back().instructions > 0.0)) throw std::runtime_error(name + " is not above zero");
    }
  }
  if (record.figures.empty()) throw std::runtime_error("there is no figure");
  return record;
}

}  // namespace shortshot_bench
