// The files that the results are made of, and the documents that show them.
#pragma once

#include <string>
#include <vector>

namespace shortshot_bench::results {

struct Document {
  std::string path;
  std::string committed;  // what the file holds
  std::string generated;  // what it should hold
};

/// README.md, bench/RESULTS.md, bench/firmware/README.md and bench/GOALS.md of the project in `root`, with their
/// generated blocks made of bench/results/*.json and bench/speed/instructions/expected.json. Throws std::runtime_error
/// with the file's name if one is missing or malformed.
std::vector<Document> generate(const std::string& root);

/// Where the machine is written down.
std::string machine_path(const std::string& root);

}  // namespace shortshot_bench::results
