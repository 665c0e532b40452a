// shortshot/base/simd_sums_avx2.hpp: sums over packed rows on AVX2. Included by simd_sums.hpp, which says what it must
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

struct SmallCodes {
  using Code = std::uint8_t;
  using Limit = std::int16_t;
  using Cell = std::uint8_t;
  static constexpr std::size_t rows = 16, step_codes = 2, step_cells = 32;
  struct Sums {
    __m256i v;  // 16 bits each
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) std::memcpy(to + 2 * k, of_rows[k], 2);
  }
  [[nodiscard]] static Sums none() noexcept { return {_mm256_setzero_si256()}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    std::int16_t pair;
    std::memcpy(&pair, codes, sizeof pair);
    const __m256i cells = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(panel));
    return {_mm256_add_epi16(sums.v, _mm256_maddubs_epi16(cells, _mm256_set1_epi16(pair)))};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const __m256i of_rows = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(limits));
    const __m256i above = _mm256_cmpgt_epi16(sums.v, _mm256_adds_epi16(of_rows, _mm256_set1_epi16(of_row)));
    return _mm256_movemask_epi8(above) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept {
    to[0] = {_mm256_cvtepi16_epi32(_mm256_castsi256_si128(sums.v))};
    to[1] = {_mm256_cvtepi16_epi32(_mm256_extracti128_si256(sums.v, 1))};
  }
};

struct LargeCodes {
  using Code = std::uint16_t;
  using Limit = std::int32_t;
  using Cell = std::uint16_t;
  static constexpr std::size_t rows = 8, step_codes = 2, step_cells = 16;
  struct Sums {
    __m256i v;
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) std::memcpy(to + 2 * k, of_rows[k], 4);
  }
  [[nodiscard]] static Sums none() noexcept { return {_mm256_setzero_si256()}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    std::int32_t pair;
    std::memcpy(&pair, codes, sizeof pair);
    const __m256i cells = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(panel));
    return {_mm256_add_epi32(sums.v, _mm256_madd_epi16(cells, _mm256_set1_epi32(pair)))};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const __m256i of_rows = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(limits));
    const __m256i above = _mm256_cmpgt_epi32(sums.v, _mm256_add_epi32(of_rows, _mm256_set1_epi32(of_row)));
    return _mm256_movemask_epi8(above) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept { to[0] = {sums.v}; }
};

struct HalfBytes {
  using Code = std::uint8_t;
  using Limit = std::uint8_t;
  using Cell = std::uint8_t;
  static constexpr std::size_t rows = 32, step_codes = 1, step_cells = 32;
  struct Sums {
    __m256i v;  // 8 bits each
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) to[k] = static_cast<Cell>(*of_rows[k] >> 4);
  }
  [[nodiscard]] static Sums none() noexcept { return {_mm256_setzero_si256()}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    const std::uint8_t* const distances = &half_byte_distances.of[0][0] + *codes;  // from the row's half byte
    const __m128i table = _mm_load_si128(reinterpret_cast<const __m128i*>(distances));
    const __m256i cells = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(panel));
    return {_mm256_add_epi8(sums.v, _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(table), cells))};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const __m256i of_rows = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(limits));
    const __m256i all_limits = _mm256_subs_epu8(of_rows, _mm256_set1_epi8(static_cast<char>(of_row)));
    return _mm256_movemask_epi8(_mm256_cmpeq_epi8(_mm256_max_epu8(sums.v, all_limits), sums.v)) != -1;
  }
  static void widen(Sums sums, I32* to) noexcept {
    const __m128i low = _mm256_castsi256_si128(sums.v);
    const __m128i high = _mm256_extracti128_si256(sums.v, 1);
    to[0] = {_mm256_cvtepu8_epi32(low)};
    to[1] = {_mm256_cvtepu8_epi32(_mm_srli_si128(low, 8))};
    to[2] = {_mm256_cvtepu8_epi32(high)};
    to[3] = {_mm256_cvtepu8_epi32(_mm_srli_si128(high, 8))};
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
