// A file being written of which no failed write goes unnoticed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace shortshot_bench {

// All functions throw InputError when the file cannot be written.
class BinaryFile {
 public:
  explicit BinaryFile(const std::string& path);

  void write(std::string_view bytes);
  void write_floats(const float* values, std::size_t count);  // little-endian on every host
  void close();  // to be called at the end: only then the last bytes are known to be written

 private:
  void check(bool succeeded) const;

  std::string path_;
  std::ofstream stream_;
  std::uint64_t written_bytes_ = 0;
};

/// A file of these bytes, in place of whatever was there. Throws InputError.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace shortshot_bench
