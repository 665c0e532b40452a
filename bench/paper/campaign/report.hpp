// A campaign's report: what was found, and with which parameters.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paper/campaign/table.hpp"

namespace shortshot_bench::campaign {

/// A table of a report. The name is that of its CSV file: letters, digits, '_' and '-'.
struct NamedTable {
  std::string name;
  Table table;
};

struct Section {
  std::string heading{};
  std::string text{};  // Markdown
  std::vector<NamedTable> tables{};
  std::vector<std::string> plots{};  // files in the report's folder
};

struct Report {
  std::string title{};
  std::vector<Section> sections{};
  nlohmann::ordered_json parameters{};  // an object
};

/// The report as Markdown: the sections, then a table of all parameters.
std::string markdown_of(const Report& report);

/// Writes DIRECTORY/report.md, DIRECTORY/report.json and DIRECTORY/NAME.csv for each table, each of them as a whole or
/// not at all; makes the folder. The same report gives the same bytes. Throws InputError if a file cannot be written
/// and std::invalid_argument if a table's name is no name for a file or is there twice.
void write_report(const Report& report, const std::string& directory);

}  // namespace shortshot_bench::campaign
