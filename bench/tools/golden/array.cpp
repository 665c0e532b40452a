#include "array.hpp"

#include <cstring>
#include <fstream>
#include <limits>

#include "tools/io/input_error.hpp"

namespace shortshot_bench::golden {
namespace {

template <class Value>
std::vector<Value> values_of(const std::string& bytes) {
  static_assert(sizeof(Value) == 4, "floats and ints of the format have 4 bytes");
  std::vector<Value> values(bytes.size() / sizeof(Value));
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint32_t bits = 0;
    for (std::size_t byte = 0; byte < sizeof bits; ++byte) {
      bits |= std::uint32_t{static_cast<unsigned char>(bytes[sizeof bits * i + byte])} << (8 * byte);
    }
    std::memcpy(&values[i], &bits, sizeof bits);
  }
  return values;
}

}  // namespace

std::size_t item_bytes(const std::string& dtype) {
  if (dtype == "<f4" || dtype == "<i4") return 4;
  return dtype == "u1" ? 1 : 0;
}

std::optional<std::uint64_t> needed_bytes(const std::string& dtype, const std::vector<std::uint64_t>& shape) {
  for (const std::uint64_t extent : shape) {
    if (extent == 0) return 0;
  }
  std::uint64_t bytes = item_bytes(dtype);
  for (const std::uint64_t extent : shape) {
    if (bytes > std::numeric_limits<std::uint64_t>::max() / extent) return std::nullopt;
    bytes *= extent;
  }
  return bytes;
}

std::string shape_text(const std::vector<std::uint64_t>& shape) {
  std::string text = "[";
  for (std::size_t i = 0; i < shape.size(); ++i) text += (i == 0 ? "" : ", ") + std::to_string(shape[i]);
  return text + "]";
}

void read_bytes(Array& array) {
  const std::uint64_t size = needed_bytes(array.dtype, array.shape).value_or(0);
  array.bytes.resize(static_cast<std::size_t>(size));
  std::ifstream file(array.path, std::ios::binary);
  file.read(array.bytes.data(), static_cast<std::streamsize>(array.bytes.size()));
  const auto read = static_cast<std::uint64_t>(file.gcount());
  if (!file || read != size) {
    throw InputError::at_byte(array.path, read, "cannot read on to byte " + std::to_string(size));
  }
}

std::vector<float> floats_of(const Array& array) { return values_of<float>(array.bytes); }

std::vector<std::int32_t> ints_of(const Array& array) { return values_of<std::int32_t>(array.bytes); }

std::vector<std::uint8_t> bytes_of(const Array& array) {
  std::vector<std::uint8_t> values(array.bytes.size());
  if (!values.empty()) std::memcpy(values.data(), array.bytes.data(), values.size());
  return values;
}

}  // namespace shortshot_bench::golden
