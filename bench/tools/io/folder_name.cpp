#include "tools/io/folder_name.hpp"

#include <filesystem>

namespace shortshot_bench {

std::string folder_name(const std::string& path) {
  const std::filesystem::path whole = std::filesystem::absolute(path).lexically_normal();
  const std::filesystem::path name = whole.has_filename() ? whole.filename() : whole.parent_path().filename();
  return name.string();
}

}  // namespace shortshot_bench
