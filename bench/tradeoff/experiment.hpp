// All that is measured for the map, as units of a campaign.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "paper/experiment.hpp"
#include "tradeoff/options.hpp"

namespace shortshot_bench::tradeoff {

/// Units for the data sets in the folders: pairs of views, labeled views and meshes. Throws InputError.
paper::Experiment tradeoff_experiment(const TradeoffOptions& options);

}  // namespace shortshot_bench::tradeoff
