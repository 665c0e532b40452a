// The pairs of clouds of all data sets as units of work, with the settings of the matching protocol.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "paper/datasets/pair_sets.hpp"
#include "paper/experiment.hpp"
#include "paper/matching.hpp"

namespace shortshot_bench::paper {

/// What becomes of a pair, as JSON.
using PairWork = std::function<nlohmann::ordered_json(const datasets::ViewPair&, const MatchingSettings&)>;

/// An experiment of that name, and with what is said of its descriptors, with a unit for each pair in the folders' data
/// sets, or, of frames of a room, for each `frame_step`-th in the order of rotation. Throws InputError.
Experiment pair_experiment(const std::string& name, const nlohmann::ordered_json& descriptors,
                           const PaperOptions& options, std::size_t frame_step, const PairWork& work);

}  // namespace shortshot_bench::paper
