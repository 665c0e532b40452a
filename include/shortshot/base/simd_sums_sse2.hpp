// shortshot/base/simd_sums_sse2.hpp: sums over packed rows on SSE2. Included by simd_sums.hpp, which says what it must
// do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../config.hpp"
#include "half_bytes.hpp"
#include "simd.hpp"

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

struct LargeCodes {
  using Code = std::uint16_t;
  using Limit = std::int32_t;
  using Cell = std::uint16_t;
  static constexpr std::size_t rows = 4, step_codes = 2, step_cells = 8;
  struct Sums {
    __m128i v;
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) std::memcpy(to + 2 * k, of_rows[k], 4);
  }
  [[nodiscard]] static Sums none() noexcept { return {_mm_setzero_si128()}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    std::int32_t pair;
    std::memcpy(&pair, codes, sizeof pair);
    const __m128i cells = _mm_loadu_si128(reinterpret_cast<const __m128i*>(panel));
    return {_mm_add_epi32(sums.v, _mm_madd_epi16(cells, _mm_set1_epi32(pair)))};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const __m128i of_rows = _mm_loadu_si128(reinterpret_cast<const __m128i*>(limits));
    const __m128i above = _mm_cmpgt_epi32(sums.v, _mm_add_epi32(of_rows, _mm_set1_epi32(of_row)));
    return _mm_movemask_epi8(above) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept { to[0] = {sums.v}; }
};

using SmallCodes = LargeCodes;  // products of bytes came with SSSE3

/// Nor are there tables in registers: a panel has the distances from each of the 16 half bytes.
struct HalfBytes {
  using Code = std::uint8_t;
  using Limit = std::uint8_t;
  using Cell = std::uint8_t;
  static constexpr std::size_t rows = 16, step_codes = 1, step_cells = 256;
  struct Sums {
    __m128i v;  // 8 bits each
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t half = 0; half < 16; ++half) {
      for (std::size_t k = 0; k < rows; ++k) to[rows * half + k] = half_byte_distances.of[half][*of_rows[k] >> 4];
    }
  }
  [[nodiscard]] static Sums none() noexcept { return {_mm_setzero_si128()}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    const __m128i distances = _mm_loadu_si128(reinterpret_cast<const __m128i*>(panel + *codes));
    return {_mm_add_epi8(sums.v, distances)};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const __m128i of_rows = _mm_loadu_si128(reinterpret_cast<const __m128i*>(limits));
    const __m128i all_limits = _mm_subs_epu8(of_rows, _mm_set1_epi8(static_cast<char>(of_row)));
    return _mm_movemask_epi8(_mm_cmpeq_epi8(_mm_max_epu8(sums.v, all_limits), sums.v)) != 0xFFFF;
  }
  static void widen(Sums sums, I32* to) noexcept {
    const __m128i zero = _mm_setzero_si128();
    const __m128i low = _mm_unpacklo_epi8(sums.v, zero);
    const __m128i high = _mm_unpackhi_epi8(sums.v, zero);
    to[0] = {_mm_unpacklo_epi16(low, zero)};
    to[1] = {_mm_unpackhi_epi16(low, zero)};
    to[2] = {_mm_unpacklo_epi16(high, zero)};
    to[3] = {_mm_unpackhi_epi16(high, zero)};
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
