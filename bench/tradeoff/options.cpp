#include "tradeoff/options.hpp"

#include <CLI/CLI.hpp>

#include "tools/io/finite_and_positive.hpp"

namespace shortshot_bench::tradeoff {
namespace {

void add_report_options(CLI::App& command, TradeoffOptions& options) {
  command.add_option("--out", options.out, "folder of the results; what it holds already is not done again")
      ->capture_default_str();
  command.add_option("--bytes", options.most_bytes, "which is the best that takes no more?")
      ->check(finite_and_positive);
  command.add_option("--microseconds", options.most_time_us, "which is the best that takes no longer, a key point?")
      ->check(finite_and_positive);
  command.add_option("--instructions", options.instructions, "what `count` had callgrind write");
  command.add_option("--record", options.record, "folder for what bench/TRADEOFF.md shows: bench/results");
  command.add_flag("--check", options.check, "exit 1 if a figure is outside of the bands in bench/tradeoff/bands.json");
}

}  // namespace

bool parse_options(int argc, const char* const* argv, TradeoffOptions& options, int& exit_code) {
  CLI::App app("Bytes, time and accuracy of the whole family of descriptors, on your data. bench/TRADEOFF.md");
  app.name("tradeoff");
  app.require_subcommand(1);
  std::string shard = "1/1";
  CLI::App* const draw = app.add_subcommand("draw", "measure, and draw the map");
  draw->add_option("DATA", options.data, "folders of data sets, or folders that hold such folders")->required();
  draw->add_option("--threads", options.threads, "0: as many as there are cores")->capture_default_str();
  draw->add_option("--shard", shard, "k/n: do the k-th of n shares of the work only; then merge the folders")
      ->check(campaign::refusal_of_shard);
  draw->add_flag("--quick", options.quick, "a small part of the data and of the family, to see that all works");
  add_report_options(*draw, options);
  CLI::App* const merge = app.add_subcommand("merge", "bring the results of shards together, and draw the map");
  merge->add_option("FOLDER", options.data, "folders of results")->required();
  add_report_options(*merge, options);
  CLI::App* const count = app.add_subcommand("count", "run everything once, to be counted by callgrind");
  count->add_flag("--quick", options.quick, "the part of the family that `draw --quick` looks at");
  exit_code = 0;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : 2;
    return false;
  }
  options.command = app.get_subcommands().front()->get_name();
  options.shard = campaign::parse_shard(shard);
  return true;
}

}  // namespace shortshot_bench::tradeoff
