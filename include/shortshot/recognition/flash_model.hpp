// shortshot/recognition/flash_model.hpp: a trained recognizer as bytes that are read where they lie, in flash:
// save_for_flash() writes them.
//
// All numbers are little-endian, floats by their bits:
//
//      0  8 characters "SSHOTFLA", 4 bytes format version, 4 bytes size of all, a multiple of 4
//     16  8 bytes storage_number of what is stored
//     24  options: 4 bytes each bandwidth, neighbors, most
//     36  3 bytes: bytes of a row; 1 byte: bits of a number of a row, or 0 if these are in the descriptor's order
//     40  4 bytes each: codewords, instances, classes, bytes of text
//     56  4 bytes, as a float: the unit of centers in meters, a power of two
//     60  for each instance 2 bytes class; 2 bytes 0 if that is no multiple of 4
//         unless that is 0, for each number of a row 2 bytes, which one of the descriptor it is; 2 bytes 0 if that is
//         no multiple of 4 for each codeword 2 bytes instance, 3 times 2 bytes center in the key point's frame, signed,
//         and its row of codes or bits, without gaps text, a 0 behind each: storage_layout, names of classes, names of
//         instances up to three bytes 0 8 bytes checksum (64-bit FNV-1a) of all bytes before it
#pragma once

#include <cstddef>
#include <cstdint>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "../store/checksum.hpp"
#include "hypothesis.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr char flash_model_magic[] = "SSHOTFLA";
inline constexpr std::uint32_t flash_model_version = 1;

[[nodiscard]] inline std::uint32_t number16(const std::uint8_t* bytes) noexcept {
  return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
}
[[nodiscard]] inline std::uint32_t number32(const std::uint8_t* bytes) noexcept {
  return number16(bytes) | number16(bytes + 2) << 16;
}
[[nodiscard]] inline std::uint64_t number64(const std::uint8_t* bytes) noexcept {
  return number32(bytes) | static_cast<std::uint64_t>(number32(bytes + 4)) << 32;
}

/// Where the parts of a model begin, by how many there are of each. Numbers of 64 bits: sums of products of what may be
/// damaged fit.
struct FlashLayout {
  static constexpr std::uint64_t header = 60;
  static constexpr std::uint64_t before_row = 8;  // of a codeword

  std::uint64_t order;
  std::uint64_t codewords;
  std::uint64_t text;
  std::uint64_t checksum;

  [[nodiscard]] static constexpr std::uint64_t whole(std::uint64_t bytes) noexcept { return (bytes + 3) / 4 * 4; }

  constexpr FlashLayout(std::uint32_t row_bytes, std::uint32_t number_count, std::uint32_t codeword_count,
                        std::uint32_t instance_count, std::uint32_t text_bytes) noexcept
      : order(header + whole(2 * std::uint64_t{instance_count})),
        codewords(order + whole(2 * std::uint64_t{number_count})),
        text(codewords + (before_row + row_bytes) * codeword_count),
        checksum(whole(text + text_bytes)) {}
};

/// What stands before the codewords, but for the first 12 bytes.
struct FlashHeader {
  std::uint32_t size_bytes = 0;
  std::uint64_t storage = 0;
  RecognizerOptions options{0.0f, 0, 0};
  std::uint32_t row_bytes = 0;
  std::uint32_t number_bits = 0;
  std::uint32_t codewords = 0;
  std::uint32_t instances = 0;
  std::uint32_t classes = 0;
  std::uint32_t text_bytes = 0;
  float unit = 0.0f;

  /// Of numbers whose order the model has.
  [[nodiscard]] constexpr std::uint32_t number_count() const noexcept {
    return number_bits == 0 ? 0 : 8 * row_bytes / number_bits;
  }
  [[nodiscard]] constexpr FlashLayout layout() const noexcept {
    return {row_bytes, number_count(), codewords, instances, text_bytes};
  }
};

