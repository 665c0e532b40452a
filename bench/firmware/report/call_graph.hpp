// The deepest stack of a function, by the call graph that GCC writes with -fcallgraph-info=su.
#pragma once

#include <istream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace shortshot_bench::firmware {

class CallGraph {
 public:
  explicit CallGraph(std::istream& in);
  bool has(const std::string& function) const { return bytes_.count(function) != 0; }
  /// Bytes of the frames on the deepest way from a function down. Functions of other files (memset, memcpy) count as
  /// nothing; a call by pointer may lead to every function of this file's own that is never called by name. Throws
  /// std::runtime_error where the depth cannot be known: recursion, a frame without a fixed size, a call by pointer to
  /// nothing in the file.
  double deepest(const std::string& function) const;

 private:
  double walk(const std::string& function, std::vector<std::string>& path) const;
  double walk_pointer(std::vector<std::string>& path) const;
  std::map<std::string, double> bytes_;  // negative: no fixed size
  std::multimap<std::string, std::string> calls_;
  std::set<std::string> called_by_name_;
  mutable std::map<std::string, double> known_;
};

}  // namespace shortshot_bench::firmware
