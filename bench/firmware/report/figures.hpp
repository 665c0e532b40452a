// Figures of the library, made of what the images are and of what they did.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "firmware/report/facts.hpp"

namespace shortshot_bench::firmware {

/// What one configuration costs on one target.
struct Row {
  std::string target;  // a core and a compiler, of bench/firmware/targets.mk
  std::string level;
  std::string configuration;
  std::string workspace;                  // full or compact
  std::map<std::string, double> figures;  // bytes, or instructions
};

/// What the descriptors of one build are.
struct Hash {
  std::string target;
  std::string level;
  std::string configuration;
  std::string value;
};

struct Measured {
  std::vector<Row> rows;
  std::vector<Hash> hashes;
  std::map<std::string, std::string> compilers;  // by target
  std::vector<std::string> skipped;              // configurations whose data are not there
};

/// What one run of the program of hashes printed.
std::vector<Hash> hashes_of(const Facts& image);

/// Throws std::runtime_error, with the image's name, if its facts cannot be: counts without sections and the like.
Measured measure(const std::vector<Facts>& images);

}  // namespace shortshot_bench::firmware