template <class Writer>
void write(Writer& to, const FlashHeader& header) {
  to.number(header.size_bytes);
  to.number(header.storage);
  to.number(math::bits_of(header.options.bandwidth));
  to.number(header.options.neighbors);
  to.number(header.options.most);
  to.number(header.row_bytes | header.number_bits << 24);
  to.number(header.codewords);
  to.number(header.instances);
  to.number(header.classes);
  to.number(header.text_bytes);
  to.number(math::bits_of(header.unit));
}

/// A coordinate in whole units, to the nearest.
[[nodiscard]] inline std::uint16_t units_of(float coordinate, float unit) noexcept {
  const float units = coordinate / unit;
  std::int32_t rounded[extend::simd::lanes];
  store(rounded, round_to_int(extend::simd::all(units > 32767.0f ? 32767.0f : units < -32767.0f ? -32767.0f : units)));
  return static_cast<std::uint16_t>(rounded[0]);
}

/// What stands before a codeword's row.
template <class Writer>
void write_codeword(Writer& to, std::uint32_t instance, const Point& center, float unit) {
  to.number(static_cast<std::uint16_t>(instance));
  to.number(units_of(center.x, unit));
  to.number(units_of(center.y, unit));
  to.number(units_of(center.z, unit));
}

/// Codewords as a model has them, one behind the other.
struct CodewordRun {
  const std::uint8_t* bytes = nullptr;
  std::uint32_t count = 0;
  std::uint32_t row_bytes = 0;
  float unit = 0.0f;
  bool is_arranged = false;  // not in the descriptor's order

  [[nodiscard]] const std::uint8_t* at(std::uint32_t i) const noexcept {
    return bytes + (FlashLayout::before_row + row_bytes) * i;
  }
  [[nodiscard]] const std::uint8_t* row(std::uint32_t i) const noexcept { return at(i) + FlashLayout::before_row; }
  [[nodiscard]] std::uint32_t instance_of(std::uint32_t i) const noexcept { return number16(at(i)); }
  [[nodiscard]] Point center_of(std::uint32_t i) const noexcept {
    const auto coordinate = [&](std::uint32_t offset) {
      return static_cast<float>(static_cast<std::int16_t>(number16(at(i) + offset))) * unit;
    };
    return {coordinate(2), coordinate(4), coordinate(6)};
  }
};

/// A model of any storage. Validated once, in open(): a look at each byte, and at each codeword, instance and name.
class FlashModel {
 public:
  constexpr FlashModel() noexcept = default;
  /// None yet, but its options are known.
  explicit constexpr FlashModel(const RecognizerOptions& options) noexcept { header_.options = options; }

  /// Statuses: not_a_model, other_version, damaged_model. What was open before stays so if it is not ok.
  [[nodiscard]] Status open(const std::uint8_t* bytes, std::size_t size_bytes) noexcept {
    if (bytes == nullptr || size_bytes < 8) return Status::not_a_model;
    for (std::size_t i = 0; i < 8; ++i) {
      if (bytes[i] != static_cast<std::uint8_t>(flash_model_magic[i])) return Status::not_a_model;
    }
    if (size_bytes < 12) return Status::damaged_model;
    if (number32(bytes + 8) != flash_model_version) return Status::other_version;
    FlashModel model;
    if (!model.read(bytes, size_bytes) || !model.is_sound()) return Status::damaged_model;
    *this = model;
    return Status::ok;
  }

