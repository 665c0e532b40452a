// Matching rates of pairs of views with a known motion between them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "paper/datasets/pair_sets.hpp"
#include "paper/recognition.hpp"
#include "paper/view.hpp"
#include "tradeoff/candidate.hpp"
#include "tradeoff/items.hpp"

namespace shortshot_bench::tradeoff {

/// All points in one color (0 to 255), under a lamp that stays where it is or is somewhere else in the target.
struct PaintLook {
  std::array<double, 3> rgb;
  bool lamp_moves;
};

/// One way of looking at the pairs of a set.
struct PairLook {
  paper::ViewSettings view;
  float correct_distance = 0.01f;  // of a match from the true place, at most; meters
  std::uint32_t gain_seed = 0;     // not 0: once more, with the target's channels amplified at random
  std::optional<PaintLook> paint;  // both clouds are painted first
  bool reciprocal = false;         // of reciprocal matches, those that are right; else of nearest ones
};

/// The target's colors as a camera with another exposure and white balance has them: gains are log-normal, sigma 15 %
/// for all channels together and 7.5 % for each.
RgbdCloud amplified(RgbdCloud cloud, std::uint32_t seed);

/// Adds what all candidates and formats make of a pair to items called `measure`, and, with another gain, `measure` +
/// gain_suffix. Candidates that need colors are left out where a cloud has none. Throws std::runtime_error.
inline constexpr const char* gain_suffix = ", other gain";
std::vector<Item> match_pair(datasets::ViewPair pair, const std::string& group, const PairLook& look,
                             const std::string& measure, const std::vector<Candidate>& candidates);

/// The same of one candidate and many pairs that share clouds, each of which is described once. `views` are the set's
/// clouds, looked at as `look` says, which must not change them (gain, paint).
std::vector<Item> match_pairs(const datasets::PairSet& set, const std::vector<std::size_t>& pairs,
                              const paper::Views& views, const PairLook& look, const std::string& measure,
                              const Candidate& candidate);

}  // namespace shortshot_bench::tradeoff
