// shortshot/recognition/packed_rows.hpp: borrowed rows of codes and of bits, which are matched as rows of floats
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
#include "../store/code_distance.hpp"
#include "../store/coded.hpp"
#include "../store/stored_features.hpp"
#include "../store/sum_bits.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Can packed rows be compared? Sums of as many squares as this fit 32 bits.
template <class Rows>
[[nodiscard, gnu::always_inline]] inline bool fit(const Rows& a, const Rows& b) noexcept {
  return a.size == b.size && a.size > 0 && a.size <= 66051 && (a.count == 0 || a.bytes != nullptr) &&
         (b.count == 0 || b.bytes != nullptr);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// `count` descriptors of `size` bytes of codes each (1 to 66051), row by row without gaps, as quantize() makes them,
/// all with steps of the same length. Borrowed. Their distance is the L2 distance of the descriptors, `step` times the
/// root of the sum of squares.
template <int Bits>
struct CodedRows {
  const std::uint8_t* bytes;  ///< count * size
  std::size_t count;          ///< number of rows
  std::size_t size;           ///< bytes in a row
  float step;                 ///< CodedDescriptor's
  const Status* status;       ///< one per row: those that are not ok are left out; null: all are ok

  /// Can they be compared: of the same size and step?
  [[nodiscard, gnu::always_inline]] bool fits(const CodedRows& other) const noexcept {
    return detail::fit(*this, other) && step == other.step;
  }
  /// The squared distance in steps.
  [[nodiscard, gnu::always_inline]] std::uint32_t compare(std::size_t row, const CodedRows& other,
                                                          std::size_t others_row) const noexcept {
    return detail::squared_code_distance<Bits>(bytes + row * size, other.bytes + others_row * size, size);
  }
  /// The L2 distance, from what compare() gave.
  [[nodiscard, gnu::always_inline]] float distance(std::uint32_t compared) const noexcept {
    return step * extend::simd::sqrt(static_cast<float>(compared));
  }
};
/// Rows of 8 bits a value, and of 4.
using ByteRows = CodedRows<8>;
using NibbleRows = CodedRows<4>;

/// `count` descriptors of `size` bytes of bits each (1 to 66051), row by row without gaps, as binarize() makes them.
/// Borrowed. Their distance is the number of bits in which they differ (Hamming).
struct BitRows {
  const std::uint8_t* bytes;  ///< count * size
  std::size_t count;          ///< number of rows
  std::size_t size;           ///< bytes in a row
  const Status* status;       ///< one per row: those that are not ok are left out; null: all are ok

  /// Can they be compared: of the same size?
  [[nodiscard, gnu::always_inline]] bool fits(const BitRows& other) const noexcept { return detail::fit(*this, other); }
  /// The number of bits that differ.
  [[nodiscard, gnu::always_inline]] std::uint32_t compare(std::size_t row, const BitRows& other,
                                                          std::size_t others_row) const noexcept {
    return static_cast<std::uint32_t>(hamming_distance(bytes + row * size, other.bytes + others_row * size, size));
  }
  /// The same as a float.
  [[nodiscard, gnu::always_inline]] float distance(std::uint32_t compared) const noexcept {
    return static_cast<float>(compared);
  }
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// Descriptors as codes or as bits, which must outlive the rows. `status` has one for each, as Features::status of what
/// they were made from: rows that are not ok hold zeros, which should not match. Null: all are ok.
template <class D, int Bits, int Scale>
[[nodiscard]] CodedRows<Bits> rows_of(const std::vector<CodedDescriptor<D, Bits, Scale>>& descriptors,
                                      const Status* status = nullptr) noexcept {
  using Coded = CodedDescriptor<D, Bits, Scale>;
  static_assert(sizeof(Coded) == Coded::size_bytes, "rows without gaps");
  return {reinterpret_cast<const std::uint8_t*>(descriptors.data()), descriptors.size(), Coded::size_bytes, Coded::step,
          status};
}
template <class D, int Group>
[[nodiscard]] BitRows rows_of(const std::vector<BinaryDescriptor<D, Group>>& descriptors,
                              const Status* status = nullptr) noexcept {
  using Bits = BinaryDescriptor<D, Group>;
  static_assert(sizeof(Bits) == Bits::size_bytes, "rows without gaps");
  return {reinterpret_cast<const std::uint8_t*>(descriptors.data()), descriptors.size(), Bits::size_bytes, status};
}
template <class D, int Bits, int Draws>
[[nodiscard]] BitRows rows_of(const std::vector<SumBits<D, Bits, Draws>>& descriptors,
                              const Status* status = nullptr) noexcept {
  static_assert(sizeof(SumBits<D, Bits, Draws>) == Bits / 8, "rows without gaps");
  return {reinterpret_cast<const std::uint8_t*>(descriptors.data()), descriptors.size(), Bits / 8, status};
}

/// Those of features, with their statuses; also of halves.
template <class Stored>
[[nodiscard]] auto rows_of(const StoredFeatures<Stored>& features) noexcept {
  return rows_of(features.descriptors, features.status.data());
}

/// ok or bad_rows, as for rows of floats.
template <int Bits>
[[nodiscard]] Status validate(const CodedRows<Bits>& rows) noexcept {
  return rows.fits(rows) ? Status::ok : Status::bad_rows;
}
[[nodiscard]] inline Status validate(const BitRows& rows) noexcept {
  return rows.fits(rows) ? Status::ok : Status::bad_rows;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
