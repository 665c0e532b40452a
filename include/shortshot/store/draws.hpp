// shortshot/store/draws.hpp: random numbers that are the same everywhere, made while compiling.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// The generator of std::mt19937 (M. Matsumoto, T. Nishimura: Mersenne Twister, ACM TOMACS 8, 1998), for constants.
class MersenneTwister {
 public:
  constexpr explicit MersenneTwister(std::uint32_t seed) noexcept : state_{seed} {
    for (std::uint32_t i = 1; i < count; ++i) {
      const std::uint32_t before = state_[i - 1];
      state_[i] = 1812433253u * (before ^ before >> 30) + i;
    }
  }
  constexpr std::uint32_t operator()() noexcept {
    const std::size_t next = (at_ + 1) % count;
    const std::uint32_t joined = (state_[at_] & 0x80000000u) | (state_[next] & 0x7FFFFFFFu);
    std::uint32_t number = state_[(at_ + 397) % count] ^ joined >> 1 ^ ((joined & 1u) != 0 ? 0x9908B0DFu : 0u);
    state_[at_] = number;
    at_ = next;
    number ^= number >> 11;
    number ^= number << 7 & 0x9D2C5680u;
    number ^= number << 15 & 0xEFC60000u;
    return number ^ number >> 18;
  }

 private:
  static constexpr std::size_t count = 624;
  std::uint32_t state_[count];
  std::size_t at_ = 0;
};

/// The first numbers of mt19937 with seed 1, modulo `Size`; in bytes, if they fit.
template <int Size, std::size_t Count>
struct Draws {
  using Draw = std::conditional_t<(Size <= 256), std::uint8_t, std::uint16_t>;
  Draw of[Count];
  constexpr Draws() noexcept : of{} {
    MersenneTwister next(1);
    for (Draw& draw : of) draw = static_cast<Draw>(next() % static_cast<std::uint32_t>(Size));
  }
};
template <int Size, std::size_t Count>
inline constexpr Draws<Size, Count> draws{};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot::detail
