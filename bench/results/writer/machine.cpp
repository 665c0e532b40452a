#include "results/writer/machine.hpp"

#include <fstream>
#include <thread>

#include "speed/scaling/json_rows.hpp"
#include "tools/io/binary_file.hpp"

namespace shortshot_bench::results {

namespace {

/// What stands after `key` and a separator in the first line of a file that starts with it.
std::string look_up(const char* path, const std::string& key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t at = line.find(separator);
    if (line.compare(0, key.size(), key) != 0 || at == std::string::npos) continue;
    const std::size_t first = line.find_first_not_of(" \t\"", at + 1);
    const std::size_t last = line.find_last_not_of(" \t\"");
    return first == std::string::npos || first > last ? "" : line.substr(first, last - first + 1);
  }
  return "unknown";
}

std::string compiler_name() {
#if defined(__clang__)
  return std::string("clang ") + __clang_version__;
#else
  return std::string("GCC ") + __VERSION__;
#endif
}

}  // namespace

Machine this_machine() {
  return {look_up("/proc/cpuinfo", "model name", ':'), std::thread::hardware_concurrency(),
          look_up("/etc/os-release", "PRETTY_NAME", '='), compiler_name(), SHORTSHOT_BUILD_FLAGS};
}

void write_machine(const std::string& path, const Machine& machine) {
  const nlohmann::ordered_json json = {{"cpu", machine.cpu},
                                       {"cores", machine.cores},
                                       {"system", machine.system},
                                       {"compiler", machine.compiler},
                                       {"flags", machine.flags}};
  write_file(path, json.dump(1) + "\n");
}

Machine read_machine(const std::string& path) {
  const scaling::JsonRow row(path, 1, scaling::read_json(path));
  return {row.text("cpu"), static_cast<unsigned>(row.number("cores")), row.text("system"), row.text("compiler"),
          row.text("flags")};
}

}  // namespace shortshot_bench::results
