// golden DIR...: is what the library computes what PCL and the paper's authors compute?
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "tool.hpp"

int main(int argc, char** argv) {
  using namespace shortshot_bench::golden;
  CLI::App app{
      "Compares shortshot with golden vectors: for each folder and array the largest differences and whether "
      "they are within tolerance.\nFrames that the neighborhood does not determine are explained; they count as beyond "
      "tolerance but not as differences. So are rows whose votes jump within rounding of a border between cells, if "
      "that can make all the difference.\nExit code 0: all are within, or explained; 1: one is not; 2: bad input."};
  std::vector<std::string> paths;
  bool verbose = false;
  app.add_option("folders", paths, "folders with a case.json; plain files are skipped")->required();
  app.add_flag("-v,--verbose", verbose, "list the rows beyond tolerance, with the kind of their key points");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? within_tolerance : bad_input;
  }
  return run(paths, verbose, std::cout, std::cerr);
}
