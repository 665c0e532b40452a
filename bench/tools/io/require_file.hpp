// Files that must be there before they are read.
#pragma once

#include <string>

namespace shortshot_bench {

/// False also for what cannot be asked about.
bool is_file(const std::string& path);

/// Throws InputError unless `path` is a regular file; `what` says what it should have been ("a depth image").
void require_file(const std::string& path, const std::string& what);

}  // namespace shortshot_bench
