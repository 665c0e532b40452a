// Memory as microcontrollers have it: programmed in units, each once; and the power may go in the middle of one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fixtures.hpp"

namespace unit {

template <std::size_t UnitBytes>
struct FlashSimulator {
  static constexpr std::size_t unit_bytes = UnitBytes;
  static constexpr std::size_t forever = static_cast<std::size_t>(-1);

  std::vector<std::uint8_t> content;
  std::vector<bool> is_programmed;  // by unit
  std::size_t writes_left = forever;
  std::size_t refused = 0;         // of units that were programmed before
  std::size_t worn_out = forever;  // the place of a unit that takes nothing, and does not say so
  Random torn{1};

  explicit FlashSimulator(std::size_t size) : content(size, 0xFF), is_programmed(size / UnitBytes, false) {}

  [[nodiscard]] const std::uint8_t* bytes() const { return content.data(); }
  [[nodiscard]] std::size_t size_bytes() const { return content.size(); }

  /// The last write before the power goes leaves some of the bits that it should clear; later ones do nothing.
  bool write(std::size_t place, const std::uint8_t* unit) {
    REQUIRE((place % UnitBytes == 0 && place + UnitBytes <= content.size()));
    if (writes_left == 0) return false;
    if (place == worn_out) return true;
    if (is_programmed[place / UnitBytes]) {
      ++refused;
      return false;
    }
    const bool is_torn = writes_left != forever && --writes_left == 0;
    bool is_touched = false;
    for (std::size_t k = 0; k < UnitBytes; ++k) {
      const unsigned kept = is_torn ? static_cast<unsigned>(torn.between(0.0f, 255.9f)) : 0u;
      const auto after = static_cast<std::uint8_t>(content[place + k] & (unit[k] | kept));
      is_touched = is_touched || after != 0xFF;
      content[place + k] = after;
    }
    is_programmed[place / UnitBytes] = is_touched || !is_torn;
    return !is_torn;
  }
};

}  // namespace unit
