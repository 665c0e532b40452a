// Private to the PLY reader: the text header of a PLY file, checked.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "byte_source.hpp"
#include "scalar_type.hpp"

namespace shortshot_bench {

enum class PlyFormat : std::uint8_t { ascii, binary_little_endian, binary_big_endian };

struct PlyProperty {
  std::string_view name;
  ScalarType type;  // of the value, or of each value of a list
  bool is_list = false;
  ScalarType count_type;  // of the number of values in front of a list
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;
  std::uint64_t line = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::uint64_t columns = 0;  // of a range grid, by obj_info; 0 = not said
  std::uint64_t rows = 0;
};

// Keywords and types count in any case. Reads up to and with the end_header line. The names point into the source.
// Throws InputError.
PlyHeader read_ply_header(ByteSource& source);

}  // namespace shortshot_bench
