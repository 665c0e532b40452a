// A whole file in memory with a read position that knows its line and its byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "input_error.hpp"

namespace shortshot_bench {

// The file is read at once so that every size its header claims can be compared with the bytes that are
// really there before memory is asked for. The views handed out live as long as the source.
class ByteSource {
 public:
  explicit ByteSource(const std::string& path);  // throws InputError
  ByteSource(std::string name, std::string bytes);
  ByteSource(const ByteSource&) = delete;  // a copy would leave the views behind
  ByteSource& operator=(const ByteSource&) = delete;

  const std::string& path() const { return path_; }
  std::string_view rest() const { return std::string_view(bytes_).substr(offset_bytes_); }
  std::size_t remaining_bytes() const { return bytes_.size() - offset_bytes_; }
  std::size_t offset_bytes() const { return offset_bytes_; }  // of the next byte
  std::size_t line_number() const { return line_number_; }    // of the line handed out last

  // The next line without its line end; false at the end of the file. Lines end in LF or CR LF, each as it likes, or
  // all in CR, or all in LF CR, as the first one does: so bytes behind a header begin where they should.
  bool next_line(std::string_view& line);

  // The next size_bytes bytes; throws InputError naming `what` when the file ends before.
  std::string_view take(std::uint64_t size_bytes, const char* what);

  void rewind();  // behind a byte order mark, if the file has one

  // To be thrown by the caller: the position is that of the line handed out last, or of the next byte.
  InputError line_error(const std::string& what) const;
  InputError byte_error(const std::string& what) const;

 private:
  std::string path_;
  std::string bytes_;
  std::size_t begin_bytes_ = 0;       // of a byte order mark
  std::string_view line_end_ = "\n";  // CR LF counts as a line end of LF behind a line that ends in CR
  std::size_t offset_bytes_ = 0;
  std::size_t line_number_ = 0;
};

}  // namespace shortshot_bench
