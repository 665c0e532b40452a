// One array of a golden case: a bare little-endian file whose type and shape stand in case.json.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace shortshot_bench::golden {

struct Array {
  std::string name;
  std::string dtype;  // "<f4", "<i4" or "u1"
  std::vector<std::uint64_t> shape;
  std::string path;
  std::string bytes;  // what the file holds; empty until read_bytes()

  std::uint64_t rows() const { return shape.empty() ? 0 : shape.front(); }
};

// Bytes of one element; 0 for a type that the format does not have.
std::size_t item_bytes(const std::string& dtype);

// Bytes of all elements; nothing if 64 bits cannot count them: a shape is read from a file and may be
// anything.
std::optional<std::uint64_t> needed_bytes(const std::string& dtype, const std::vector<std::uint64_t>& shape);

std::string shape_text(const std::vector<std::uint64_t>& shape);  // "[36, 32]"

// Reads the file, whose size must have been compared with the shape before. Throws InputError.
void read_bytes(Array& array);

// The elements of an array that was read and has the type that the name says; on every host.
std::vector<float> floats_of(const Array& array);
std::vector<std::int32_t> ints_of(const Array& array);
std::vector<std::uint8_t> bytes_of(const Array& array);

}  // namespace shortshot_bench::golden
