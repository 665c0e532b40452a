// shortshot/store/code_distance.hpp: numbers of a few bits one behind the other, and the squared distance of two rows
// of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../base/simd_halves.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Number `place` of those of `Bits` bits that lie one behind the other, the lowest bits first.
template <int Bits>
[[nodiscard, gnu::always_inline]] inline unsigned number_at(const std::uint8_t* bytes, std::size_t place) noexcept {
  constexpr unsigned mask = (1u << Bits) - 1u;
  const std::size_t bit = place * static_cast<std::size_t>(Bits);
  unsigned number = static_cast<unsigned>(bytes[bit / 8]) >> bit % 8;
  if constexpr (8 % Bits != 0) {
    if (bit % 8 + static_cast<std::size_t>(Bits) > 8)
      number |= static_cast<unsigned>(bytes[bit / 8 + 1]) << (8 - bit % 8);
  }
  return number & mask;
}

/// Writes one where all bits are 0 so far.
template <int Bits>
[[gnu::always_inline]] inline void put_number(std::uint8_t* bytes, std::size_t place, unsigned number) noexcept {
  const std::size_t bit = place * static_cast<std::size_t>(Bits);
  const unsigned shifted = number << bit % 8;
  bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] | (shifted & 255u));
  if (shifted > 255u) bytes[bit / 8 + 1] = static_cast<std::uint8_t>(bytes[bit / 8 + 1] | shifted >> 8);
}

/// Numbers i of `Bits` bits, number(i), one behind the other in so many bytes as they take. In place, too, for numbers
/// that lie behind where they are written.
template <int Bits, class Number>
[[gnu::always_inline]] inline void write_numbers(std::uint8_t* bytes, int count, const Number& number) noexcept {
  unsigned waiting = 0;
  int bits = 0;  // that wait
  for (int i = 0; i < count; ++i) {
    waiting |= number(i) << bits;
    for (bits += Bits; bits >= 8 || (bits > 0 && i == count - 1); bits -= 8) {
      *bytes++ = static_cast<std::uint8_t>(waiting & 255u);
      waiting >>= 8;
    }
  }
}

/// The numbers of a row of so many bytes in another order: number i is number place(i) of the row.
template <int Bits, class Place>
inline void arrange(const std::uint8_t* row, std::uint8_t* out, std::size_t size, const Place& place) noexcept {
  write_numbers<Bits>(out, static_cast<int>(8 * size / Bits),
                      [&](int i) { return number_at<Bits>(row, place(static_cast<std::size_t>(i))); });
}

/// The sum of squared differences of the numbers in `Width` bytes, in a form that compilers turn into lanes at -O2,
/// too.
template <int Bits, std::size_t Width>
[[nodiscard, gnu::always_inline]] inline std::uint32_t squared_piece_distance(const std::uint8_t* a,
                                                                              const std::uint8_t* b) noexcept {
  std::int32_t sum = 0;
  if constexpr (Bits == 3) {
    for (std::size_t k = 0; k < Width * 8 / 3; ++k) {
      const int difference = static_cast<int>(number_at<3>(a, k)) - static_cast<int>(number_at<3>(b, k));
      sum += difference * difference;
    }
  } else {
    constexpr unsigned mask = (1u << Bits) - 1u;
    for (std::size_t k = 0; k < Width; ++k) {
      const auto low = static_cast<std::int16_t>((a[k] & mask) - (b[k] & mask));
      sum += low * low;
    }
    for (std::size_t k = 0; Bits == 4 && k < Width; ++k) {
      const auto high = static_cast<std::int16_t>((a[k] >> 4) - (b[k] >> 4));
      sum += high * high;
    }
  }
  return static_cast<std::uint32_t>(sum);
}

/// The sum of squared differences of the numbers of 8, 4 or 3 bits in `size` bytes; of up to 66051 numbers it fits.
template <int Bits>
[[nodiscard]] inline std::uint32_t squared_code_distance(const std::uint8_t* a, const std::uint8_t* b,
                                                         std::size_t size) noexcept {
  static_assert(Bits == 8 || Bits == 4 || Bits == 3, "whole numbers in every piece");
  std::uint32_t sum = 0;
  std::size_t i = 0;
  if constexpr (simd::has_halves && Bits != 3) {
    for (; i + 4 <= size; i += 4) {
      std::uint32_t of_a, of_b;
      std::memcpy(&of_a, a + i, 4);
      std::memcpy(&of_b, b + i, 4);
      if constexpr (Bits == 8) {
        sum = simd::add_squared_differences(of_a, of_b, sum);
      } else {
        constexpr std::uint32_t low = 0x0F0F0F0Fu;
        sum = simd::add_squared_differences(of_a & low, of_b & low, sum);
        sum = simd::add_squared_differences(of_a >> 4 & low, of_b >> 4 & low, sum);
      }
    }
  } else {
    constexpr std::size_t width = Bits == 3 ? 3 : Bits == 4 ? 16 : 32;
    for (; i + width <= size; i += width) sum += squared_piece_distance<Bits, width>(a + i, b + i);
  }
  const std::size_t whole = i * 8 / static_cast<std::size_t>(Bits);
  for (std::size_t k = whole; k < size * 8 / static_cast<std::size_t>(Bits); ++k) {
    const int difference = static_cast<int>(number_at<Bits>(a, k)) - static_cast<int>(number_at<Bits>(b, k));
    sum += static_cast<std::uint32_t>(difference * difference);
  }
  return sum;
}

/// The same if it is below the limit; else a number that is not.
template <int Bits>
[[nodiscard]] inline std::uint32_t squared_code_distance_below(const std::uint8_t* a, const std::uint8_t* b,
                                                               std::size_t size, std::uint32_t limit) noexcept {
  constexpr std::size_t piece = 24;  // whole numbers
  std::uint32_t sum = 0;
  std::size_t i = 0;
  for (; i + piece < size && sum < limit; i += piece) sum += squared_code_distance<Bits>(a + i, b + i, piece);
  return sum < limit ? sum + squared_code_distance<Bits>(a + i, b + i, size - i) : sum;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
