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
#include "paper/options.hpp"
#include "paper/view.hpp"
#include "tools/io/folder_name.hpp"
#include "tools/labels/dataset_files.hpp"

namespace shortshot_bench::paper {

/// `parameters` has "experiment", the command's name, and "units", the keys of all units in their order.
struct Experiment {
  nlohmann::ordered_json parameters;
  std::vector<campaign::Unit> units;
};

/// The results of all units, in their order.
using UnitResults = std::vector<campaign::UnitResult>;

/// Says on stderr which folders hold nothing of this.
void say_unused(const std::vector<std::string>& folders, const std::string& looked_for);

/// What a folder holds. Its name is unlike those of the others.
template <class Sets>
struct Found {
  std::string folder;
  std::string name;
  Sets sets;
};

/// What `open(folder)` finds in the directories, or in the folders right in those that hold nothing themselves; those
/// folders that hold nothing are said on stderr. Throws InputError, which says that `looked_for` was looked for, if
/// there is nothing in one of the directories, and for one that is given twice. open() may change `looked_for`.
template <class Open>
auto open_folders(const std::vector<std::string>& directories, const Open& open, const std::string& looked_for) {
  std::vector<Found<decltype(open(std::string()))>> found;
  const auto add = [&](const std::string& folder) {
    auto sets = open(folder);
    const bool is_any = !sets.empty();
    if (is_any) found.push_back({folder, {}, std::move(sets)});
    return is_any;
  };
  for (const std::string& directory : directories) {
    if (add(directory)) continue;
    std::vector<std::string> unused;
    const std::size_t before = found.size();
    for (const std::string& folder : datasets::folders_in(directory)) {
      if (!add(folder)) unused.push_back(folder);
    }
    if (found.size() == before) throw datasets::not_recognized(directory, looked_for);
    say_unused(unused, looked_for);
  }
  std::vector<std::string> folders;
  for (const auto& f : found) folders.push_back(f.folder);
  const std::vector<std::string> names = unique_folder_names(folders);
  for (std::size_t i = 0; i < found.size(); ++i) found[i].name = names[i];
  return found;
}

/// A unit whose key goes into the parameters.
void add_unit(Experiment& experiment, campaign::Unit unit);

nlohmann::ordered_json to_json(const ViewSettings& settings);

/// With what the options say in place of the protocol's.
ViewSettings with_options(ViewSettings settings, const PaperOptions& options);

/// Names, sizes and layouts.
nlohmann::ordered_json to_json(const std::vector<Configuration>& configurations);

/// "0.123 [0.100, 0.150]".
std::string text_of(const campaign::Interval& interval, int digits);

/// In percent: "91.8 [89.0, 94.1]".
std::string percent_of(const campaign::Interval& interval);

}  // namespace shortshot_bench::paper
