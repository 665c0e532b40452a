// Object recognition as an experiment: the paper's configurations against each other, and the ablation of SCSH's sizes.
#pragma once

#include "paper/experiment.hpp"
#include "paper/family/family.hpp"
#include "paper/figures.hpp"

namespace shortshot_bench::paper {

/// A unit for each task and descriptor of the folders' data sets; virtual views are made with two seeds. Throws
/// InputError.
Experiment recognition_experiment(const PaperOptions& options);

/// The same for the members of a family, and CSHOT, by the main split of each data set and one seed.
Experiment ablation_experiment(const PaperOptions& options, const std::vector<FamilyMember>& members);

/// Accuracies like table III, differences to the first descriptor, claims.
Findings recognition_report(const nlohmann::ordered_json& parameters, const UnitResults& results);

/// Accuracies of all members, plots like figure 5 (drawn into `directory`), claims.
Findings ablation_report(const nlohmann::ordered_json& parameters, const UnitResults& results,
                         const std::string& directory);

}  // namespace shortshot_bench::paper
