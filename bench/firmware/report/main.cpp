// firmware_report: what bench/firmware/Makefile has measured, as tables and JSON, against what is promised.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/report/facts.hpp"
#include "firmware/report/figures.hpp"
#include "firmware/report/promises.hpp"
#include "firmware/report/tables.hpp"
#include "tools/io/binary_file.hpp"

namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::firmware;

/// What parse(text) makes of a file; what is wrong with it is said with its name.
template <class Parse>
auto parse_file(const std::string& path, const Parse& parse) {
  std::ifstream in(path);
  try {
    if (!in) throw std::runtime_error("cannot be read");
    return parse(std::string(std::istreambuf_iterator<char>(in), {}));
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

/// The hashes of this machine's own build, which ./run bits compares with those of other compilers.
Hashes reference(const std::vector<Hash>& hashes) {
  Hashes found;
  for (const Hash& hash : hashes) {
    const bool is_reference = hash.target == "x86_sse2" && hash.level == "O2";
    if (is_reference && !is_of_recordings(hash.configuration)) found[hash.configuration] = hash.value;
  }
  if (found.empty()) throw std::runtime_error("x86_sse2 was not measured at -O2: there are no hashes to commit");
  return found;
}

struct Options {
  std::string list, budgets, hashes, json;
  bool update_hashes = false;
};

int report(const Options& options) {
  const std::vector<Facts> images = read_all(options.list);
  const Measured measured = measure(images);
  if (options.update_hashes) write_file(options.hashes, to_json(reference(measured.hashes)));

  const Hashes committed = parse_file(options.hashes, parse_hashes);
  std::vector<std::string> broken = broken_images(images, committed);
  const auto add = [&](const std::vector<std::string>& lines) {
    broken.insert(broken.end(), lines.begin(), lines.end());
  };
  add(broken_hashes(committed, measured.hashes));
  const std::vector<Budget> budgets = without(parse_file(options.budgets, parse_budgets), measured.skipped);
  add(broken_budgets(budgets, measured.rows));

  std::printf("%s\n", tables(measured).c_str());
  if (!options.json.empty()) write_file(options.json, to_json(measured, budgets, broken));
  for (const std::string& line : missed_goals(budgets, measured.rows)) std::printf("goal missed: %s\n", line.c_str());
  std::fflush(stdout);
  for (const std::string& line : broken) std::fprintf(stderr, "BROKEN: %s\n", line.c_str());
  if (!broken.empty()) return 1;
  std::printf("kept: %zu budgets, the same bits in %zu hashes, no finding in %zu images and controls\n", budgets.size(),
              measured.hashes.size(), images.size());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Figures of the library on firmware targets; exit code 1 names each promise that is broken.");
  app.name("firmware_report");
  Options options;
  app.add_option("list", options.list, "a file with the names of the files of facts, one a line")->required();
  app.add_option("budgets", options.budgets, "the promised limits, a JSON file")->required();
  app.add_option("hashes", options.hashes, "the promised bits, a JSON file")->required();
  app.add_option("--json", options.json, "write all figures to this file");
  app.add_flag("--update-hashes", options.update_hashes, "write the file of hashes first, from the x86-64 build");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return report(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
