// shortshot/store/byte_stream.hpp: what all of the library's files have in common. Hosted only: allocates.
//
// All numbers are little-endian, floats by their bits, counts and lengths 8 bytes:
//
//     8 characters that say what it is, 4 bytes format version
//     what is saved
//     8 bytes checksum of all bytes before it
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "../base/math.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "checksum.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What a file is: its first characters, and the version of the format.
struct FileKind {
  std::string_view magic;
  std::uint32_t version;

  [[nodiscard]] std::size_t header_bytes() const noexcept { return magic.size() + sizeof version; }
};

/// Writes a file into bytes. It is complete after finish().
class ByteWriter {
 public:
  /// In place of whatever was there; `expected_bytes` saves allocations.
  ByteWriter(std::vector<std::uint8_t>& bytes, const FileKind& kind, std::size_t expected_bytes) : bytes_(bytes) {
    bytes.clear();
    bytes.reserve(expected_bytes);
    characters(kind.magic);
    number(kind.version);
  }
  void finish() { number(checksum(bytes_.data(), bytes_.size())); }

  template <class Unsigned>
  void number(Unsigned value) {
    append(value, sizeof value);
  }
  void count(std::size_t value) { append(value, 8); }
  void real(float value) { append(math::bits_of(value), sizeof value); }
  [[gnu::noinline]] void reals(const float* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) real(values[i]);
  }
  void point(const Point& p) {
    const float values[3] = {p.x, p.y, p.z};
    reals(values, 3);
  }
  /// Zeros up to a place.
  void pad(std::size_t place) {
    while (bytes_.size() < place) number(std::uint8_t{0});
  }
  void name(std::string_view text) {
    count(text.size());
    characters(text);
  }

 private:
  void characters(std::string_view text) {
    for (const char c : text) append(static_cast<std::uint8_t>(c), 1);
  }
  [[gnu::noinline]] void append(std::uint64_t value, std::size_t bytes) {
    for (std::size_t k = 0; k < bytes; ++k) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * k) & 0xFFu));
  }

  std::vector<std::uint8_t>& bytes_;
};

/// Reads what may be damaged: from the first thing on that cannot be, all is zero and good() false.
class ByteReader {
 public:
  ByteReader(const std::uint8_t* bytes, std::size_t size) noexcept : at_(bytes), left_(size) {}

  [[nodiscard]] bool good() const noexcept { return good_; }
  [[nodiscard]] std::size_t left() const noexcept { return left_; }
  void require(bool condition) noexcept { good_ = good_ && condition; }

  template <class Unsigned>
  [[nodiscard]] Unsigned number() noexcept {
    return static_cast<Unsigned>(number_of(sizeof(Unsigned)));
  }
  /// Any bits, those of NaN too.
  [[nodiscard]] float any_real() noexcept { return math::float_of(number<std::uint32_t>()); }
  [[nodiscard]] float real() noexcept {
    const float value = any_real();
    require(math::is_finite(value));
    return good_ ? value : 0.0f;
  }
  [[gnu::noinline]] void reals(float* values, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) values[i] = real();
  }
  [[nodiscard]] Point point() noexcept {
    float values[3];
    reals(values, 3);
    return {values[0], values[1], values[2]};
  }
  /// How many there are of something that takes `least` bytes or more each: no more than the bytes that are left hold.
  [[nodiscard]] std::size_t count(std::size_t least) noexcept {
    const std::uint64_t value = number_of(8);
    require(value <= left_ / least);
    return good_ ? static_cast<std::size_t>(value) : 0;
  }
  /// One of `count` things.
  [[nodiscard]] std::uint32_t index(std::size_t count) noexcept {
    const auto value = number<std::uint32_t>();
    require(value < count);
    return good_ ? value : 0;
  }
  [[nodiscard]] std::string name() {
    const std::size_t length = count(1);
    const std::uint8_t* const characters = take(length);
    return {characters, characters + length};
  }

 private:
  [[nodiscard, gnu::noinline]] std::uint64_t number_of(std::size_t size) noexcept {
    const std::uint8_t* const bytes = take(size);
    std::uint64_t value = 0;
    for (std::size_t k = size; good_ && k-- > 0;) value = value << 8 | bytes[k];
    return value;
  }
  [[nodiscard]] const std::uint8_t* take(std::size_t size) noexcept {
    require(size <= left_);
    if (!good_) return at_;
    left_ -= size;
    at_ += size;
    return at_ - size;
  }

  const std::uint8_t* at_;
  std::size_t left_;
  bool good_ = true;
};

/// Leaves `body` at what is saved, if the bytes around it are right; not_a_model, other_version or damaged_model (the
/// bytes end early, or the checksum is wrong) if not, the first that applies.
[[nodiscard]] inline Status open_checked(const std::uint8_t* bytes, std::size_t size, const FileKind& kind,
                                         ByteReader& body) noexcept {
  const std::size_t magic_bytes = kind.magic.size();
  if (bytes == nullptr || size < magic_bytes) return Status::not_a_model;
  for (std::size_t i = 0; i < magic_bytes; ++i) {
    if (bytes[i] != static_cast<std::uint8_t>(kind.magic[i])) return Status::not_a_model;
  }
  ByteReader header(bytes + magic_bytes, size - magic_bytes);
  const auto version = header.number<std::uint32_t>();
  if (header.good() && version != kind.version) return Status::other_version;
  if (header.left() < checksum_bytes) return Status::damaged_model;
  const std::size_t checked_bytes = size - checksum_bytes;
  ByteReader sum(bytes + checked_bytes, checksum_bytes);
  if (sum.number<std::uint64_t>() != checksum(bytes, checked_bytes)) return Status::damaged_model;
  body = ByteReader(bytes + kind.header_bytes(), checked_bytes - kind.header_bytes());
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
