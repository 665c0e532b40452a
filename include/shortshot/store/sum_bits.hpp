// shortshot/store/sum_bits.hpp: a descriptor in bits that each say whether a sum of a few of its values is positive.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../config.hpp"
#include "binary.hpp"
#include "coded.hpp"
#include "draws.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A descriptor D as `Bits` signs of sparse sums: bit j is bit j % 8 of byte j / 8, and says whether the sum of `Draws`
/// of its values in nibbles, with the signs -, +, -, +, ..., is above 0. Which values, is drawn once and for all: value
/// g() % D::size with g an std::mt19937 with seed 1, for one bit after the other. A trivial type of alignment 1.
///
/// 352 bits of four draws are 44 bytes, the least that keeps most of what ShapeColor95 finds; 256 bits of six draws are
/// 32 bytes.
template <class D, int Bits = 352, int Draws = 4>
struct SumBits {
  static_assert(Bits >= 8 && Bits <= 65536 && Bits % 8 == 0, "SumBits<D, Bits> supports whole bytes: 8 to 65536 bits");
  static_assert(Draws >= 2 && Draws <= 64, "SumBits<D, Bits, Draws> supports 2 to 64 draws for a bit");
  static constexpr int bits = Bits;                                              ///< number of them
  static constexpr std::size_t size_bytes = static_cast<std::size_t>(Bits) / 8;  ///< of all bits
  std::uint8_t bytes[size_bytes];                                                ///< bit j is bit j % 8 of byte j / 8
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// The bits of a descriptor in nibbles. The same ones on every machine: there is nothing but integers. Codes of parts
/// with signs count as -7 to 7, the others as 0 to 15. No allocation, no error, reentrant.
template <class D, int Scale, int Bits, int Draws>
void binarize(const NibbleDescriptor<D, Scale>& nibbles, SumBits<D, Bits, Draws>& out) noexcept {
  constexpr auto& draws = detail::draws<D::size, static_cast<std::size_t>(Bits) * Draws>;
  const auto* draw = draws.of;
  std::int8_t steps[D::size];  // each is drawn several times
  for (int i = 0; i < D::size; ++i) steps[i] = static_cast<std::int8_t>(detail::steps_at(nibbles, i));
  for (std::uint8_t& byte : out.bytes) {
    unsigned bits = 0;
    for (int bit = 0; bit < 8; ++bit) {
      int sum = 0;
      for (int k = 0; k < Draws; ++k) {
        const std::int8_t drawn = steps[*draw++];
        sum += k % 2 == 0 ? -drawn : drawn;
      }
      if (sum > 0) bits |= 1u << bit;
    }
    byte = static_cast<std::uint8_t>(bits);
  }
}

/// The same of D::size values, by way of nibbles with steps of 1 / code_scale<D, 4>.
template <class D, int Bits, int Draws>
void binarize(const float* values, SumBits<D, Bits, Draws>& out) noexcept {
  NibbleDescriptor<D> nibbles;
  quantize(values, nibbles);
  binarize(nibbles, out);
}

/// Number of bits in which two descriptors differ, 0 to Bits.
template <class D, int Bits, int Draws>
[[nodiscard, gnu::always_inline]] inline int hamming_distance(const SumBits<D, Bits, Draws>& a,
                                                              const SumBits<D, Bits, Draws>& b) noexcept {
  return hamming_distance(a.bytes, b.bytes, sizeof a.bytes);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
