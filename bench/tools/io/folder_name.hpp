// What a folder is called.
#pragma once

#include <string>
#include <vector>

namespace shortshot_bench {

/// The last part of a path, also of "folder/" and ".".
std::string folder_name(const std::string& path);

/// The same of each path, with as many of the folders before it as it takes to tell them apart: "a/views", "b/views".
/// Throws InputError for a folder that is there twice.
std::vector<std::string> unique_folder_names(const std::vector<std::string>& paths);

}  // namespace shortshot_bench
