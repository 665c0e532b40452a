// The map as plots: what more bytes and more time are worth.
#pragma once

#include <string>

#include "tradeoff/map.hpp"

namespace shortshot_bench::tradeoff {

/// Draws score_by_bytes.svg and score_by_time.svg into `directory`; at least one entry must have a
/// score. Throws as draw_svg() does.
void draw_scores(const Map& map, const std::string& directory);

}  // namespace shortshot_bench::tradeoff