  [[nodiscard]] std::uint32_t size_bytes() const noexcept { return header_.size_bytes; }
  [[nodiscard]] std::uint64_t storage() const noexcept { return header_.storage; }
  [[nodiscard]] const RecognizerOptions& options() const noexcept { return header_.options; }
  [[nodiscard]] std::uint32_t row_bytes() const noexcept { return header_.row_bytes; }
  [[nodiscard]] std::uint32_t codeword_count() const noexcept { return header_.codewords; }
  [[nodiscard]] std::uint32_t instance_count() const noexcept { return header_.instances; }
  [[nodiscard]] std::uint32_t class_count() const noexcept { return header_.classes; }
  [[nodiscard]] std::uint32_t class_of(std::uint32_t instance) const noexcept {
    return number16(bytes_ + FlashLayout::header + 2 * std::size_t{instance});
  }
  [[nodiscard]] const char* class_name(std::uint32_t object_class) const noexcept { return text(1 + object_class); }
  [[nodiscard]] const char* instance_name(std::uint32_t instance) const noexcept {
    return text(1 + class_count() + instance);
  }
  [[nodiscard]] std::uint32_t number_bits() const noexcept { return header_.number_bits; }
  /// Which number of a descriptor is number i of a row, of number_count() ones: those come first that tell most
  /// codewords apart. 0, and the order is that of the descriptor.
  [[nodiscard]] std::uint32_t number_count() const noexcept { return header_.number_count(); }
  [[nodiscard]] std::uint32_t place_of(std::uint32_t i) const noexcept {
    return number16(bytes_ + header_.layout().order + 2 * std::size_t{i});
  }
  [[nodiscard]] CodewordRun codewords() const noexcept {
    const std::uint8_t* const begin = bytes_ == nullptr ? nullptr : bytes_ + header_.layout().codewords;
    return {begin, header_.codewords, header_.row_bytes, header_.unit, header_.number_bits != 0};
  }
  [[nodiscard]] std::uint32_t instance_of(std::uint32_t codeword) const noexcept {
    return codewords().instance_of(codeword);
  }
  [[nodiscard]] Point center_of(std::uint32_t codeword) const noexcept { return codewords().center_of(codeword); }
  /// 0 is the layout, then come the classes and the instances.
  [[nodiscard]] const char* text(std::uint32_t number) const noexcept {
    const char* place = reinterpret_cast<const char*>(bytes_ + header_.layout().text);
    while (number > 0) number -= *place++ == 0 ? 1u : 0u;
    return place;
  }

 private:
  [[nodiscard]] bool read(const std::uint8_t* bytes, std::size_t size_bytes) noexcept {
    if (size_bytes < FlashLayout::header + checksum_bytes || number32(bytes + 12) != size_bytes) return false;
    bytes_ = bytes;
    header_.size_bytes = number32(bytes + 12);
    header_.storage = number64(bytes + 16);
    header_.options = {math::float_of(number32(bytes + 24)), number32(bytes + 28), number32(bytes + 32)};
    header_.row_bytes = number32(bytes + 36) & 0xFFFFFFu;
    header_.number_bits = bytes[39];
    header_.codewords = number32(bytes + 40);
    header_.instances = number32(bytes + 44);
    header_.classes = number32(bytes + 48);
    header_.text_bytes = number32(bytes + 52);
    header_.unit = math::float_of(number32(bytes + 56));
    if (header_.row_bytes == 0 || header_.row_bytes > 66051 || header_.number_bits > 8) return false;
    const std::uint64_t checked = header_.layout().checksum;
    if (checked + checksum_bytes != size_bytes) return false;
    return checksum(bytes, static_cast<std::size_t>(checked)) == number64(bytes + checked);
  }

  /// A checksum may be right by chance, or by design: nothing that is read later may be wrong.
  [[nodiscard]] bool is_sound() const noexcept {
    const FlashHeader& h = header_;
    bool sound = validate(h.options) == Status::ok && h.codewords > 0 && h.instances <= 65536 && h.classes <= 65536 &&
                 h.unit >= 1e-30f && h.unit <= 1e30f;
    for (std::uint32_t i = 0; sound && i < h.instances; ++i) sound = class_of(i) < h.classes;
    const CodewordRun run = codewords();
    for (std::uint32_t i = 0; sound && i < run.count; ++i) sound = run.instance_of(i) < h.instances;
    const std::uint32_t numbers = number_count();
    for (std::uint32_t i = 0; sound && i < numbers; ++i) sound = place_of(i) < numbers;
    const std::uint8_t* const text_begin = bytes_ + h.layout().text;
    std::uint32_t texts = 0;
    for (std::uint32_t i = 0; i < h.text_bytes; ++i) texts += text_begin[i] == 0 ? 1u : 0u;
    return sound && texts == 1 + h.classes + h.instances && text_begin[h.text_bytes - 1] == 0;
  }

  const std::uint8_t* bytes_ = nullptr;
  FlashHeader header_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
