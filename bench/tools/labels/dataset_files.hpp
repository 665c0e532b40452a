// Shared by the readers of the data sets: what they refuse in the same words.
#pragma once

#include <string>
#include <vector>

#include "tools/io/input_error.hpp"
#include "tools/io/require_file.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::datasets {

/// False also for what cannot be asked about.
bool is_folder(const std::string& path);

/// require_file() of many; says how many are missing.
void require_files(const std::vector<std::string>& paths, const std::string& what);

/// In meters, where a unit of the cloud is `meters` long.
RgbdCloud scaled(RgbdCloud cloud, double meters);

/// read_cloud(), and InputError for a cloud without colors.
RgbdCloud read_colored_cloud(const std::string& path);

/// The folders right in this one, by name; none if it is no folder.
std::vector<std::string> folders_in(const std::string& directory);

/// To be thrown by the caller: the folder holds none of `looked_for`, or is none.
InputError not_recognized(const std::string& directory, const std::string& looked_for);

}  // namespace shortshot_bench::datasets
