// The paper's experiments: paper matching|registration|recognition|ablation DATA... and paper merge FOLDER...
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "paper/campaign/atomic_file.hpp"
#include "paper/matching_experiment.hpp"
#include "paper/options.hpp"
#include "paper/recognition_experiment.hpp"
#include "paper/registration_experiment.hpp"
#include "speed/scaling/json_rows.hpp"

namespace {

using namespace shortshot_bench;
using namespace shortshot_bench::paper;

Experiment experiment_of(const PaperOptions& options) {
  if (options.command == "matching") return matching_experiment(options);
  if (options.command == "registration") return registration_experiment(options);
  if (options.command == "recognition") return recognition_experiment(options);
  return ablation_experiment(options, family());
}

Findings findings_of(const nlohmann::ordered_json& parameters, const UnitResults& results, const std::string& out) {
  const std::string experiment = parameters.at("experiment");
  if (experiment == "matching") return matching_report(parameters, results, out);
  if (experiment == "registration") return registration_report(parameters, results, out);
  if (experiment == "recognition") return recognition_report(parameters, results);
  return ablation_report(parameters, results, out);
}

/// 0, or 1 if a band is broken.
int check(const Findings& findings) {
  const nlohmann::ordered_json& parameters = findings.report.parameters;
  const nlohmann::ordered_json bands = scaling::read_json(SHORTSHOT_PAPER_BANDS);
  const char* const mode = parameters.at("quick").get<bool>() ? "quick" : "full";
  const std::vector<std::string> broken =
      broken_bands(findings.figures, bands.at(parameters.at("experiment")).at(mode));
  for (const std::string& sentence : broken) std::fprintf(stderr, "BROKEN: %s\n", sentence.c_str());
  if (broken.empty()) std::printf("all figures are within their bands\n");
  return broken.empty() ? 0 : 1;
}

/// The journal in `out` says which units there are.
int report_on(const std::string& out, bool checked) {
  const std::optional<campaign::JournalContent> journal = campaign::read_journal(out);
  if (!journal) throw std::runtime_error(out + ": no results");
  const std::vector<std::string> keys = journal->parameters.at("units");
  const campaign::Results results = campaign::results_of(*journal, keys);
  if (!results.missing.empty()) {
    std::printf("%zu of %zu units are still to be done; the report is made of all of them\n", results.missing.size(),
                keys.size());
    return 0;
  }
  const Findings findings = findings_of(journal->parameters, results.finished, out);
  campaign::write_report(findings.report, out);
  for (const campaign::Section& section : findings.report.sections) {
    for (const campaign::NamedTable& named : section.tables) {
      if (named.name.find("pairs") == std::string::npos && named.name != "figures") {
        std::printf("%s\n", named.table.text().c_str());
      }
    }
  }
  std::printf("written: %s/report.md, report.json, *.csv\n", out.c_str());
  return checked ? check(findings) : 0;
}

int run(const PaperOptions& options) {
  if (options.command == "merge") {
    campaign::merge_journals(options.data, options.out);
  } else {
    const Experiment experiment = experiment_of(options);
    campaign::run_campaign(experiment.units, experiment.parameters, options.out, options.shard, options.threads);
  }
  return report_on(options.out, options.check);
}

}  // namespace

int main(int argc, char** argv) {
  PaperOptions options;
  int exit_code = 0;
  if (!parse_options(argc, argv, options, exit_code)) return exit_code;
  try {
    return run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
