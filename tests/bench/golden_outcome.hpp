// What the golden tool says of a case.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "golden_case_copy.hpp"
#include "tools/golden/case.hpp"
#include "tools/golden/compare.hpp"
#include "tools/golden/tool.hpp"

namespace golden_test {

struct Outcome {
  shortshot_bench::golden::ExitCode code;
  std::string out, err;
};

inline Outcome run_tool(const std::vector<std::string>& paths, bool verbose = false) {
  std::ostringstream out, err;
  const shortshot_bench::golden::ExitCode code = shortshot_bench::golden::run(paths, verbose, out, err);
  return {code, out.str(), err.str()};
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

inline std::vector<std::string> broken_arrays(const CaseCopy& copy) {
  std::vector<std::string> names;
  for (const shortshot_bench::golden::Result& result :
       compare(shortshot_bench::golden::read_case(copy.path())).results) {
    if (result.broken) names.push_back(result.array);
  }
  return names;
}

using Names = std::vector<std::string>;

}  // namespace golden_test
