// What was matched, to be seen at a glance.
#pragma once

#include <cstddef>
#include <string>

#include "tools/match/match.hpp"
#include "tools/picture/canvas.hpp"
#include "tools/picture/marks.hpp"

namespace shortshot_bench {

using picture::NamedCloud;

/// Both clouds side by side, with their key points; pairs that agree with the pose joined by strong green lines with a
/// dark rim, others by thin ones. Of many, so many as the eye can follow, evenly chosen: the picture says of how many.
/// `width` is that of the picture in pixels, from 400 on.
picture::Canvas draw_matches(const NamedCloud& a, const NamedCloud& b, const MatchResult& result, std::size_t width);

/// b moved onto a: light orange a, dark blue b, as a's camera sees them and from the side.
picture::Canvas draw_moved(const NamedCloud& a, const NamedCloud& b, const MatchResult& result, std::size_t width);

/// "found: 45 of 120 pairs agree, at 12 of 30 places (by chance: 1e-12 such poses)": a picture's title, and the last
/// line of a report.
std::string verdict_of(const MatchResult& result);

}  // namespace shortshot_bench
