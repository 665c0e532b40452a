// Things that stand on a table, each another one.
#pragma once

#include <vector>

#include "tools/scene/random.hpp"
#include "tools/scene/solids.hpp"

namespace shortshot_bench {
namespace scene_detail {

enum class Kind { box, can, ball, bowl, mug };

// One at the origin, without a mug's handle.
Solid draw_object(Random& random, Kind kind);

// How much room it needs.
double footprint_radius(const Solid& s, Kind kind);

void add_mug_handle(const Solid& mug, std::vector<Solid>& solids);

}  // namespace scene_detail
}  // namespace shortshot_bench
