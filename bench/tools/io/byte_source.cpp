#include "byte_source.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <ios>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace shortshot_bench {
namespace {

// Only regular files: a directory has no bytes to read, and a device may never end.
std::uintmax_t regular_file_size(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw InputError::about(path, "expected a point cloud file, found no file of this name");
  }
  if (status.type() == std::filesystem::file_type::directory) {
    throw InputError::about(path, "expected a point cloud file, found a directory");
  }
  if (status.type() != std::filesystem::file_type::regular) {
    throw InputError::about(path, "expected a regular file, found something else");
  }
  const std::uintmax_t size_bytes = std::filesystem::file_size(path, error);
  if (error) throw InputError::about(path, "cannot find out the file size: " + error.message());
  return size_bytes;
}

// A sparse file may claim more bytes than there is memory.
std::string zeroed_bytes(const std::string& path, std::uintmax_t size_bytes) {
  try {
    if (size_bytes > std::string().max_size()) throw std::length_error("more than the address space");
    return std::string(static_cast<std::size_t>(size_bytes), '\0');
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  throw InputError::about(path, "the file's " + std::to_string(size_bytes) + " bytes exceed the memory");
}

std::string read_whole_file(const std::string& path) {
  std::string bytes = zeroed_bytes(path, regular_file_size(path));
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw InputError::about(path, "cannot open the file: " + std::generic_category().message(errno));
  }
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const auto read_bytes = static_cast<std::size_t>(file.gcount());
  if (file.bad() || read_bytes != bytes.size()) {
    throw InputError::at_byte(path, read_bytes,
                              "cannot read on to the file's end at byte " + std::to_string(bytes.size()));
  }
  return bytes;
}

// What ends the first line, and so all of them.
std::string_view line_end_of(std::string_view bytes) {
  const std::size_t first = bytes.find_first_of("\r\n");
  if (first == std::string_view::npos) return "\n";
  if (bytes[first] == '\r') {  // a text file copied twice the wrong way has CR CR LF
    const std::size_t next = bytes.find_first_not_of('\r', first);
    return next == std::string_view::npos || bytes[next] != '\n' ? "\r" : "\n";
  }
  const std::string_view behind = bytes.substr(first + 1, 2);
  return behind.substr(0, 1) == "\r" && behind != "\r\n" ? "\n\r" : "\n";
}

}  // namespace

ByteSource::ByteSource(const std::string& path) : ByteSource(path, read_whole_file(path)) {}

ByteSource::ByteSource(std::string name, std::string bytes) : path_(std::move(name)), bytes_(std::move(bytes)) {
  if (bytes_.compare(0, 3, "\xef\xbb\xbf") == 0) begin_bytes_ = 3;
  line_end_ = line_end_of(bytes_);
  rewind();
}

bool ByteSource::next_line(std::string_view& line) {
  const std::string_view rest_of_file = rest();
  if (rest_of_file.empty()) return false;
  const std::size_t length = std::min(rest_of_file.find(line_end_), rest_of_file.size());
  offset_bytes_ += std::min(length + line_end_.size(), rest_of_file.size());
  ++line_number_;
  line = rest_of_file.substr(0, length);
  while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

std::string_view ByteSource::take(std::uint64_t size_bytes, const char* what) {
  if (size_bytes > remaining_bytes()) {
    throw byte_error("expected " + std::to_string(size_bytes) + " bytes of " + what + ", found only " +
                     std::to_string(remaining_bytes()));
  }
  const std::string_view taken = rest().substr(0, static_cast<std::size_t>(size_bytes));
  offset_bytes_ += taken.size();
  return taken;
}

void ByteSource::rewind() {
  offset_bytes_ = begin_bytes_;
  line_number_ = 0;
}

InputError ByteSource::line_error(const std::string& what) const {
  return InputError::at_line(path_, std::max<std::size_t>(line_number_, 1), what);
}

InputError ByteSource::byte_error(const std::string& what) const {
  return InputError::at_byte(path_, offset_bytes_, what);
}

}  // namespace shortshot_bench
