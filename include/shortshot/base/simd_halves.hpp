// shortshot/base/simd_halves.hpp: two numbers in a register of 32 bits: the DSP instructions of Cortex-M4 and later.
#pragma once

#include <cstdint>

#include "../config.hpp"

#if defined(__ARM_FEATURE_DSP) && defined(__ARM_FEATURE_SIMD32) && (defined(__clang__) || __GNUC__ >= 10)
#define SHORTSHOT_HAS_HALVES
#include <arm_acle.h>
#endif

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// Is it worth a loop of its own?
#if defined(SHORTSHOT_HAS_HALVES)
inline constexpr bool has_halves = true;
#else
inline constexpr bool has_halves = false;
#endif

/// `sum` and the squared differences of the four bytes of a and b.
[[nodiscard, gnu::always_inline]] inline std::uint32_t add_squared_differences(std::uint32_t a, std::uint32_t b,
                                                                               std::uint32_t sum) noexcept {
#if defined(SHORTSHOT_HAS_HALVES)
#if defined(__clang__)
  using Bytes = int8x4_t;  // its header says so; GCC's has the sign of the instruction
#else
  using Bytes = uint8x4_t;
#endif
  const auto halves = [](std::uint32_t v) { return static_cast<uint16x2_t>(__uxtb16(static_cast<Bytes>(v))); };
  const auto even = static_cast<std::int32_t>(__usub16(halves(a), halves(b)));
  const auto odd = static_cast<std::int32_t>(__usub16(halves(a >> 8), halves(b >> 8)));
  const std::int32_t half = __smlad(even, even, static_cast<std::int32_t>(sum));  // sums wrap, as unsigned ones do
  return static_cast<std::uint32_t>(__smlad(odd, odd, half));
#else
  for (int shift = 0; shift < 32; shift += 8) {
    const auto difference = static_cast<std::int32_t>(a >> shift & 255u) - static_cast<std::int32_t>(b >> shift & 255u);
    sum += static_cast<std::uint32_t>(difference * difference);
  }
  return sum;
#endif
}

/// `sum` and the four bytes of a.
[[nodiscard, gnu::always_inline]] inline std::uint32_t add_bytes(std::uint32_t a, std::uint32_t sum) noexcept {
#if defined(SHORTSHOT_HAS_HALVES)
  return __usada8(static_cast<uint8x4_t>(a), 0, sum);
#else
  for (int shift = 0; shift < 32; shift += 8) sum += a >> shift & 255u;
  return sum;
#endif
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
