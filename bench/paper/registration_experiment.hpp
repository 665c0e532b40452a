// Registration as an experiment, and its report.
#pragma once

#include <string>

#include "paper/experiment.hpp"
#include "paper/figures.hpp"

namespace shortshot_bench::paper {

/// A unit for each pair of clouds in the folders' data sets, all frames of a room among them. Throws InputError, and
/// std::runtime_error for names and peers that are none.
Experiment registration_experiment(const PaperOptions& options);

/// Tables, and plots that are drawn into `directory`.
Findings registration_report(const nlohmann::ordered_json& parameters, const UnitResults& results,
                             const std::string& directory);

}  // namespace shortshot_bench::paper
