#include "speed/micro/options.hpp"

#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <filesystem>

namespace shortshot_bench {
namespace {

bool is_googles(const std::string& argument) {
  const std::string start = "--benchmark_";
  return argument.compare(0, start.size(), start) == 0;
}

}  // namespace

bool parse_options(int argc, char** argv, MicroOptions& options, int& exit_code) {
  CLI::App app(
      "Times of the library's stages on RGB-D clouds; without a file, on a tabletop scene made up on the spot.");
  app.name("micro");
  app.add_option("clouds", options.clouds, "PCD or PLY files");
  app.add_option("--radius", options.workload.radius, "support radius, in the clouds' unit (meters)")
      ->capture_default_str();
  app.add_option("--leaf", options.workload.leaf,
                 "voxel size of the uniform key points, in the same unit; half of it in whole frames")
      ->capture_default_str();
  app.add_option("--keypoints", options.workload.keypoints, "most key points for single stages, 1 to 100000")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.footer(
      "And Google Benchmark's own flags, with `=`: --benchmark_filter=REGEX, --benchmark_repetitions=N,\n"
      "--benchmark_enable_random_interleaving=true, --benchmark_out=FILE (JSON), --benchmark_list_tests=true, ...");
  std::vector<char*> googles = {argv[0]};
  std::vector<std::string> ours;
  for (int i = argc - 1; i > 0; --i) {  // CLI11 takes them last first
    if (is_googles(argv[i])) {
      googles.insert(googles.begin() + 1, argv[i]);
    } else {
      ours.emplace_back(argv[i]);
    }
  }
  exit_code = 0;
  try {
    app.parse(ours);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : 2;
    return false;
  }
  int count = static_cast<int>(googles.size());
  benchmark::Initialize(&count, googles.data());
  if (benchmark::ReportUnrecognizedArguments(count, googles.data())) {
    exit_code = 2;
    return false;
  }
  return true;
}

std::string cloud_name(const std::string& file) {
  return file.empty() ? "tabletop" : std::filesystem::path(file).stem().string();
}

}  // namespace shortshot_bench
