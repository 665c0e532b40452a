// Descriptors of others: a program, in whatever language, that is called once for each cloud.
//
// `PROGRAM IN OUT` reads the file IN, whose first line is "POINTS KEYPOINTS RADIUS NORMAL_RADIUS" (meters), followed by
// floats in the machine's order: x y z and the normal's x y z (NaN: none) of each point, then x y z of each key point.
// It writes OUT: the line "KEYPOINTS SIZE MICROSECONDS" and SIZE floats for each key point; a row with a value that is
// not finite takes no part. MICROSECONDS is what describing all took on one core, without normals.
#pragma once

#include <string>

#include "paper/contenders.hpp"
#include "paper/view.hpp"

namespace shortshot_bench::paper {

/// What the program makes of a view. The last answers of each program are kept: pairs share clouds. May be called from
/// many threads. Throws std::runtime_error if the program fails or writes something else.
TimedRows describe_by(const std::string& program, const View& view);

}  // namespace shortshot_bench::paper
