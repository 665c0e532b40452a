// shortshot/store/hamming.hpp: the number of bits in which rows of bytes differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Ones of each four bits of a word.
[[nodiscard, gnu::always_inline]] inline std::size_t ones_of_fours(std::size_t word) noexcept {
  constexpr std::size_t every = ~std::size_t{0};
  word -= word >> 1 & every / 3;  // of each two bits
  return (word & every / 5) + (word >> 2 & every / 5);
}
/// The sum of a word's bytes, if it is below 256.
[[nodiscard, gnu::always_inline]] inline std::uint32_t sum_of_bytes(std::size_t word) noexcept {
  constexpr std::size_t every = ~std::size_t{0};
  return static_cast<std::uint32_t>(word * (every / 255) >> (8 * (sizeof word - 1)));
}

/// Ones in a word. __builtin_popcount is a call to the compiler's library where the CPU has no instruction for it.
[[nodiscard, gnu::always_inline]] inline int count_ones(std::size_t word) noexcept {
#if defined(__POPCNT__) || defined(__aarch64__)
  return __builtin_popcountll(word);
#else
  const std::size_t fours = ones_of_fours(word);
  return static_cast<int>(sum_of_bytes((fours + (fours >> 4)) & ~std::size_t{0} / 17));
#endif
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Number of bits that differ (0 to 8 * size_bytes) in two arrays of `size_bytes` bytes of any alignment. No
/// allocation, no error, reentrant. Always in line: a copy compiled with the instruction for counting ones must not
/// serve a translation unit compiled without.
[[nodiscard, gnu::always_inline]] inline int hamming_distance(const std::uint8_t* a, const std::uint8_t* b,
                                                              std::size_t size_bytes) noexcept {
  using Word = std::size_t;
  int distance = 0;
  const auto add = [&](std::size_t i, std::size_t length) {
    Word of_a = 0, of_b = 0;
    std::memcpy(&of_a, a + i, length);
    std::memcpy(&of_b, b + i, length);
    distance += detail::count_ones(of_a ^ of_b);
  };
  const std::size_t rest = size_bytes % sizeof(Word);
  for (std::size_t i = 0; i < size_bytes - rest; i += sizeof(Word)) add(i, sizeof(Word));
  if (rest != 0) add(size_bytes - rest, rest);
  return distance;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// The number of bits in which rows differ, if that is below the limit; else a number that is not. Two words at a
/// time, whose ones are added up before they are counted to the end: then it is known whether going on is of use.
[[nodiscard]] inline std::uint32_t hamming_distance_below(const std::uint8_t* a, const std::uint8_t* b,
                                                          std::size_t size_bytes, std::uint32_t limit) noexcept {
  using Word = std::size_t;
  constexpr Word low_halves = ~Word{0} / 17;  // of bytes
  constexpr std::size_t words = 2;
  std::uint32_t distance = 0;
  std::size_t i = 0;
  for (; i + words * sizeof(Word) <= size_bytes; i += words * sizeof(Word)) {
    Word fours = 0;
    for (std::size_t w = 0; w < words; ++w) {
      Word of_a, of_b;
      std::memcpy(&of_a, a + i + w * sizeof(Word), sizeof(Word));
      std::memcpy(&of_b, b + i + w * sizeof(Word), sizeof(Word));
      fours += ones_of_fours(of_a ^ of_b);
    }
    distance += sum_of_bytes((fours & low_halves) + (fours >> 4 & low_halves));
    if (distance >= limit) return distance;
  }
  return distance + static_cast<std::uint32_t>(hamming_distance(a + i, b + i, size_bytes - i));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
