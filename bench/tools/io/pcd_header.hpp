// Private to the PCD reader: the text header of a PCD file, checked.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "byte_source.hpp"
#include "scalar_type.hpp"

namespace shortshot_bench {

enum class PcdData : std::uint8_t { ascii, binary, binary_compressed };

struct PcdField {
  std::string_view name;
  ScalarType type;
  std::uint64_t count = 1;         // values per point
  std::uint64_t first_value = 0;   // values of a point before this field
  std::uint64_t offset_bytes = 0;  // bytes of a point before this field

  std::uint64_t size_bytes() const { return count * type.size_bytes; }
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t fields_line = 0;
  std::uint64_t width = 0;
  std::uint64_t height = 1;
  std::uint64_t points = 0;  // = width * height
  std::uint64_t values_per_point = 0;
  std::uint64_t point_size_bytes = 0;
  std::array<double, 3> viewpoint{0, 0, 0};
  PcdData data = PcdData::ascii;
};

// True, in any case, for the words that start the lines of a PCD header.
bool is_pcd_keyword(std::string_view word);

// Reads up to and with the DATA line. The names point into the source. Throws InputError.
PcdHeader read_pcd_header(ByteSource& source);

}  // namespace shortshot_bench
