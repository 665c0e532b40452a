#include "tools/labels/dataset_files.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "tools/io/read_cloud.hpp"

namespace shortshot_bench::datasets {

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

void require_files(const std::vector<std::string>& paths, const std::string& what) {
  std::vector<std::string> missing;
  std::copy_if(paths.begin(), paths.end(), std::back_inserter(missing),
               [](const auto& path) { return !is_file(path); });
  if (missing.empty()) return;
  const std::string count = std::to_string(missing.size()) + " of " + std::to_string(paths.size());
  throw InputError::about(missing.front(),
                          "expected " + what + ", found no file of this name; " + count + " are missing");
}

RgbdCloud scaled(RgbdCloud cloud, double meters) {
  const auto factor = static_cast<float>(meters);
  for (float& value : cloud.xyz) value *= factor;
  for (float& value : cloud.viewpoint) value *= factor;
  return cloud;
}

RgbdCloud read_colored_cloud(const std::string& path) {
  RgbdCloud cloud = read_cloud(path);
  if (cloud.is_shifted()) {  // each cloud by its own origin: no known pose would fit
    throw InputError::about(path, "expected coordinates that floats are fine enough for, found some far away");
  }
  if (!cloud.has_colors()) throw InputError::about(path, "expected a cloud with colors, found none");
  return cloud;
}

std::vector<std::string> folders_in(const std::string& directory) {
  std::vector<std::string> folders;
  std::error_code is_none;
  for (const auto& entry : std::filesystem::directory_iterator(directory, is_none)) {
    if (is_folder(entry.path().string())) folders.push_back(entry.path().string());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

InputError not_recognized(const std::string& directory, const std::string& looked_for) {
  const std::string found = is_folder(directory) ? "none of them" : "no folder of this name";
  return InputError::about(directory, "expected a folder with " + looked_for + ", found " + found);
}

}  // namespace shortshot_bench::datasets
