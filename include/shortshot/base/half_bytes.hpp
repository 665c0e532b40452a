// shortshot/base/half_bytes.hpp: how many bits half a byte differs in from another.
#pragma once

#include <cstdint>

#include "../config.hpp"

namespace shortshot::extend::simd {
inline namespace SHORTSHOT_CODE {

/// For every two of them. (Registers are loaded from it.)
struct HalfByteDistances {
  alignas(16) std::uint8_t of[16][16];  ///< of[a][b]: the bits in which half bytes a and b differ
  constexpr HalfByteDistances() noexcept : of{} {
    for (unsigned a = 0; a < 16; ++a) {
      for (unsigned b = 0; b < 16; ++b) {
        for (unsigned differ = a ^ b; differ != 0; differ &= differ - 1) ++of[a][b];
      }
    }
  }
};
inline constexpr HalfByteDistances half_byte_distances{};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::simd
