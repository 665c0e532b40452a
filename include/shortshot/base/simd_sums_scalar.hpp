// shortshot/base/simd_sums_scalar.hpp: sums over packed rows, one row at a time. Included by simd_sums.hpp, which says
// what it must do.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../config.hpp"
#include "half_bytes.hpp"
#include "simd.hpp"

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// Sums of products, and of bits that differ; simd_sums.hpp says what their members are.
struct LargeCodes {
  using Code = std::uint16_t;  ///< an element of the database's rows
  using Limit = std::int32_t;  ///< a number of the size of a sum
  using Cell = std::uint16_t;  ///< an element of a panel
  /// Rows of one Sums; codes and cells of one step.
  static constexpr std::size_t rows = 1, step_codes = 2, step_cells = 2;
  /// The sums of `rows` rows.
  struct Sums {
    std::uint32_t v;  ///< the sum
  };

  /// One step of as many rows of codes as a panel has.
  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    to[0] = of_rows[0][0];
    to[1] = of_rows[0][1];
  }
  /// The sums before the first step.
  [[nodiscard]] static Sums none() noexcept { return {0}; }
  /// One step more, of a panel and a row.
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    return {sums.v + std::uint32_t{panel[0]} * codes[0] + std::uint32_t{panel[1]} * codes[1]};
  }
  /// Is any product above, or number of bits below, what the panel's row and the other row say?
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    return static_cast<std::int32_t>(sums.v) > *limits + of_row;
  }
  /// As 32-bit integers, in the order of the rows.
  static void widen(Sums sums, I32* to) noexcept { to[0] = all_int(static_cast<std::int32_t>(sums.v)); }
};

/// Products of numbers from 0 to 15, for up to 64 of them.
using SmallCodes = LargeCodes;

/// Bits in which half bytes differ, one half byte at a time, for up to 62 of them.
struct HalfBytes {
  using Code = std::uint8_t;
  using Limit = std::uint8_t;
  using Cell = std::uint8_t;
  static constexpr std::size_t rows = 1, step_codes = 1, step_cells = 1;
  /// The sums of `rows` rows.
  struct Sums {
    std::int32_t v;
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept { *to = static_cast<Cell>(*of_rows[0] >> 4); }
  [[nodiscard]] static Sums none() noexcept { return {0}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    return {sums.v + half_byte_distances.of[*codes >> 4][*panel]};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    return sums.v < *limits - of_row;
  }
  static void widen(Sums sums, I32* to) noexcept { to[0] = all_int(sums.v); }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
