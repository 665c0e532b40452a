// Long experiments: many independent units of work, done in parallel and recorded one by one, so that an interrupted
// run goes on where it was and a run can be spread over machines.
#pragma once

#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paper/campaign/journal.hpp"
#include "paper/campaign/shard.hpp"

namespace shortshot_bench::campaign {

/// One piece of work. Its result depends on nothing but the unit and the campaign's parameters; run() is called from
/// any thread, at the same time as those of other units. No two units of a campaign have the same key.
struct Unit {
  std::string key;
  std::function<nlohmann::ordered_json()> run;
};

/// Runs the units of this shard that are not in DIRECTORY/journal.jsonl yet and appends each result as soon as it is
/// there; progress goes to `progress` unless that is null. `threads` 0: one for each core.
///
/// If a unit throws, no new ones are begun, those at work are finished and recorded, and std::runtime_error "KEY: what"
/// comes out. Throws InputError for whatever Journal refuses and std::invalid_argument if a key is there twice.
void run_campaign(const std::vector<Unit>& units, const nlohmann::ordered_json& parameters,
                  const std::string& directory, Shard shard, unsigned threads, std::FILE* progress = stderr);

struct UnitResult {
  std::string key;
  nlohmann::ordered_json result;
};

struct Results {
  std::vector<UnitResult> finished{};  // in the order of the units, whenever they were done
  std::vector<std::string> missing{};  // keys of the others, in the same order
};

/// What a journal holds of the units with these keys.
Results results_of(const JournalContent& content, const std::vector<std::string>& keys);

/// The same of a folder's journal. Throws InputError for whatever read_journal() and check_parameters() refuse.
/// A folder without a journal has no results.
Results read_results(const std::string& directory, const std::vector<Unit>& units,
                     const nlohmann::ordered_json& parameters);

}  // namespace shortshot_bench::campaign
