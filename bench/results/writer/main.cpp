// results_writer: puts the committed measurements into the documents that show them.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "results/writer/machine.hpp"
#include "results/writer/project.hpp"
#include "tools/io/binary_file.hpp"

namespace {

using namespace shortshot_bench;

/// Writes the documents that differ from what the measurements make; with `check` only says so: 1 if there are any.
int update(const std::string& root, bool check) {
  int stale = 0;
  for (const results::Document& document : results::generate(root)) {
    const bool fresh = document.committed == document.generated;
    std::printf(
        "%s: %s\n", document.path.c_str(),
        fresh ? "shows the measurements" : (check ? "does NOT show the measurements: ./run results" : "written"));
    if (!fresh && check) stale = 1;
    if (!fresh && !check) write_file(document.path, document.generated);
  }
  return stale;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Puts bench/results/*.json and bench/speed/instructions/expected.json into the generated blocks of README.md and "
      "of "
      "bench/RESULTS.md, bench/GOALS.md and bench/firmware/README.md.");
  app.name("results_writer");
  std::string root;
  bool check = false;
  bool record_machine = false;
  app.add_option("project", root, "the project's folder")->required();
  auto* const check_flag = app.add_flag("--check", check, "write nothing; exit code 1 if a document would change");
  app.add_flag("--record-machine", record_machine, "only write bench/results/machine.json: this machine and build")
      ->excludes(check_flag);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (!record_machine) return update(root, check);
    results::write_machine(results::machine_path(root), results::this_machine());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
