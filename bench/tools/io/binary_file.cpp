#include "binary_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "input_error.hpp"

namespace shortshot_bench {

BinaryFile::BinaryFile(const std::string& path) : path_(path) {
  errno = 0;
  stream_.open(path, std::ios::binary | std::ios::trunc);
  check(stream_.is_open());
}

void BinaryFile::write(std::string_view bytes) {
  errno = 0;
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  check(stream_.good());
  written_bytes_ += bytes.size();
}

void BinaryFile::write_floats(const float* values, std::size_t count) {
  constexpr std::size_t value_bytes = 4;
  static_assert(sizeof(float) == value_bytes, "the files hold 4-byte floats");
  std::array<char, 1024 * value_bytes> block;
  for (std::size_t begin = 0; begin < count; begin += block.size() / value_bytes) {
    const std::size_t in_block = std::min(count - begin, block.size() / value_bytes);
    for (std::size_t i = 0; i < in_block; ++i) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, values + begin + i, value_bytes);
      for (std::size_t byte = 0; byte < value_bytes; ++byte) {
        block[value_bytes * i + byte] = static_cast<char>((bits >> (8 * byte)) & 0xffU);
      }
    }
    write({block.data(), value_bytes * in_block});
  }
}

void BinaryFile::close() {
  errno = 0;
  stream_.close();  // flushes; sets failbit if either fails, as on a full disk
  check(stream_.good());
}

void BinaryFile::check(bool succeeded) const {
  if (succeeded) return;
  const std::string reason = errno != 0 ? std::generic_category().message(errno) : "unknown reason";
  throw InputError::at_byte(path_, written_bytes_, "cannot write the file: " + reason);
}

void write_file(const std::string& path, std::string_view bytes) {
  BinaryFile file(path);
  file.write(bytes);
  file.close();
}

}  // namespace shortshot_bench
