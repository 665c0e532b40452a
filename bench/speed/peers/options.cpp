#include "speed/peers/options.hpp"

#include <CLI/CLI.hpp>

namespace shortshot_bench::peers {

bool parse_options(int argc, const char* const* argv, Options& options, int& exit_code) {
  CLI::App app(
      "Compare shortshot with PCL, Open3D and a naive transcription, from raw points to descriptors: time and memory, "
      "in "
      "one run on one thread. Without a file, on a tabletop scene made up on the spot.");
  app.name("peers");
  app.add_option("clouds", options.clouds, "PCD or PLY files with colors");
  // The library refuses what is no length: nan, inf, zero and below.
  app.add_option("--radius", options.radius, "support radius, in the clouds' unit (meters)")->capture_default_str();
  app.add_option("--leaf", options.leaf, "voxel size of the sampling that key points are drawn from")
      ->capture_default_str();
  app.add_option("--rounds", options.rounds, "times that everything is measured, 1 to 1000")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_flag("!--no-fpfh", options.fpfh, "leave PCL's FPFH out, which takes about a minute per cloud");
  app.add_option("--json", options.json, "write the comparisons to this file");
  app.add_option("--goals", options.goals, "write the goals and what was measured to this file");
  exit_code = 0;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : 2;
    return false;
  }
  return true;
}

}  // namespace shortshot_bench::peers
