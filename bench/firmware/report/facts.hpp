// What bench/firmware/Makefile leaves of one image: lines of words, "key value ...".
#pragma once

#include <istream>
#include <string>
#include <vector>

namespace shortshot_bench::firmware {

class Facts {
 public:
  Facts(std::string name, std::istream& in);
  const std::string& name() const { return name_; }
  /// All after a key, for each line with it, in order.
  std::vector<std::string> all(const std::string& key) const;
  /// All after the only or last such key; empty if there is none.
  std::string text(const std::string& key) const;
  /// The number after "KEY NAME"; `missing` if there is none. Throws std::runtime_error if it is no number.
  double number(const std::string& key, const std::string& name, double missing) const;

 private:
  std::string name_;
  std::vector<std::pair<std::string, std::string>> lines_;  // key, and the rest
};

/// The files that a list names, one a line. Throws std::runtime_error with the file that cannot be read.
std::vector<Facts> read_all(const std::string& list);

/// A whole number, all of the text. Throws std::runtime_error if it is none.
double whole_number(const std::string& text);

}  // namespace shortshot_bench::firmware
