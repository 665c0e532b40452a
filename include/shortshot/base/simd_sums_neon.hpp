// shortshot/base/simd_sums_neon.hpp: sums over packed rows on NEON. Included by simd_sums.hpp, which says what it must
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
  static constexpr std::size_t rows = 8, step_codes = 2, step_cells = 16;
  struct Sums {
    uint16x8_t first, second;  // of four rows each, of their even and odd codes apart
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) std::memcpy(to + 2 * k, of_rows[k], 2);
  }
  [[nodiscard]] static Sums none() noexcept { return {vdupq_n_u16(0), vdupq_n_u16(0)}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    std::uint16_t pair;
    std::memcpy(&pair, codes, sizeof pair);
    const uint8x8_t pairs = vreinterpret_u8_u16(vdup_n_u16(pair));
    const uint8x16_t cells = vld1q_u8(panel);
    return {vmlal_u8(sums.first, vget_low_u8(cells), pairs), vmlal_u8(sums.second, vget_high_u8(cells), pairs)};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const int16x8_t all_sums = vreinterpretq_s16_u16(vpaddq_u16(sums.first, sums.second));
    return vmaxvq_u16(vcgtq_s16(all_sums, vqaddq_s16(vld1q_s16(limits), vdupq_n_s16(of_row)))) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept {
    to[0] = {vreinterpretq_s32_u32(vpaddlq_u16(sums.first))};
    to[1] = {vreinterpretq_s32_u32(vpaddlq_u16(sums.second))};
  }
};

struct LargeCodes {
  using Code = std::uint16_t;
  using Limit = std::int32_t;
  using Cell = std::uint16_t;
  static constexpr std::size_t rows = 4, step_codes = 2, step_cells = 8;
  struct Sums {
    uint32x4_t first, second;  // of two rows each, of their even and odd codes apart
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) std::memcpy(to + 2 * k, of_rows[k], 4);
  }
  [[nodiscard]] static Sums none() noexcept { return {vdupq_n_u32(0), vdupq_n_u32(0)}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    std::uint32_t pair;
    std::memcpy(&pair, codes, sizeof pair);
    const uint16x4_t pairs = vreinterpret_u16_u32(vdup_n_u32(pair));
    const uint16x8_t cells = vld1q_u16(panel);
    return {vmlal_u16(sums.first, vget_low_u16(cells), pairs), vmlal_u16(sums.second, vget_high_u16(cells), pairs)};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    const int32x4_t all_sums = vreinterpretq_s32_u32(vpaddq_u32(sums.first, sums.second));
    return vmaxvq_u32(vcgtq_s32(all_sums, vaddq_s32(vld1q_s32(limits), vdupq_n_s32(of_row)))) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept {
    to[0] = {vreinterpretq_s32_u32(vpaddq_u32(sums.first, sums.second))};
  }
};

struct HalfBytes {
  using Code = std::uint8_t;
  using Limit = std::uint8_t;
  using Cell = std::uint8_t;
  static constexpr std::size_t rows = 16, step_codes = 1, step_cells = 16;
  struct Sums {
    uint8x16_t v;
  };

  static void pack(const Code* const* of_rows, Cell* to) noexcept {
    for (std::size_t k = 0; k < rows; ++k) to[k] = static_cast<Cell>(*of_rows[k] >> 4);
  }
  [[nodiscard]] static Sums none() noexcept { return {vdupq_n_u8(0)}; }
  [[nodiscard, gnu::always_inline]] static Sums add(Sums sums, const Cell* panel, const Code* codes) noexcept {
    const uint8x16_t table = vld1q_u8(&half_byte_distances.of[0][0] + *codes);  // from the row's half byte
    return {vaddq_u8(sums.v, vqtbl1q_u8(table, vld1q_u8(panel)))};
  }
  [[nodiscard, gnu::always_inline]] static bool any_near(Sums sums, const Limit* limits, Limit of_row) noexcept {
    return vmaxvq_u8(vcltq_u8(sums.v, vqsubq_u8(vld1q_u8(limits), vdupq_n_u8(of_row)))) != 0;
  }
  static void widen(Sums sums, I32* to) noexcept {
    const uint16x8_t low = vmovl_u8(vget_low_u8(sums.v));
    const uint16x8_t high = vmovl_u8(vget_high_u8(sums.v));
    to[0] = {vreinterpretq_s32_u32(vmovl_u16(vget_low_u16(low)))};
    to[1] = {vreinterpretq_s32_u32(vmovl_u16(vget_high_u16(low)))};
    to[2] = {vreinterpretq_s32_u32(vmovl_u16(vget_low_u16(high)))};
    to[3] = {vreinterpretq_s32_u32(vmovl_u16(vget_high_u16(high)))};
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
