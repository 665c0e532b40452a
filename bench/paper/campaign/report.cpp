#include "paper/campaign/report.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "paper/campaign/atomic_file.hpp"

namespace shortshot_bench::campaign {

using json = nlohmann::ordered_json;

namespace {

std::string shown(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

Table table_of(const json& parameters) {
  Table table("Parameters", {"parameter", "value"});
  for (const auto& [name, value] : parameters.items()) table.add({name, shown(value)});
  return table;
}

std::string markdown_of(const Section& section) {
  std::string text = "\n## " + section.heading + "\n";
  if (!section.text.empty()) text += "\n" + section.text + "\n";
  for (const NamedTable& named : section.tables) {
    text += "\n**" + named.table.title() + "** ([CSV](" + named.name + ".csv))\n\n" + named.table.markdown();
  }
  for (const std::string& plot : section.plots) text += "\n![" + plot + "](" + plot + ")\n";
  return text;
}

json json_of(const Report& report) {
  json sections = json::array();
  for (const Section& section : report.sections) {
    json tables = json::array();
    for (const NamedTable& named : section.tables) {
      tables.push_back({{"name", named.name}, {"title", named.table.title()}, {"rows", named.table.json()}});
    }
    sections.push_back(
        {{"heading", section.heading}, {"text", section.text}, {"tables", tables}, {"plots", section.plots}});
  }
  return {{"title", report.title}, {"sections", sections}, {"parameters", report.parameters}};
}

bool is_file_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(),
                                      [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
}

void check_names(const Report& report) {
  std::set<std::string> names;
  for (const Section& section : report.sections) {
    for (const NamedTable& named : section.tables) {
      if (!is_file_name(named.name)) throw std::invalid_argument("'" + named.name + "' is no name for a table's file");
      if (!names.insert(named.name).second) throw std::invalid_argument("two tables are named '" + named.name + "'");
    }
  }
}

}  // namespace

std::string markdown_of(const Report& report) {
  std::string text = "# " + report.title + "\n";
  for (const Section& section : report.sections) text += markdown_of(section);
  return text + "\n## Parameters\n\n" + table_of(report.parameters).markdown();
}

void write_report(const Report& report, const std::string& directory) {
  check_names(report);
  make_directory(directory);
  const std::filesystem::path folder(directory);
  for (const Section& section : report.sections) {
    for (const NamedTable& named : section.tables) {
      write_atomically((folder / (named.name + ".csv")).string(), named.table.csv());
    }
  }
  write_atomically((folder / "report.json").string(), json_of(report).dump(1) + "\n");
  write_atomically((folder / "report.md").string(), markdown_of(report));
}

}  // namespace shortshot_bench::campaign
