// shortshot/base/fnv1a.hpp: 64-bit FNV-1a, a number for a sequence of bytes.
#pragma once

#include <cstdint>

#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr std::uint64_t fnv1a_of_nothing = 0xCBF29CE484222325u;

/// Of what has `hash`, and another byte behind it.
[[nodiscard]] constexpr std::uint64_t fnv1a(std::uint64_t hash, std::uint8_t byte) noexcept {
  return (hash ^ byte) * 0x100000001B3u;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
