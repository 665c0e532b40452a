// shortshot/store/hamming.hpp: the number of bits in which rows of bytes differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../base/simd_halves.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// All ones, divided by this: a one in every field of so many bits.
inline constexpr std::size_t all_ones = ~std::size_t{0};

/// The bits of a word of which every second field of `Bits` bits is made. (As an assembly statement's they are not
/// known to be that: what is left when they are taken away is a subtraction, and shifted as it is added, for which
/// Thumb has an instruction. It has none that masks what it shifts.)
template <int Bits>
[[nodiscard, gnu::always_inline]] inline std::size_t every_second(std::size_t word) noexcept {
  std::size_t low = word & all_ones / ((std::size_t{1} << Bits) + 1);
  __asm__("" : "+r"(low));
  return low;
}

/// The sums of a word's fields of `Bits` bits, two by two.
template <int Bits>
[[nodiscard, gnu::always_inline]] inline std::size_t sums_of_two(std::size_t word) noexcept {
  const std::size_t low = every_second<Bits>(word);
  return low + ((word - low) >> Bits);
}

/// `sum` and a word's bytes, which are less than 256 together.
[[nodiscard, gnu::always_inline]] inline std::uint32_t add_all_bytes(std::size_t word, std::uint32_t sum) noexcept {
  if constexpr (simd::has_halves) return simd::add_bytes(static_cast<std::uint32_t>(word), sum);
  return sum + static_cast<std::uint32_t>(word * (all_ones / 255) >> (8 * (sizeof word - 1)));
}

/// `sum` and the ones of three words: those of the third are added to the pairs of the others.
[[nodiscard, gnu::always_inline]] inline std::uint32_t add_ones(std::size_t a, std::size_t b, std::size_t c,
                                                                std::uint32_t sum) noexcept {
  const std::size_t low = every_second<1>(c);
  const std::size_t fours =
      sums_of_two<2>(sums_of_two<1>(a) + low) + sums_of_two<2>(sums_of_two<1>(b) + ((c - low) >> 1));
  return add_all_bytes(sums_of_two<4>(fours), sum);
}

/// Ones in a word. __builtin_popcount is a call to the compiler's library where the CPU has no instruction for it.
[[nodiscard, gnu::always_inline]] inline int count_ones(std::size_t word) noexcept {
#if defined(__POPCNT__) || defined(__aarch64__)
  return __builtin_popcountll(word);
#else
  return static_cast<int>(add_all_bytes(sums_of_two<4>(sums_of_two<2>(sums_of_two<1>(word))), 0));
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

/// The number of bits in which rows differ, if that is below the limit; else a number that is not. Three words at a
/// time, whose ones are added up before they are counted to the end: then it is known whether going on is of use.
[[nodiscard]] SHORTSHOT_INLINE std::uint32_t hamming_distance_below(const std::uint8_t* a, const std::uint8_t* b,
                                                                    std::size_t size_bytes,
                                                                    std::uint32_t limit) noexcept {
  using Word = std::size_t;
  constexpr std::size_t words = 3;
  const auto differing = [&](std::size_t i) {
    Word of_a, of_b;
    std::memcpy(&of_a, a + i, sizeof(Word));
    std::memcpy(&of_b, b + i, sizeof(Word));
    return of_a ^ of_b;
  };
  std::uint32_t distance = 0;
  std::size_t i = 0;
  for (; i + words * sizeof(Word) <= size_bytes; i += words * sizeof(Word)) {
    distance = add_ones(differing(i), differing(i + sizeof(Word)), differing(i + 2 * sizeof(Word)), distance);
    if (distance >= limit) return distance;
  }
  return distance + static_cast<std::uint32_t>(hamming_distance(a + i, b + i, size_bytes - i));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
