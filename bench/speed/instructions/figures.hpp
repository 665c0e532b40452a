// Instructions of single stages: as callgrind counted them, as they are on record, and how they differ.
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace shortshot_bench {

struct Figure {
  std::string name;  // stage and instruction set: "kernel Scsh336 sse2"
  double instructions;
  std::string per = "neighbor";  // "point" of the cloud where a stage looks at all of it, "key point", "frame"
};

/// Figures that were recorded, and with what.
struct Record {
  std::string compiler;  // name and major version: another one makes other figures
  std::string flags;
  std::string workload;
  std::vector<Figure> figures;
};

/// Largest difference from the record, over the record's figure, to either side: figures that became better are to be
/// recorded, too, so that they cannot become worse again unnoticed.
inline constexpr double allowed_share = 0.03;

/// The name of callgrind's dump for a stage that went through so many neighbors, points, key points or frames.
std::string dump_name(const std::string& figure, std::size_t count, const std::string& per);

/// The figures in callgrind's output file, one for each dump of that name. Throws std::runtime_error if there is none,
/// or one that is broken.
std::vector<Figure> read_callgrind(std::istream& in);

/// One line for each figure that differs by more than is allowed, was not recorded or was not measured.
std::vector<std::string> differences(const std::vector<Figure>& measured, const std::vector<Figure>& recorded);

/// As JSON. parse_record() throws nlohmann::json::exception or std::runtime_error with what is wrong.
std::string to_json(const Record& record);
Record parse_record(const std::string& json);

}  // namespace shortshot_bench
