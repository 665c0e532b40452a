#include "tradeoff/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "paper/truth.hpp"
#include "tools/scene/random.hpp"
#include "tradeoff/paint.hpp"

namespace shortshot_bench::tradeoff {
namespace {

using paper::Described;
using paper::Truth;
using paper::View;

campaign::Fraction count_nearest(const Described& source, const Described& target, const Truth& truth) {
  const paper::RightMatches count = paper::count_right_nearest(source, target, truth);
  return {static_cast<double>(count.right), static_cast<double>(count.of)};
}

/// The share of reciprocal matches that are right: each pair counts as much, however many it has.
campaign::Fraction count_reciprocal(const Described& source, const Described& target, const Truth& truth) {
  std::vector<shortshot::MatchedPair> pairs;
  require(shortshot::reciprocal_correspondences(source.rows().descriptors, target.rows().descriptors, pairs));
  const auto right = std::count_if(pairs.begin(), pairs.end(),
                                   [&](const shortshot::MatchedPair& p) { return truth.is_right(p.source, p.target); });
  return {pairs.empty() ? 0.0 : static_cast<double>(right) / static_cast<double>(pairs.size()), 1.0};
}

campaign::Fraction count(const Described& source, const Described& target, const Truth& truth, const PairLook& look) {
  return look.reciprocal ? count_reciprocal(source, target, truth) : count_nearest(source, target, truth);
}

/// Painted, with the lamp at the right of the source's camera; moved, at the left of the target's.
datasets::ViewPair painted_pair(datasets::ViewPair pair, const PaintLook& paint, std::uint32_t seed) {
  const paper::Place q = paper::moved(pair.truth, paper::place_of(lamp_at_right));
  const shortshot::Point at_rest{static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2])};
  pair.source = painted(std::move(pair.source), {paint.rgb, lamp_at_right, seed});
  pair.target = painted(std::move(pair.target), {paint.rgb, paint.lamp_moves ? lamp_at_left : at_rest, seed + 1});
  return pair;
}

/// A source, which is described once, and the targets that it is matched with.
struct Target {
  View view;
  Truth truth;
  Item item;
};

}  // namespace

RgbdCloud amplified(RgbdCloud cloud, std::uint32_t seed) {
  Random random(seed);
  const double common = 0.15 * random.normal();
  double gains[3];
  for (double& gain : gains) gain = std::exp(common + 0.075 * random.normal());
  for (std::size_t i = 0; i < cloud.rgb.size(); ++i) {
    cloud.rgb[i] = static_cast<std::uint8_t>(std::min(255.0, std::round(gains[i % 3] * cloud.rgb[i])));
  }
  return cloud;
}

std::vector<Item> match_pair(datasets::ViewPair pair, const std::string& group, const PairLook& look,
                             const std::string& measure, const std::vector<Candidate>& candidates) {
  if (look.paint) pair = painted_pair(std::move(pair), *look.paint, look.view.seed);
  const View source(pair.source, look.view);
  std::vector<Target> targets;
  const auto add = [&](const RgbdCloud& cloud, const std::string& of_measure) {
    View view(cloud, look.view);
    Truth truth(pair.truth, source, view, look.correct_distance);
    targets.push_back({std::move(view), std::move(truth), {of_measure, pair.name, group, {}}});
  };
  add(pair.target, measure);
  if (look.gain_seed != 0) add(amplified(pair.target, look.gain_seed), measure + gain_suffix);
  for (const Candidate& candidate : candidates) {
    if (candidate.configuration.needs_colors && !(source.has_colors() && pair.target.has_colors())) continue;
    const Described of_source = source.describe(candidate.configuration);
    for (Target& target : targets) {
      const Described of_target = target.view.describe(candidate.configuration);
      for (const Storage& storage : candidate.storages) {
        target.item.counts[entry_name(candidate, storage)] =
            count(coded(of_source, storage), coded(of_target, storage), target.truth, look);
      }
    }
  }
  std::vector<Item> items;
  for (Target& target : targets) items.push_back(std::move(target.item));
  return items;
}

std::vector<Item> match_pairs(const datasets::PairSet& set, const std::vector<std::size_t>& pairs,
                              const paper::Views& views, const PairLook& look, const std::string& measure,
                              const Candidate& candidate) {
  std::vector<Item> items;
  std::map<std::size_t, Described> floats;
  for (const std::size_t i : pairs) {
    items.push_back({measure, set.pair_names[i], set.groups[i], {}});
    for (const std::size_t cloud : {set.sources[i], set.targets[i]}) {
      if (floats.count(cloud) == 0) floats[cloud] = views[cloud].describe(candidate.configuration);
    }
  }
  std::vector<std::map<std::size_t, Described>> codes;  // of each storage
  for (const Storage& storage : candidate.storages) {
    auto& of_clouds = codes.emplace_back();
    for (const auto& [cloud, described] : floats) of_clouds[cloud] = coded(described, storage);
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::size_t source = set.sources[pairs[k]];
    const std::size_t target = set.targets[pairs[k]];
    const Truth truth(set.truths[pairs[k]], views[source], views[target], look.correct_distance);
    for (std::size_t s = 0; s < codes.size(); ++s) {
      items[k].counts[entry_name(candidate, candidate.storages[s])] =
          count(codes[s][source], codes[s][target], truth, look);
    }
  }
  return items;
}

}  // namespace shortshot_bench::tradeoff
