// Files that are either there as a whole or not at all.
#pragma once

#include <string>
#include <string_view>

namespace shortshot_bench::campaign {

/// Makes the folder and those above it, unless they are there. Throws InputError if it cannot.
void make_directory(const std::string& directory);

/// Writes PATH.tmp and gives it its name when all of it is written: whoever reads `path` finds the old content or the
/// new one, also after an interruption. Throws InputError if that fails; the old content is still there then.
void write_atomically(const std::string& path, std::string_view bytes);

}  // namespace shortshot_bench::campaign
