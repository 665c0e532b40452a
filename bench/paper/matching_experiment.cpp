#include "paper/matching_experiment.hpp"

#include "paper/matching.hpp"
#include "paper/pair_units.hpp"

namespace shortshot_bench::paper {
namespace {

constexpr std::size_t frame_step = 5;  // neighboring frames of a room are many and much alike

}  // namespace

Experiment matching_experiment(const PaperOptions& options) {
  const auto work = [names = options.descriptors](const datasets::ViewPair& pair, const MatchingSettings& settings) {
    return to_json(match_pair(pair, settings, configurations_named(names)));
  };
  return pair_experiment("matching", to_json(configurations_named(options.descriptors)), options, frame_step, work);
}

}  // namespace shortshot_bench::paper
