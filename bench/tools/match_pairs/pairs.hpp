// Pairs of clouds that show the same, and pairs that do not.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "paper/datasets/pair_sets.hpp"

namespace shortshot_bench {

/// A cloud of a set.
struct CloudOfSet {
  std::size_t set;
  std::size_t cloud;
};

struct PairToTry {
  std::string name;
  CloudOfSet source;
  CloudOfSet target;
  bool is_right;
  datasets::RigidMotion truth;  // target = truth * source; of right pairs
  double rotation_deg;
};

/// Up to `count` pairs of the sets, from all of them in turn, whose cameras differ by `most_degrees` at the most: in
/// each set all rotations in equal parts.
std::vector<PairToTry> right_pairs(const std::vector<datasets::PairSet>& sets, std::size_t count, double most_degrees);

/// Up to `count` pairs that have nothing in common: a source with a target of another subject of its set, where the set
/// has subjects, and in turn with one of the next set. The subject of "scene001 Mario" (objects and scenes) is Mario,
/// who is not in a scene that no pair has him in; that of "mario001 mario002" mario.
std::vector<PairToTry> wrong_pairs(const std::vector<datasets::PairSet>& sets, std::size_t count);

}  // namespace shortshot_bench
