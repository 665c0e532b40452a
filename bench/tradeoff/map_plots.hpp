// The map as plots: what more bytes and more time are worth.
#pragma once

#include <string>

#include "paper/campaign/plot.hpp"
#include "tradeoff/map.hpp"

namespace shortshot_bench::tradeoff {

/// The score of each entry that has one, as points, against its bytes and its time; last the best that as much or less
/// reaches, as a staircase.
campaign::Plot score_by_bytes(const Map& map);
campaign::Plot score_by_time(const Map& map);

/// Draws both into `directory`; at least one entry must have a score. Throws as draw_svg() does.
void draw_scores(const Map& map, const std::string& directory);

}  // namespace shortshot_bench::tradeoff
