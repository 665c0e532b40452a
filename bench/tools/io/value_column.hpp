// Private to the readers: where the values of one channel of a point cloud file lie, one per point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "scalar_type.hpp"

namespace shortshot_bench {

/// Of a table of doubles of this program's own.
inline ByteOrder host_order() {
  const std::uint16_t one = 1;
  unsigned char low = 0;
  std::memcpy(&low, &one, 1);
  return low == 1 ? ByteOrder::little_endian : ByteOrder::big_endian;
}

/// Borrowed: the file's own bytes where they are in rows of one size, else a table that a reader made of them.
struct ValueColumn {
  const char* first = nullptr;
  std::size_t stride_bytes = 0;
  ScalarType type;
  ByteOrder order = ByteOrder::little_endian;

  const char* bytes(std::size_t point) const { return first + point * stride_bytes; }
  double at(std::size_t point) const { return load_scalar(bytes(point), type, order); }
  std::uint64_t bits(std::size_t point) const { return load_bits(bytes(point), type.size_bytes, order); }

  /// The same of a column of 4 bytes.
  std::uint32_t bits32(std::size_t point) const {
    if (order != host_order()) return static_cast<std::uint32_t>(load_bits(bytes(point), 4, order));
    std::uint32_t bits = 0;
    std::memcpy(&bits, bytes(point), sizeof bits);
    return bits;
  }
};

/// Calls use(point, value) with the value of each point as a double.
template <typename Use>
void for_each_value(const ValueColumn& column, std::size_t points, const Use& use) {
  if (column.type.kind == ScalarKind::floating && column.order == host_order()) {  // nearly all files: no bytes apart
    if (column.type.size_bytes == 4) {
      for (std::size_t point = 0; point < points; ++point) {
        float value = 0;
        std::memcpy(&value, column.bytes(point), sizeof value);
        use(point, static_cast<double>(value));
      }
    } else {
      for (std::size_t point = 0; point < points; ++point) {
        double value = 0;
        std::memcpy(&value, column.bytes(point), sizeof value);
        use(point, value);
      }
    }
    return;
  }
  for (std::size_t point = 0; point < points; ++point) use(point, column.at(point));
}

}  // namespace shortshot_bench
