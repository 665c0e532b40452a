// tradeoff draw DATA... | merge FOLDER... | count: the map of bytes, time and accuracy.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>

#include "paper/campaign/atomic_file.hpp"
#include "speed/scaling/json_rows.hpp"
#include "tradeoff/cost.hpp"
#include "tradeoff/experiment.hpp"
#include "tradeoff/map.hpp"
#include "tradeoff/options.hpp"

namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::tradeoff;

/// 0, or 1 if a band is broken.
int check(const paper::Findings& findings, bool quick) {
  const nlohmann::ordered_json bands = scaling::read_json(SHORTSHOT_TRADEOFF_BANDS);
  const auto broken = paper::broken_bands(findings.figures, bands.at(quick ? "quick" : "full"));
  for (const std::string& sentence : broken) std::fprintf(stderr, "BROKEN: %s\n", sentence.c_str());
  if (broken.empty()) std::printf("all figures are within their bands\n");
  return broken.empty() ? 0 : 1;
}

/// The tables for bench/TRADEOFF.md, which ./run results puts there, and its plots.
void record(const campaign::Report& report, const std::string& out, const std::string& folder) {
  nlohmann::ordered_json tables;
  for (const campaign::Section& section : report.sections) {
    for (const campaign::NamedTable& named : section.tables) {
      if (named.name == "all" || named.name == "figures" || named.name.find("measure") == 0) continue;
      tables[named.name] = {{"title", named.table.title()}, {"markdown", named.table.markdown()}};
    }
    for (const std::string& plot : section.plots) {
      std::filesystem::copy_file(out + "/" + plot, folder + "/tradeoff_" + plot,
                                 std::filesystem::copy_options::overwrite_existing);
    }
  }
  campaign::write_atomically(folder + "/tradeoff.json", tables.dump(1) + "\n");
}

void print_best(const Map& map, const TradeoffOptions& options) {
  if (options.most_bytes <= 0.0 && options.most_time_us <= 0.0) return;
  const Entry* const best = best_within(map, options.most_bytes, options.most_time_us);
  if (best == nullptr) {
    std::printf("nothing is that small and that fast\n");
  } else {
    std::printf("the best within these limits: %s, %zu bytes, %.1f us, score %.2f\n", best->name.c_str(),
                best->size_bytes, best->cost.microseconds, best->score);
  }
}

/// The journal in `out` says which units there are.
int report_on(const TradeoffOptions& options) {
  const std::optional<campaign::JournalContent> journal = campaign::read_journal(options.out);
  if (!journal) throw std::runtime_error(options.out + ": no results");
  const std::vector<std::string> keys = journal->parameters.at("units");
  const campaign::Results results = campaign::results_of(*journal, keys);
  if (!results.missing.empty()) {
    std::printf("%zu of %zu units are still to be done; the map is drawn of all of them\n", results.missing.size(),
                keys.size());
    return 0;
  }
  const bool quick = journal->parameters.at("quick");
  const std::vector<Candidate> all = candidates(quick);
  Costs costs = measure_times(all);
  if (!options.instructions.empty()) read_instructions(options.instructions, all, costs);
  const Map map = make_map(journal->parameters, results.finished, costs, SHORTSHOT_FIRMWARE_RESULTS);
  const paper::Findings findings = report_of(map, journal->parameters, options.out);
  campaign::write_report(findings.report, options.out);
  for (const campaign::Section& section : findings.report.sections) {
    for (const campaign::NamedTable& named : section.tables) {
      if (named.name != "all" && named.name != "figures") std::printf("%s\n", named.table.text().c_str());
    }
  }
  print_best(map, options);
  if (!options.record.empty()) record(findings.report, options.out, options.record);
  std::printf("written: %s/report.md, report.json, *.csv, *.svg\n", options.out.c_str());
  return options.check ? check(findings, quick) : 0;
}

int run(const TradeoffOptions& options) {
  if (options.command == "count") {
    count_instructions(candidates(options.quick));
    return 0;
  }
  if (options.command == "merge") {
    campaign::merge_journals(options.data, options.out);
  } else {
    const paper::Experiment experiment = tradeoff_experiment(options);
    campaign::run_campaign(experiment.units, experiment.parameters, options.out, options.shard, options.threads);
  }
  return report_on(options);
}

}  // namespace

int main(int argc, char** argv) {
  TradeoffOptions options;
  int exit_code = 0;
  if (!parse_options(argc, argv, options, exit_code)) return exit_code;
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
