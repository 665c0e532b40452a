// The number types of binary point cloud files and how their bytes become values.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shortshot_bench {

enum class ScalarKind : std::uint8_t { signed_integer, unsigned_integer, floating };
enum class ByteOrder : std::uint8_t { little_endian, big_endian };

struct ScalarType {
  ScalarKind kind = ScalarKind::floating;
  std::uint8_t size_bytes = 4;  // 1, 2, 4 or 8; floating only 4 or 8
};

// Put together byte by byte: needs no alignment and gives the same on every host.
inline std::uint64_t load_bits(const char* bytes, std::size_t size_bytes, ByteOrder order) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size_bytes; ++i) {
    const std::size_t index = order == ByteOrder::big_endian ? i : size_bytes - 1 - i;
    bits = (bits << 8) | static_cast<unsigned char>(bytes[index]);
  }
  return bits;
}

// `bits` holds a value of the size of To in its low bytes.
template <typename To, typename SameSizeBits>
To bit_cast_low(std::uint64_t bits) {
  static_assert(sizeof(To) == sizeof(SameSizeBits), "the bits and the value differ in size");
  const auto low_bits = static_cast<SameSizeBits>(bits);
  To value;
  std::memcpy(&value, &low_bits, sizeof value);
  return value;
}

inline double load_scalar(const char* bytes, ScalarType type, ByteOrder order) {
  const std::uint64_t bits = load_bits(bytes, type.size_bytes, order);
  switch (type.kind) {
    case ScalarKind::unsigned_integer: return static_cast<double>(bits);
    case ScalarKind::signed_integer: {
      const std::uint64_t sign_bit = std::uint64_t{1} << (8 * type.size_bytes - 1);
      return static_cast<double>(bit_cast_low<std::int64_t, std::uint64_t>((bits ^ sign_bit) - sign_bit));
    }
    case ScalarKind::floating: break;
  }
  return type.size_bytes == 4 ? static_cast<double>(bit_cast_low<float, std::uint32_t>(bits))
                              : bit_cast_low<double, std::uint64_t>(bits);
}

// A plain cast of a finite double beyond the float range is undefined; here it becomes an infinity.
inline float to_float(double value) {
  constexpr auto largest = static_cast<double>(std::numeric_limits<float>::max());
  if (std::abs(value) > largest && std::isfinite(value)) {
    return std::copysign(std::numeric_limits<float>::infinity(), value > 0 ? 1.0F : -1.0F);
  }
  return static_cast<float>(value);
}

}  // namespace shortshot_bench
