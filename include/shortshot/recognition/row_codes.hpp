// shortshot/recognition/row_codes.hpp: packed rows as the codes that compare_packed.hpp works on. Hosted only:
// allocates.
//
// A row of bytes or nibbles is a row of numbers, and one of bits a row of half bytes. They are put in an order in which
// those come first that differ most from row to row: then the first of them tell most pairs apart.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "../base/simd_sums.hpp"
#include "../config.hpp"
#include "../store/code_distance.hpp"
#include "packed_rows.hpp"
#include "telling_numbers.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Distances that are sums of squared differences of numbers: |a|^2 + |b|^2 - 2 ab, with the norms known beforehand.
template <class SomeOps, int Bits>
struct NumberCodes {
  using Ops = SomeOps;
  using Code = typename Ops::Code;
  static constexpr int bits = Bits;
  /// After so many steps it is asked whether going on is worth it.
  static constexpr std::size_t chunk_steps = 32;
  [[nodiscard]] static Code code_of(unsigned number) noexcept { return static_cast<Code>(number); }
  [[nodiscard]] static std::uint32_t distance(unsigned a, unsigned b) noexcept { return (a - b) * (a - b); }
  [[nodiscard]] static std::uint32_t squared(Code code) noexcept { return std::uint32_t{code} * code; }
  [[nodiscard, gnu::always_inline]] static simd::I32 distances(simd::I32 norms, simd::I32 sums) noexcept {
    return norms - (sums + sums);
  }

  /// Of a chunk: |a|^2 + |b|^2 - 2 ab < limit only if ab > limit_of(|a|^2, limit) + limit_of(|b|^2, 0).
  using Limit = typename Ops::Limit;
  [[nodiscard]] static Limit query_limit(std::uint32_t norm, std::uint32_t limit) noexcept {
    return limit_of(norm, limit);
  }
  [[nodiscard]] static Limit no_query_limit(std::uint32_t norm) noexcept { return limit_of(norm, 0); }
  [[nodiscard]] static Limit row_limit(std::uint32_t norm, std::uint32_t limit) noexcept {
    return limit_of(norm, limit);
  }
  [[nodiscard]] static Limit no_row_limit(std::uint32_t norm) noexcept { return limit_of(norm, 0); }

 private:
  [[nodiscard]] static Limit limit_of(std::uint32_t norm, std::uint32_t limit) noexcept {
    constexpr std::int64_t least = std::numeric_limits<Limit>::min() / 2;
    return static_cast<Limit>(std::max(least, (std::int64_t{norm} - std::int64_t{limit}) >> 1));
  }
};

/// Distances that are sums of bits that differ.
struct BitCodes {
  using Ops = simd::HalfBytes;
  using Code = Ops::Code;
  static constexpr int bits = 4;
  static constexpr std::size_t chunk_steps = 60;
  [[nodiscard]] static Code code_of(unsigned half) noexcept { return static_cast<Code>(half << 4); }
  [[nodiscard]] static std::uint32_t distance(unsigned a, unsigned b) noexcept {
    return simd::half_byte_distances.of[a][b];
  }
  [[nodiscard]] static std::uint32_t squared(Code) noexcept { return 0; }
  [[nodiscard, gnu::always_inline]] static simd::I32 distances(simd::I32 norms, simd::I32 sums) noexcept {
    return norms + sums;
  }

  /// A chunk has less than 255 bits.
  using Limit = Ops::Limit;
  [[nodiscard]] static Limit query_limit(std::uint32_t, std::uint32_t limit) noexcept {
    return static_cast<Limit>(std::min(limit, 255u));
  }
  [[nodiscard]] static Limit no_query_limit(std::uint32_t) noexcept { return 255; }
  [[nodiscard]] static Limit row_limit(std::uint32_t, std::uint32_t limit) noexcept {
    return static_cast<Limit>(255u - std::min(limit, 255u));
  }
  [[nodiscard]] static Limit no_row_limit(std::uint32_t) noexcept { return 0; }
};

/// Which codes rows of a format are made of; for those formats that it is specialized for.
template <class Rows>
struct CodesOf {};
template <int Bits>
struct CodesOf<CodedRows<Bits>> : NumberCodes<std::conditional_t<Bits <= 4, simd::SmallCodes, simd::LargeCodes>, Bits> {
};
template <>
struct CodesOf<BitRows> : BitCodes {};

/// Turns rows that fit each other into codes, in the order that is best for one set of them.
template <class Rows>
class RowCodes {
 public:
  using Format = CodesOf<Rows>;
  using Ops = typename Format::Ops;
  using Code = typename Format::Code;

  explicit RowCodes(const Rows& rows)
      : order_(most_telling_first<Format::bits>(rows.bytes, rows.count, rows.size, &Format::distance)) {}

  [[nodiscard]] std::size_t steps() const noexcept { return (order_.size() + Ops::step_codes - 1) / Ops::step_codes; }
  [[nodiscard]] std::size_t codes() const noexcept { return steps() * Ops::step_codes; }
  [[nodiscard]] std::size_t chunks() const noexcept {
    return (steps() + Format::chunk_steps - 1) / Format::chunk_steps;
  }

  /// codes() of a row, and chunks() parts of its squared norm. What the last step lacks is left as it is: zeros.
  void encode(const Rows& rows, std::size_t row, Code* codes, std::uint32_t* norms) const noexcept {
    constexpr std::size_t chunk_codes = Format::chunk_steps * Ops::step_codes;
    const std::uint8_t* const bytes = rows.bytes + row * rows.size;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      codes[i] = Format::code_of(number_at<Format::bits>(bytes, order_[i]));
      norms[i / chunk_codes] += Format::squared(codes[i]);
    }
  }

 private:
  std::vector<std::uint32_t> order_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
