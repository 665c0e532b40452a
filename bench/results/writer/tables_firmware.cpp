// Figures of the firmware targets.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "results/writer/markdown.hpp"
#include "results/writer/tables.hpp"

namespace shortshot_bench::results {
namespace {

using Json = nlohmann::ordered_json;

/// A figure as a whole number, or nothing if it was not measured.
std::string figure(const Json& row, const char* name) {
  const auto found = row.find(name);
  return found == row.end() ? "" : whole(found->get<double>());
}

/// The difference of two figures.
std::string difference(const Json& row, const char* more, const char* less) {
  if (row.count(more) == 0 || row.count(less) == 0) return "";
  return whole(row[more].get<double>() - row[less].get<double>());
}

const Json& row_of(const Json& json, const std::string& path, const char* level, const char* configuration,
                   const char* workspace) {
  for (const Json& row : json.at("figures")) {
    if (row.at("target") == "m7" && row.at("level") == level && row.at("configuration") == configuration &&
        row.at("workspace") == workspace) {
      return row;
    }
  }
  throw std::runtime_error(path + ": no figures of " + configuration + " on m7 -" + level);
}

std::string hash_of(const Json& json, const std::string& configuration) {
  for (const Json& hash : json.at("hashes")) {
    if (hash.at("configuration") == configuration) return hash.at("hash");
  }
  return "";
}

std::string table_of(const Json& json, const std::string& configuration) {
  Table table({configuration, "flash", "grid", "image", "further", "stack", "chunk", "each", "each, Lab", "fixed",
               "at 250", "at 500"});
  for (const Json& row : json.at("figures")) {
    if (row.at("configuration") != configuration) continue;
    const std::string name = row.at("target").get<std::string>() + " -" + row.at("level").get<std::string>();
    table.add({name + (row.at("workspace") == "compact" ? ", compact" : ""), figure(row, "flash_brute"),
               difference(row, "flash_grid", "flash_brute"), difference(row, "flash_organized", "flash_brute"),
               figure(row, "flash_further"), figure(row, "stack_outside_chunk"), figure(row, "chunk_bytes"),
               figure(row, "work_per_neighbor"), figure(row, "work_lab_per_neighbor"), figure(row, "work_fixed"),
               figure(row, "work_given_250"), figure(row, "work_given_500")});
  }
  return table.markdown();
}

/// Tasks of recognition stand in the place of a configuration.
constexpr const char* recognition = "Recognition";
constexpr const char* segments = "Segments";
constexpr const char* left_out = "SegmentsLeftOut";

std::string recognition_table(const Json& json, const std::string& task) {
  Table table({task, "objects", "codewords", "model", "RAM", "code", "stack", "open", "index", "colors", "describe",
               "match", "find", "a view", "named rightly"});
  for (const Json& row : json.at("figures")) {
    if (row.at("configuration") != task) continue;
    const std::string name = row.at("target").get<std::string>() + " -" + row.at("level").get<std::string>();
    table.add({name, figure(row, "objects"), figure(row, "codewords"), figure(row, "model_bytes"),
               figure(row, "recognizer_bytes"), figure(row, "recognizer_code"), figure(row, "stack_painted"),
               figure(row, "work_open"), figure(row, "work_index"), figure(row, "work_colors"),
               figure(row, "work_describe"), figure(row, "work_match"), figure(row, "work_find"),
               figure(row, "work_view"),
               row.count("views") == 0 ? "" : figure(row, "right") + " of " + figure(row, "views")});
  }
  return table.markdown();
}

/// Small depth sensors: a program for each stands in the place of a configuration.
constexpr const char* small_sensor = "SmallSensor";

bool is_small_sensor(const std::string& configuration) { return configuration.rfind(small_sensor, 0) == 0; }

std::string figure_of(const Json& row, const char* part, const char* whole_of) {
  return row.count(part) == 0 ? "" : figure(row, part) + " of " + figure(row, whole_of);
}

std::string by_chance(const Json& row) {
  return row.count("names") == 0 ? "" : whole(row["views"].get<double>() / row["names"].get<double>());
}

void add_small_sensor(const Json& row, const std::string& hash, Table& table) {
  const std::string sensor = row.at("configuration").get<std::string>().substr(std::string(small_sensor).size());
  const std::string target = row.at("target").get<std::string>() + " -" + row.at("level").get<std::string>();
  table.add({sensor + " " + target, figure(row, "points"), figure(row, "keypoints"), figure(row, "ram_bytes"),
             figure(row, "stack_painted"), figure(row, "code_bytes"), figure(row, "model_bytes"),
             figure(row, "work_points"), figure(row, "work_describe"), figure(row, "work_match"),
             figure(row, "work_view"), figure_of(row, "right", "views"), by_chance(row),
             figure_of(row, "right_kind", "views"), figure_of(row, "right_best", "best"),
             figure_of(row, "right_sure", "sure"), row.count("work_view") == 0 ? "" : hash});
}

/// All of them, sensor by sensor; what the hosted recognizer names of the same frames has a row of its own.
std::string small_sensor_table(const Json& json) {
  Table table({"Small sensors", "points", "key points", "RAM in all", "of it stack", "code", "model", "to points",
               "describe", "match", "a view", "named rightly", "by chance", "their kind", "at 17 to 35 cm",
               "sure and right", "hash"});
  std::vector<std::string> sensors;
  for (const Json& row : json.at("figures")) {
    const std::string configuration = row.at("configuration");
    const bool is_known = std::find(sensors.begin(), sensors.end(), configuration) != sensors.end();
    if (is_small_sensor(configuration) && !is_known) sensors.push_back(configuration);
  }
  for (const std::string& sensor : sensors) {
    for (const Json& row : json.at("figures")) {
      if (row.at("configuration") == sensor) add_small_sensor(row, hash_of(json, sensor), table);
    }
  }
  return sensors.empty() ? "" : "\n" + table.markdown();
}

/// Accuracy against bytes.
std::string left_out_table(const Json& json) {
  Table table(
      {left_out, "codewords", "model", "instance named rightly", "class", "right ones kept", "unknown ones refused"});
  for (const Json& row : json.at("figures")) {
    if (row.at("configuration") != left_out) continue;
    const std::string of = " of " + figure(row, "views");
    table.add({row.at("target").get<std::string>(), figure(row, "codewords"), figure(row, "model_bytes"),
               figure(row, "right") + of, figure(row, "right_classes") + of,
               figure(row, "right_kept") + " of " + figure(row, "right"), figure(row, "unknown_refused") + of});
  }
  return table.markdown();
}

/// At -O2; nothing where it was not measured.
const Json* row_or_none(const Json& json, const std::string& configuration, const std::string& target) {
  for (const Json& row : json.at("figures")) {
    const bool is_it =
        row.at("configuration") == configuration && row.at("target") == target && row.at("level") == "O2";
    if (is_it) return &row;
  }
  return nullptr;
}

/// What a firmware engineer may quote.
std::string recognition_headline(const Json& json) {
  const Json* const generated = row_or_none(json, recognition, "m7");
  if (generated == nullptr) return "";
  const auto kilobytes = [](const Json& row, const char* name) {
    return whole(row.at(name).get<double>() / 1024.0) + " KB";
  };
  const auto named = [](const Json& row) { return figure(row, "right") + " of " + figure(row, "views"); };
  std::string text = "\nIt names what it sees, too: " + figure(*generated, "objects") + " objects in a model of " +
                     kilobytes(*generated, "model_bytes") + " of flash, " + kilobytes(*generated, "recognizer_bytes") +
                     " of RAM, " + whole(generated->at("work_view").get<double>() / 1e6) +
                     " million instructions for a view of 100 key points; " + named(*generated) +
                     " new views of generated objects are named rightly";
  const Json* const real = row_or_none(json, left_out, "host_192KB");
  const Json* const floats = row_or_none(json, left_out, "host_cshot1344_floats");
  const Json* const board = row_or_none(json, segments, "m7");
  if (real != nullptr && floats != nullptr && board != nullptr) {
    text += ", and of " + figure(*board, "objects") + " real objects' segments in other scenes " + named(*real) +
            " with a model of " + kilobytes(*real, "model_bytes") +
            " (CSHOT-1344 in floats, on a PC: " + named(*floats) + " with " +
            whole(floats->at("model_bytes").get<double>() / 1048576.0) + " MB)";
  }
  return text + ".\n";
}

/// The table of a configuration, or of a task.
std::string table_for(const Json& json, const std::string& configuration) {
  if (configuration == left_out) return left_out_table(json);
  const bool is_task = configuration == recognition || configuration == segments;
  return is_task ? recognition_table(json, configuration) : table_of(json, configuration);
}

}  // namespace

std::string firmware_headline(const std::string& path, const Json& json) {
  Table table({"Cortex-M7, GCC", "flash, -Os", "stack, -O2", "workspace", "instructions, -O2"});
  for (const char* configuration : {"Ssh96", "Scsh336", "ShapeColor95"}) {
    const Json& small = row_of(json, path, "Os", configuration, "full");
    const Json& fast = row_of(json, path, "O2", configuration, "full");
    const Json& compact = row_of(json, path, "O2", configuration, "compact");
    const double stack = fast.at("stack_outside_chunk").get<double>() + fast.at("chunk_bytes").get<double>();
    table.add({configuration, figure(small, "flash_brute") + " B", whole(stack) + " B",
               figure(fast, "workspace_bytes_per_neighbor") + " B a neighbor, compact " +
                   figure(compact, "workspace_bytes_per_neighbor"),
               figure(fast, "work_per_neighbor") + " a neighbor + " + figure(fast, "work_fixed")});
  }
  return table.markdown() + recognition_headline(json);
}

std::string firmware_tables(const Json& json) {
  Table budgets({"promise", "goal", "limit in force", "largest figure", "of"});
  for (const Json& budget : json.at("budgets")) {
    const bool missed = budget.at("measured").get<double>() > budget.at("goal").get<double>();
    budgets.add({budget.at("promise").get<std::string>() + (missed ? " (goal missed)" : ""), figure(budget, "goal"),
                 figure(budget, "at_most"), figure(budget, "measured"), budget.at("where")});
  }
  std::string text = budgets.markdown();
  std::string last;
  for (const Json& row : json.at("figures")) {
    const std::string configuration = row.at("configuration");
    if (configuration == last) continue;
    last = configuration;
    if (text.find("| " + configuration + " |") != std::string::npos) continue;
    if (is_small_sensor(configuration)) continue;
    text += "\n" + table_for(json, configuration);
    const std::string hash = hash_of(json, configuration);
    if (!hash.empty()) text += "\nHash of the bits: " + hash + ", the same in every build.\n";
  }
  return text + small_sensor_table(json);
}

}  // namespace shortshot_bench::results
