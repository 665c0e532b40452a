// What the experiments have in common: units of work for a campaign, and the parameters that say all about them, so
// that a report can be made of a journal alone.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "paper/campaign/campaign.hpp"
#include "paper/campaign/report.hpp"
#include "paper/campaign/statistics.hpp"
#include "paper/configuration.hpp"
#include "paper/datasets/dataset_files.hpp"
#include "paper/options.hpp"
#include "paper/view.hpp"

namespace shortshot_bench::paper {

/// `parameters` has "experiment", the command's name, and "units", the keys of all units in their order.
struct Experiment {
  nlohmann::ordered_json parameters;
  std::vector<campaign::Unit> units;
};

/// The results of all units, in their order.
using UnitResults = std::vector<campaign::UnitResult>;

/// What `open(folder)` finds in the directories, or in the folders right in those that hold nothing themselves: folder
/// and finding. Throws InputError, which says that `looked_for` was looked for, if there is nothing in one of them.
template <class Open>
auto open_folders(const std::vector<std::string>& directories, const Open& open, const std::string& looked_for) {
  std::vector<std::pair<std::string, decltype(open(std::string()))>> found;
  const auto add = [&](const std::string& folder) {
    auto sets = open(folder);
    if (!sets.empty()) found.emplace_back(folder, std::move(sets));
  };
  for (const std::string& directory : directories) {
    const std::size_t before = found.size();
    add(directory);
    if (found.size() == before) {
      for (const std::string& folder : datasets::folders_in(directory)) add(folder);
    }
    if (found.size() == before) throw datasets::not_recognized(directory, looked_for);
  }
  return found;
}

/// A unit whose key goes into the parameters.
void add_unit(Experiment& experiment, campaign::Unit unit);

nlohmann::ordered_json to_json(const ViewSettings& settings);

/// Names, sizes and layouts.
nlohmann::ordered_json to_json(const std::vector<Configuration>& configurations);

/// "0.123 [0.100, 0.150]".
std::string text_of(const campaign::Interval& interval, int digits);

/// In percent: "91.8 [89.0, 94.1]".
std::string percent_of(const campaign::Interval& interval);

}  // namespace shortshot_bench::paper
