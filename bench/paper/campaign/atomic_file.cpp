#include "paper/campaign/atomic_file.hpp"

#include <filesystem>
#include <system_error>

#include "tools/io/binary_file.hpp"
#include "tools/io/input_error.hpp"

namespace shortshot_bench::campaign {

void make_directory(const std::string& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw InputError::about(directory, "cannot make the folder: " + error.message());
}

void write_atomically(const std::string& path, std::string_view bytes) {
  const std::string unfinished = path + ".tmp";
  write_file(unfinished, bytes);
  std::error_code error;
  std::filesystem::rename(unfinished, path, error);
  if (error) throw InputError::about(path, "cannot write the file: " + error.message());
}

}  // namespace shortshot_bench::campaign
