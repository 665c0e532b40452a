// Key-point matching as an experiment, and its report.
#pragma once

#include "paper/experiment.hpp"
#include "paper/figures.hpp"

namespace shortshot_bench::paper {

/// A unit for each pair of clouds in the folders' data sets. Throws InputError.
Experiment matching_experiment(const PaperOptions& options);

/// Tables, plots like figures 3 and 4 (drawn into `directory`) and claims.
Findings matching_report(const nlohmann::ordered_json& parameters, const UnitResults& results,
                         const std::string& directory);

}  // namespace shortshot_bench::paper
