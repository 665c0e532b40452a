// What is promised, and which promises the measured images break.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "firmware/report/facts.hpp"
#include "firmware/report/figures.hpp"

namespace shortshot_bench::firmware {

/// A figure's limit, which breaks if it is exceeded, and what it should be one day. Lists that are empty mean: all.
struct Budget {
  std::string promise;
  std::string figure;
  double at_most;
  double goal;
  std::vector<std::string> targets, levels, configurations, workspaces;
};

using Hashes = std::map<std::string, std::string>;  // by configuration

/// Both throw nlohmann::json::exception or std::runtime_error with what is wrong.
std::vector<Budget> parse_budgets(const std::string& json);
/// Those that are about other configurations, too.
std::vector<Budget> without(const std::vector<Budget>& budgets, const std::vector<std::string>& skipped);
Hashes parse_hashes(const std::string& json);
std::string to_json(const Hashes& hashes);

/// One line for each promise that is broken, or that nothing was measured for.
std::vector<std::string> broken_budgets(const std::vector<Budget>& budgets, const std::vector<Row>& rows);
/// The row with the largest figure that a budget is about; null if there is none.
const Row* worst_row(const Budget& budget, const std::vector<Row>& rows);

/// One line for each goal that is not reached.
std::vector<std::string> missed_goals(const std::vector<Budget>& budgets, const std::vector<Row>& rows);
/// What is computed on recordings, which are not part of the project, has no committed hash: it must be the one of the
/// target "host".
std::vector<std::string> broken_hashes(const Hashes& committed, const std::vector<Hash>& hashes);
/// Is a configuration's hash of recordings?
bool is_of_recordings(const std::string& configuration);
/// Findings in images, programs that did not end well, and negative controls that were not noticed.
std::vector<std::string> broken_images(const std::vector<Facts>& images, const Hashes& committed);

}  // namespace shortshot_bench::firmware
