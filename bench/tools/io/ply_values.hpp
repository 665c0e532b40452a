// Private to the PLY reader: the values of a PLY body one after the other, from text or from bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "byte_source.hpp"
#include "ply_header.hpp"
#include "scalar_type.hpp"
#include "text_rows.hpp"

namespace shortshot_bench {

// Both classes offer the same functions, for the templates in ply_reader.cpp. All throw InputError. A row is
// one vertex, face, ...
class PlyTextValues {
 public:
  explicit PlyTextValues(ByteSource& source) : source_(source) {}

  void expect_room_for_rows(const PlyElement& element) const;
  void begin_row(const PlyElement& element, std::uint64_t row);
  double read(const PlyProperty& property);
  void skip(const PlyProperty& property);
  std::uint64_t read_length(const PlyProperty& list);  // its values are to be read or skipped, one by one
  void end_row();                                      // a row is a line of its own
  InputError error(const std::string& what) const { return source_.line_error(what); }

 private:
  Word next_word(std::string_view what);

  ByteSource& source_;
  std::vector<std::string_view> words_;
  std::size_t next_ = 0;
};

class PlyBinaryValues {
 public:
  PlyBinaryValues(ByteSource& source, ByteOrder order) : source_(source), order_(order) {}

  void expect_room_for_rows(const PlyElement& element) const;
  void begin_row(const PlyElement&, std::uint64_t) {}
  double read(const PlyProperty& property);
  std::string_view read_bytes(const PlyProperty& property);
  void skip(const PlyProperty& property);
  std::uint64_t read_length(const PlyProperty& list);
  void end_row() {}
  InputError error(const std::string& what) const { return source_.byte_error(what); }
  ByteOrder order() const { return order_; }

 private:
  ByteSource& source_;
  ByteOrder order_;
};

}  // namespace shortshot_bench
