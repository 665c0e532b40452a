// What a folder is called.
#pragma once

#include <string>

namespace shortshot_bench {

/// The last part of a path, also of "folder/" and ".".
std::string folder_name(const std::string& path);

}  // namespace shortshot_bench
