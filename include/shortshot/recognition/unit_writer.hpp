// shortshot/recognition/unit_writer.hpp: bytes into memory that is programmed in whole units, each of them once, and
// can be read at any time: flash, or RAM.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../config.hpp"
#include "../store/checksum.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr std::uint8_t erased_byte = 0xFF;

/// A unit is programmed when it is full. One of nothing but erased bytes stays as it is: so whatever comes behind the
/// last byte that is not erased can still be programmed, also after the power went.
template <class Memory>
class UnitWriter {
 public:
  static constexpr std::size_t unit_bytes = Memory::unit_bytes;

  constexpr UnitWriter() noexcept = default;
  /// From `begin` on, where a unit begins.
  UnitWriter(Memory& memory, std::size_t begin) noexcept : memory_(&memory), at_(begin) {}

  /// False from the first unit on that the memory did not take.
  [[nodiscard]] bool good() const noexcept { return !has_failed_; }
  [[nodiscard]] std::size_t at() const noexcept { return at_; }

  template <class Unsigned>
  void number(Unsigned value) noexcept {
    append(value, sizeof value);
  }
  void bytes(const std::uint8_t* from, std::size_t count) noexcept {
    for (std::size_t k = 0; k < count; ++k) append(from[k], 1);
  }
  /// With the 0 behind it.
  void text(const char* from) noexcept {
    do append(static_cast<std::uint8_t>(*from), 1);
    while (*from++ != 0);
  }
  /// The same byte up to a place.
  void pad(std::size_t place, std::uint8_t byte) noexcept {
    while (at_ < place) append(byte, 1);
  }

  /// Of all bytes since `begin`, where a unit begins: those of the last unit may not have been programmed.
  [[nodiscard]] std::uint64_t checksum_since(std::size_t begin) const noexcept {
    const std::size_t pending = at_ % unit_bytes;
    return checksum(unit_, pending, checksum(memory_->bytes() + begin, at_ - pending - begin));
  }

 private:
  [[gnu::noinline]] void append(std::uint64_t value, std::size_t count) noexcept {
    for (std::size_t k = 0; k < count; ++k, value >>= 8) {
      unit_[at_ % unit_bytes] = static_cast<std::uint8_t>(value & 0xFFu);
      if (++at_ % unit_bytes == 0) has_failed_ = has_failed_ || !program(at_ - unit_bytes);
    }
  }

  [[nodiscard]] bool program(std::size_t place) noexcept {
    bool is_erased = true;
    for (const std::uint8_t byte : unit_) is_erased = is_erased && byte == erased_byte;
    if (!is_erased && !memory_->write(place, unit_)) return false;
    const std::uint8_t* const written = memory_->bytes() + place;
    for (std::size_t k = 0; k < unit_bytes; ++k) {
      if (written[k] != unit_[k]) return false;
    }
    return true;
  }

  Memory* memory_ = nullptr;
  std::size_t at_ = 0;
  std::uint8_t unit_[unit_bytes] = {};
  bool has_failed_ = false;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
