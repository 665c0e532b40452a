// The golden tool without its command line.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace shortshot_bench::golden {

enum ExitCode : int { within_tolerance = 0, beyond_tolerance = 1, bad_input = 2 };

// Compares every folder in `paths`, prints one table to `out` and what is wrong with a folder to `err`. The
// worst outcome counts: one bad folder does not hide what the others have to say. Plain files are skipped,
// since a shell's "golden/*" names them too.
ExitCode run(const std::vector<std::string>& paths, bool verbose, std::ostream& out, std::ostream& err);

}  // namespace shortshot_bench::golden
