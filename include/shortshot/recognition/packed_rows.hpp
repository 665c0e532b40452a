// shortshot/recognition/packed_rows.hpp: borrowed rows of bytes, nibbles and bits, which are matched as rows of floats
// are. Hosted only.
//
// Their distances are integers before they become Match::distance, hence the same on every machine, and ties are
// exactly that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../base/simd.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "../store/binary.hpp"
#include "../store/nibbles.hpp"
#include "../store/quantize.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// For up to 66051 bytes. In pieces of a fixed length, which compilers turn into lanes at -O2, too.
[[nodiscard]] inline std::uint32_t squared_byte_distance(const std::uint8_t* a, const std::uint8_t* b,
                                                         std::size_t size) noexcept {
  constexpr std::size_t width = 32;
  std::uint32_t sum = 0;
  std::size_t i = 0;
  for (; i + width <= size; i += width) {
    std::int32_t part = 0;
    for (std::size_t k = 0; k < width; ++k) {
      const auto difference = static_cast<std::int16_t>(a[i + k] - b[i + k]);
      part += difference * difference;
    }
    sum += static_cast<std::uint32_t>(part);
  }
  for (; i < size; ++i) {
    const std::int32_t difference = std::int32_t{a[i]} - std::int32_t{b[i]};
    sum += static_cast<std::uint32_t>(difference * difference);
  }
  return sum;
}

/// Can rows of bytes at these places be compared? Sums of as many squares as this fit 32 bits.
template <class Rows>
[[nodiscard, gnu::always_inline]] inline bool fit(const Rows& a, const std::uint8_t* of_a, const Rows& b,
                                                  const std::uint8_t* of_b) noexcept {
  return a.size == b.size && a.size > 0 && a.size <= 66051 && (a.count == 0 || of_a != nullptr) &&
         (b.count == 0 || of_b != nullptr);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// `count` descriptors of `size` bytes each (1 to 66051), row by row without gaps, as quantize() makes them. Borrowed.
/// Their distance is the L2 distance of the descriptors, ByteDescriptor's step times the root of the sum of squares.
struct ByteRows {
  static constexpr float step = 1.0f / 512.0f;  ///< that of ByteDescriptor<D>, whatever D

  const std::uint8_t* values;  ///< count * size
  std::size_t count;           ///< number of rows
  std::size_t size;            ///< bytes in a row
  const Status* status;        ///< one per row: those that are not ok are left out; null: all are ok

  [[nodiscard, gnu::always_inline]] bool fits(const ByteRows& other) const noexcept {
    return detail::fit(*this, values, other, other.values);
  }
  /// The squared distance of the bytes.
  [[nodiscard, gnu::always_inline]] std::uint32_t compare(std::size_t row, const ByteRows& other,
                                                          std::size_t others_row) const noexcept {
    return detail::squared_byte_distance(values + row * size, other.values + others_row * size, size);
  }
  [[nodiscard, gnu::always_inline]] float distance(std::uint32_t compared) const noexcept {
    return step * extend::simd::sqrt(static_cast<float>(compared));
  }
};

/// `count` descriptors of `size` bytes of nibbles each (1 to 66051), row by row without gaps, as quantize() makes them,
/// all with steps of the same length. Borrowed. Their distance is the L2 distance of the descriptors, `step` times the
/// root of the sum of squares.
struct NibbleRows {
  const std::uint8_t* bytes;  ///< count * size
  std::size_t count;          ///< number of rows
  std::size_t size;           ///< bytes in a row
  float step;                 ///< NibbleDescriptor's
  const Status* status;       ///< one per row: those that are not ok are left out; null: all are ok

  [[nodiscard, gnu::always_inline]] bool fits(const NibbleRows& other) const noexcept {
    return detail::fit(*this, bytes, other, other.bytes) && step == other.step;
  }
  /// The squared distance in steps.
  [[nodiscard, gnu::always_inline]] std::uint32_t compare(std::size_t row, const NibbleRows& other,
                                                          std::size_t others_row) const noexcept {
    return detail::squared_nibble_distance(bytes + row * size, other.bytes + others_row * size, size);
  }
  [[nodiscard, gnu::always_inline]] float distance(std::uint32_t compared) const noexcept {
    return step * extend::simd::sqrt(static_cast<float>(compared));
  }
};

/// `count` descriptors of `size` bytes of bits each (1 to 66051), row by row without gaps, as binarize() makes them.
/// Borrowed. Their distance is the number of bits in which they differ (Hamming).
struct BitRows {
  const std::uint8_t* bytes;  ///< count * size
  std::size_t count;          ///< number of rows
  std::size_t size;           ///< bytes in a row
  const Status* status;       ///< one per row: those that are not ok are left out; null: all are ok

  [[nodiscard, gnu::always_inline]] bool fits(const BitRows& other) const noexcept {
    return detail::fit(*this, bytes, other, other.bytes);
  }
  [[nodiscard, gnu::always_inline]] std::uint32_t compare(std::size_t row, const BitRows& other,
                                                          std::size_t others_row) const noexcept {
    return static_cast<std::uint32_t>(hamming_distance(bytes + row * size, other.bytes + others_row * size, size));
  }
  [[nodiscard, gnu::always_inline]] float distance(std::uint32_t compared) const noexcept {
    return static_cast<float>(compared);
  }
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Descriptors as bytes, as nibbles, or as bits, which must outlive the rows. `status` has one for each, as
/// Features::status of what they were made from: rows that are not ok hold zeros, which should not match. Null: all are
/// ok.
template <class D>
[[nodiscard]] ByteRows rows_of(const std::vector<ByteDescriptor<D>>& descriptors,
                               const Status* status = nullptr) noexcept {
  static_assert(sizeof(ByteDescriptor<D>) == ByteDescriptor<D>::size_bytes, "rows without gaps");
  static_assert(ByteDescriptor<D>::step == ByteRows::step, "distances in the units of the descriptor");
  return {reinterpret_cast<const std::uint8_t*>(descriptors.data()), descriptors.size(), ByteDescriptor<D>::size_bytes,
          status};
}
template <class D, int Scale>
[[nodiscard]] NibbleRows rows_of(const std::vector<NibbleDescriptor<D, Scale>>& descriptors,
                                 const Status* status = nullptr) noexcept {
  using Nibbles = NibbleDescriptor<D, Scale>;
  static_assert(sizeof(Nibbles) == Nibbles::size_bytes, "rows without gaps");
  return {reinterpret_cast<const std::uint8_t*>(descriptors.data()), descriptors.size(), Nibbles::size_bytes,
          Nibbles::step, status};
}
template <class D, int Group>
[[nodiscard]] BitRows rows_of(const std::vector<BinaryDescriptor<D, Group>>& descriptors,
                              const Status* status = nullptr) noexcept {
  using Bits = BinaryDescriptor<D, Group>;
  static_assert(sizeof(Bits) == Bits::size_bytes, "rows without gaps");
  return {reinterpret_cast<const std::uint8_t*>(descriptors.data()), descriptors.size(), Bits::size_bytes, status};
}

/// ok or bad_rows, as for rows of floats.
[[nodiscard]] inline Status validate(const ByteRows& rows) noexcept {
  return rows.fits(rows) ? Status::ok : Status::bad_rows;
}
[[nodiscard]] inline Status validate(const NibbleRows& rows) noexcept {
  return rows.fits(rows) ? Status::ok : Status::bad_rows;
}
[[nodiscard]] inline Status validate(const BitRows& rows) noexcept {
  return rows.fits(rows) ? Status::ok : Status::bad_rows;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
