#include "tools/io/folder_name.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "tools/io/input_error.hpp"

namespace shortshot_bench {
namespace {

/// The folders on the way to this one, without a last empty part.
std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  for (const auto& part : std::filesystem::absolute(path).lexically_normal()) parts.push_back(part.string());
  if (parts.size() > 1 && parts.back().empty()) parts.pop_back();
  return parts;
}

std::string last(const std::vector<std::string>& parts, std::size_t count) {
  std::string name = parts.back();
  for (std::size_t i = 1; i < std::min(count, parts.size()); ++i) name = parts[parts.size() - 1 - i] + "/" + name;
  return name;
}

}  // namespace

std::string folder_name(const std::string& path) { return last(parts_of(path), 1); }

std::vector<std::string> unique_folder_names(const std::vector<std::string>& paths) {
  std::set<std::vector<std::string>> different;
  std::size_t deepest = 1;
  for (const std::string& path : paths) {
    const std::vector<std::string> parts = parts_of(path);
    if (!different.insert(parts).second) throw InputError::about(path, "this folder is given twice");
    deepest = std::max(deepest, parts.size());
  }
  for (std::size_t count = 1;; ++count) {
    std::vector<std::string> names;
    for (const std::string& path : paths) names.push_back(last(parts_of(path), count));
    if (std::set<std::string>(names.begin(), names.end()).size() == names.size() || count >= deepest) return names;
  }
}

}  // namespace shortshot_bench
