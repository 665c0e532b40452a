#include "firmware/report/tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace shortshot_bench::firmware {
namespace {

struct Column {
  const char* header;
  const char* figure;
  const char* otherwise;  // a figure in its place, or null
};

constexpr Column columns[] = {{"brute", "flash_brute", "object_brute"},
                              {"grid", "flash_grid", "object_grid"},
                              {"image", "flash_organized", nullptr},
                              {"further", "flash_further", nullptr},
                              {"static", "static_bytes", nullptr},
                              {"painted", "stack_painted", nullptr},
                              {"graph", "stack_graph", nullptr},
                              {"chunk", "chunk_bytes", nullptr},
                              {"B/nb", "workspace_bytes_per_neighbor", nullptr},
                              {"B/pt", "index_bytes_per_point", nullptr},
                              {"250", "work_given_250", nullptr},
                              {"500", "work_given_500", nullptr},
                              {"each", "work_per_neighbor", nullptr},
                              {"fixed", "work_fixed", nullptr},
                              {"each Lab", "work_lab_per_neighbor", nullptr},
                              {"build", "work_build_grid", nullptr},
                              {"gather", "work_gather_grid", nullptr}};

/// Tasks of recognition stand in the place of a configuration.
bool is_recognition(const std::string& configuration) {
  return configuration == "Recognition" || configuration == "Segments" || configuration == "SegmentsLeftOut";
}
constexpr Column recognition_columns[] = {
    {"objects", "objects", nullptr},        {"codewords", "codewords", nullptr},  {"model", "model_bytes", nullptr},
    {"RAM", "recognizer_bytes", nullptr},   {"code", "recognizer_code", nullptr}, {"stack", "stack_painted", nullptr},
    {"open", "work_open", nullptr},         {"index", "work_index", nullptr},     {"colors", "work_colors", nullptr},
    {"describe", "work_describe", nullptr}, {"match", "work_match", nullptr},     {"find", "work_find", nullptr},
    {"view", "work_view", nullptr},         {"views", "views", nullptr},          {"right", "right", nullptr},
    {"classes", "right_classes", nullptr}};

/// Of each small depth sensor: a program, too.
constexpr const char* small_sensor = "SmallSensor";
constexpr Column sensor_columns[] = {{"points", "points", nullptr},
                                     {"RAM", "ram_bytes", nullptr},
                                     {"stack", "stack_painted", nullptr},
                                     {"code", "code_bytes", nullptr},
                                     {"model", "model_bytes", nullptr},
                                     {"to points", "work_points", nullptr},
                                     {"describe", "work_describe", nullptr},
                                     {"match", "work_match", nullptr},
                                     {"view", "work_view", nullptr},
                                     {"views", "views", nullptr},
                                     {"right", "right", nullptr},
                                     {"kind", "right_kind", nullptr},
                                     {"best", "best", nullptr},
                                     {"right", "right_best", nullptr},
                                     {"sure", "sure", nullptr},
                                     {"right", "right_sure", nullptr}};

using Lines = std::vector<std::vector<std::string>>;

std::string cell(const Row& row, const Column& column) {
  auto found = row.figures.find(column.figure);
  if (found == row.figures.end() && column.otherwise != nullptr) found = row.figures.find(column.otherwise);
  return found == row.figures.end() ? "" : std::to_string(std::lround(found->second));
}

/// The hash of a row's build; empty if there is none.
std::string hash_of(const Measured& measured, const Row& row) {
  for (const Hash& hash : measured.hashes) {
    if (hash.target == row.target && hash.level == row.level && hash.configuration == row.configuration)
      return hash.value;
  }
  return "";
}

std::string aligned(const Lines& lines) {
  std::vector<std::size_t> widths(lines.front().size());
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string fill(widths[i] - line[i].size(), ' ');
      text += (i == 0 ? "" : "  ") + (i < 3 ? line[i] + fill : fill + line[i]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  return text;
}

std::vector<std::string> configurations(const Measured& measured) {
  std::vector<std::string> names;
  for (const Row& row : measured.rows) {
    if (std::find(names.begin(), names.end(), row.configuration) == names.end()) names.push_back(row.configuration);
  }
  return names;
}

const char* const legend =
    "flash in bytes: brute, grid, image: an image with that search and start-up (hosts: code and constants of the "
    "object);\n"
    "further: as second configuration after SCSH-336. static: .data + .bss of the library. stack in bytes: painted and "
    "by\n"
    "the call graph, both with the chunk. B/nb: workspace per neighbor; B/pt: index per point, and as much per cell.\n"
    "instructions: 250, 500: of a descriptor with so many gathered neighbors; each: per neighbor, and with a Lab "
    "color\n"
    "per point; fixed: besides; build, gather: grid over 2000 points, 500 found.\n"
    "Recognition of generated objects, Segments of real frames: model: bytes of flash; RAM: bytes of the recognizer, "
    "workspace included; "
    "instructions\n"
    "of open() and, for a view of 100 key points, of the index, descriptions, comparisons with all codewords, and the "
    "densest places.\n"
    "Small sensors: RAM: all of it, stack included; code: flash without the model; of the views how many are named "
    "rightly, or\n"
    "at least their kind; of those at the best distances; of those where all codewords agree.\n";

}  // namespace

std::string tables(const Measured& measured) {
  std::string text;
  for (const std::string& configuration : configurations(measured)) {
    Lines lines{{"target", "", "workspace"}};
    const auto add = [&](const auto& all) {
      for (const Column& column : all) lines[0].push_back(column.header);
      for (const Row& row : measured.rows) {
        if (row.configuration != configuration) continue;
        lines.push_back({row.target, "-" + row.level, row.workspace});
        for (const Column& column : all) lines.back().push_back(cell(row, column));
        lines.back().push_back(hash_of(measured, row));
      }
    };
    if (is_recognition(configuration)) {
      add(recognition_columns);
    } else if (configuration.rfind(small_sensor, 0) == 0) {
      add(sensor_columns);
    } else {
      add(columns);
    }
    lines[0].push_back("hash");
    text += configuration + "\n" + aligned(lines) + "\n";
  }
  return text + legend;
}

std::string to_json(const Measured& measured, const std::vector<Budget>& budgets,
                    const std::vector<std::string>& broken) {
  nlohmann::ordered_json json = {{"compilers", measured.compilers}};
  for (const Row& row : measured.rows) {
    nlohmann::ordered_json entry = {{"target", row.target},
                                    {"level", row.level},
                                    {"configuration", row.configuration},
                                    {"workspace", row.workspace}};
    for (const auto& [name, value] : row.figures) entry[name] = std::round(100.0 * value) / 100.0;
    json["figures"].push_back(entry);
  }
  for (const Hash& hash : measured.hashes) {
    json["hashes"].push_back(
        {{"target", hash.target}, {"level", hash.level}, {"configuration", hash.configuration}, {"hash", hash.value}});
  }
  for (const Budget& budget : budgets) {
    const Row* const worst = worst_row(budget, measured.rows);
    if (worst == nullptr) continue;
    json["budgets"].push_back({{"promise", budget.promise},
                               {"goal", budget.goal},
                               {"at_most", budget.at_most},
                               {"measured", std::round(100.0 * worst->figures.at(budget.figure)) / 100.0},
                               {"where", worst->configuration + " on " + worst->target + " -" + worst->level + ", " +
                                             worst->workspace + " workspace"}});
  }
  json["broken"] = broken;
  return json.dump(2) + "\n";
}

}  // namespace shortshot_bench::firmware
