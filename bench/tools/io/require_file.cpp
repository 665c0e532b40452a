#include "tools/io/require_file.hpp"

#include <filesystem>
#include <system_error>

#include "tools/io/input_error.hpp"

namespace shortshot_bench {

bool is_file(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

void require_file(const std::string& path, const std::string& what) {
  if (!is_file(path)) throw InputError::about(path, "expected " + what + ", found no file of this name");
}

}  // namespace shortshot_bench
