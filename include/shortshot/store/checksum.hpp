// shortshot/store/checksum.hpp: by which damage is noticed: 64-bit FNV-1a.
//
// FNV-1a is three lines, and each of its steps is a bijection: no single wrong byte goes unnoticed, and other damage
// does once in 2^64 times. It is no protection from who means harm; nobody believes a number because of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../base/fnv1a.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr std::size_t checksum_bytes = 8;

/// `hash`: that of all bytes before these.
[[nodiscard]] inline std::uint64_t checksum(const std::uint8_t* bytes, std::size_t size,
                                            std::uint64_t hash = fnv1a_of_nothing) noexcept {
  for (std::size_t i = 0; i < size; ++i) hash = fnv1a(hash, bytes[i]);
  return hash;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
