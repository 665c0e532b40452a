// Files of the library with other contents behind a checksum that is right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace unit {

inline std::vector<std::uint8_t> with_checksum(std::vector<std::uint8_t> bytes) {
  const std::uint64_t sum = ss::detail::checksum(bytes.data(), bytes.size() - 8);
  for (std::size_t k = 0; k < 8; ++k) bytes[bytes.size() - 8 + k] = static_cast<std::uint8_t>(sum >> (8 * k) & 0xFFu);
  return bytes;
}

}  // namespace unit
