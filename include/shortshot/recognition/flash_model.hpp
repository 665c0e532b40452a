// shortshot/recognition/flash_model.hpp: a trained recognizer as bytes that are read where they lie, in flash:
// save_for_flash() writes them.
//
// All numbers are little-endian, floats by their bits:
//
//      0  8 characters "SSHOTFLA", 4 bytes format version, 4 bytes size of all, a multiple of 4
//     16  8 bytes storage_number of what is stored
//     24  options: 4 bytes each bandwidth, neighbors, most
//     36  4 bytes each: bytes of a row, codewords, instances, classes, bytes of text
//     56  4 bytes, as a float: the unit of centers in meters, a power of two
//     60  4 bytes bits of a number of a row
//     64  for each instance 2 bytes class; 2 bytes 0 if that is no multiple of 4
//         for each codeword 2 bytes instance, 3 times 2 bytes center in the key point's frame, signed
//         for each number of a row 2 bytes: which one of the descriptor it is; 2 bytes 0 if that is no multiple of 4
//         rows of codes or bits, one per codeword, without gaps
//         text, a 0 behind each: storage_layout, names of classes, names of instances
//         up to three bytes 0
//         8 bytes checksum (64-bit FNV-1a) of all bytes before it
#pragma once

#include <cstddef>
#include <cstdint>

#include "../base/math.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "../store/checksum.hpp"
#include "../store/code_distance.hpp"
#include "../store/storage.hpp"
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
  static constexpr std::uint64_t header = 64;
  static constexpr std::uint64_t codeword = 8;

  std::uint64_t codewords;
  std::uint64_t order;
  std::uint64_t rows;
  std::uint64_t text;
  std::uint64_t checksum;

  [[nodiscard]] static constexpr std::uint64_t whole(std::uint64_t bytes) noexcept { return (bytes + 3) / 4 * 4; }

  constexpr FlashLayout(std::uint32_t row_bytes, std::uint32_t number_count, std::uint32_t codeword_count,
                        std::uint32_t instance_count, std::uint32_t text_bytes) noexcept
      : codewords(header + whole(2 * std::uint64_t{instance_count})),
        order(codewords + codeword * codeword_count),
        rows(order + whole(2 * std::uint64_t{number_count})),
        text(rows + std::uint64_t{row_bytes} * codeword_count),
        checksum(whole(text + text_bytes)) {}
};

/// A model of any storage. Validated once, in open(): a look at each byte, and at each codeword, instance and name.
class FlashModel {
 public:
  /// Statuses: not_a_model, other_version, damaged_model. What was open before stays so if it is not ok.
  [[nodiscard]] Status open(const std::uint8_t* bytes, std::size_t size_bytes) noexcept {
    if (bytes == nullptr || size_bytes < 8) return Status::not_a_model;
    for (std::size_t i = 0; i < 8; ++i) {
      if (bytes[i] != static_cast<std::uint8_t>(flash_model_magic[i])) return Status::not_a_model;
    }
    if (size_bytes < 12) return Status::damaged_model;
    if (number32(bytes + 8) != flash_model_version) return Status::other_version;
    FlashModel model;
    if (!model.read_header(bytes, size_bytes) || !model.is_sound()) return Status::damaged_model;
    *this = model;
    return Status::ok;
  }

  [[nodiscard]] std::uint64_t storage() const noexcept { return storage_; }
  [[nodiscard]] const RecognizerOptions& options() const noexcept { return options_; }
  [[nodiscard]] std::uint32_t row_bytes() const noexcept { return row_bytes_; }
  [[nodiscard]] std::uint32_t codeword_count() const noexcept { return codewords_; }
  [[nodiscard]] std::uint32_t instance_count() const noexcept { return instances_; }
  [[nodiscard]] std::uint32_t class_count() const noexcept { return classes_; }
  [[nodiscard]] std::uint32_t class_of(std::uint32_t instance) const noexcept {
    return number16(bytes_ + FlashLayout::header + 2 * std::size_t{instance});
  }
  [[nodiscard]] std::uint32_t instance_of(std::uint32_t codeword) const noexcept { return number16(at(codeword)); }
  [[nodiscard]] Point center_of(std::uint32_t codeword) const noexcept {
    const auto coordinate = [&](std::uint32_t offset) {
      return static_cast<float>(static_cast<std::int16_t>(number16(at(codeword) + offset))) * unit_;
    };
    return {coordinate(2), coordinate(4), coordinate(6)};
  }
  [[nodiscard]] std::uint32_t number_bits() const noexcept { return number_bits_; }
  [[nodiscard]] std::uint32_t number_count() const noexcept { return numbers_; }
  /// Which number of a descriptor is number i of a row: those come first that tell most codewords apart.
  [[nodiscard]] std::uint32_t place_of(std::uint32_t i) const noexcept {
    return number16(bytes_ + order_ + 2 * std::size_t{i});
  }
  [[nodiscard]] const std::uint8_t* row(std::uint32_t codeword) const noexcept {
    return bytes_ + rows_ + std::size_t{row_bytes_} * codeword;
  }
  /// 0 is the layout, then come the classes and the instances.
  [[nodiscard]] const char* text(std::uint32_t number) const noexcept {
    const char* place = reinterpret_cast<const char*>(bytes_ + text_);
    while (number > 0) number -= *place++ == 0 ? 1u : 0u;
    return place;
  }

 private:
  [[nodiscard]] const std::uint8_t* at(std::uint32_t codeword) const noexcept {
    return bytes_ + codewords_begin_ + FlashLayout::codeword * codeword;
  }

  [[nodiscard]] bool read_header(const std::uint8_t* bytes, std::size_t size_bytes) noexcept {
    if (size_bytes < FlashLayout::header + checksum_bytes || number32(bytes + 12) != size_bytes) return false;
    bytes_ = bytes;
    storage_ = number64(bytes + 16);
    options_ = {math::float_of(number32(bytes + 24)), number32(bytes + 28), number32(bytes + 32)};
    row_bytes_ = number32(bytes + 36);
    codewords_ = number32(bytes + 40);
    instances_ = number32(bytes + 44);
    classes_ = number32(bytes + 48);
    text_bytes_ = number32(bytes + 52);
    unit_ = math::float_of(number32(bytes + 56));
    number_bits_ = number32(bytes + 60);
    const bool has_numbers = row_bytes_ > 0 && row_bytes_ <= 66051 && number_bits_ >= 1 && number_bits_ <= 8;
    if (!has_numbers) return false;
    numbers_ = 8 * row_bytes_ / number_bits_;
    const FlashLayout layout(row_bytes_, numbers_, codewords_, instances_, text_bytes_);
    if (layout.checksum + checksum_bytes != size_bytes) return false;
    codewords_begin_ = static_cast<std::size_t>(layout.codewords);
    order_ = static_cast<std::size_t>(layout.order);
    rows_ = static_cast<std::size_t>(layout.rows);
    text_ = static_cast<std::size_t>(layout.text);
    const auto checked = static_cast<std::size_t>(layout.checksum);
    return checksum(bytes, checked) == number64(bytes + checked);
  }

  /// A checksum may be right by chance, or by design: nothing that is read later may be wrong.
  [[nodiscard]] bool is_sound() const noexcept {
    bool sound = validate(options_) == Status::ok && codewords_ > 0 && instances_ <= 65536 && classes_ <= 65536 &&
                 unit_ >= 1e-30f && unit_ <= 1e30f;
    for (std::uint32_t i = 0; sound && i < instances_; ++i) sound = class_of(i) < classes_;
    for (std::uint32_t i = 0; sound && i < codewords_; ++i) sound = instance_of(i) < instances_;
    for (std::uint32_t i = 0; sound && i < number_count(); ++i) sound = place_of(i) < number_count();
    std::uint32_t texts = 0;
    for (std::uint32_t i = 0; i < text_bytes_; ++i) texts += bytes_[text_ + i] == 0 ? 1u : 0u;
    return sound && texts == 1 + classes_ + instances_ && bytes_[text_ + text_bytes_ - 1] == 0;
  }

  const std::uint8_t* bytes_ = nullptr;
  std::uint64_t storage_ = 0;
  RecognizerOptions options_{0.0f, 0, 0};
  float unit_ = 0.0f;
  std::uint32_t row_bytes_ = 0;
  std::uint32_t number_bits_ = 0;
  std::uint32_t numbers_ = 0;
  std::uint32_t codewords_ = 0;
  std::uint32_t instances_ = 0;
  std::uint32_t classes_ = 0;
  std::uint32_t text_bytes_ = 0;
  std::size_t codewords_begin_ = 0;
  std::size_t order_ = 0;
  std::size_t rows_ = 0;
  std::size_t text_ = 0;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A recognizer's model of descriptors in a storage (CodedDescriptor, BinaryDescriptor or SumBits), in memory that is
/// only read and must outlive the view. Nothing is copied, nothing allocated; reentrant.
///
///     ModelView<NibbleDescriptor<ShapeColor95>> model;
///     if (model.open(cups_model, sizeof cups_model) != Status::ok) ...
///     model.instance_name(3);
template <class Stored>
class ModelView {
 public:
  /// What save_for_flash() has written. Takes a look at each byte (some 10 instructions each on a Cortex-M), whatever
  /// they say. Statuses, the first one that applies: not_a_model, other_version, damaged_model, other_descriptor. A
  /// model that was open before stays so.
  [[nodiscard]] Status open(const std::uint8_t* bytes, std::size_t size_bytes) noexcept {
    detail::FlashModel opened;
    const Status status = opened.open(bytes, size_bytes);
    if (status != Status::ok) return status;
    const bool alike = opened.storage() == detail::storage_number<Stored> && opened.row_bytes() == sizeof(Stored) &&
                       opened.number_bits() == std::uint32_t{number_bits};
    if (!alike) return Status::other_descriptor;
    model_ = opened;
    return Status::ok;
  }

  /// As it was trained; all zeros, and no codewords, before a model is open.
  [[nodiscard]] const RecognizerOptions& options() const noexcept { return model_.options(); }
  [[nodiscard]] std::uint32_t codeword_count() const noexcept { return model_.codeword_count(); }
  [[nodiscard]] std::uint32_t instance_count() const noexcept { return model_.instance_count(); }
  [[nodiscard]] std::uint32_t class_count() const noexcept { return model_.class_count(); }
  /// For numbers below the counts. Names are looked for from the first one on.
  [[nodiscard]] std::uint32_t class_of(std::uint32_t instance) const noexcept { return model_.class_of(instance); }
  [[nodiscard]] const char* class_name(std::uint32_t object_class) const noexcept {
    return model_.text(1 + object_class);
  }
  [[nodiscard]] const char* instance_name(std::uint32_t instance) const noexcept {
    return model_.text(1 + class_count() + instance);
  }
  [[nodiscard]] std::uint32_t instance_of(std::uint32_t codeword) const noexcept {
    return model_.instance_of(codeword);
  }
  /// The object's center in the frame of the codeword's key point.
  [[nodiscard]] Point center_of(std::uint32_t codeword) const noexcept { return model_.center_of(codeword); }
  /// As it was trained.
  [[nodiscard]] Stored descriptor(std::uint32_t codeword) const noexcept {
    Stored out{};
    for (std::uint32_t i = 0; i < model_.number_count(); ++i) {
      detail::put_number<number_bits>(out.bytes, model_.place_of(i),
                                      detail::number_at<number_bits>(model_.row(codeword), i));
    }
    return out;
  }

  /// The order of the codes or bits in a row: how many there are, and which one of the descriptor number i is.
  [[nodiscard]] std::uint32_t number_count() const noexcept { return model_.number_count(); }
  [[nodiscard]] std::uint32_t place_of(std::uint32_t i) const noexcept { return model_.place_of(i); }

  /// A codeword's descriptor with its codes or bits in the model's order, in which those come first that tell most
  /// codewords apart, and another descriptor in that order: the distance is the same. No copy; all zeros before a model
  /// is open.
  [[nodiscard]] const Stored& arranged(std::uint32_t codeword) const noexcept {
    static_assert(alignof(Stored) == 1, "ModelView<Stored> supports storages of bytes");
    return reinterpret_cast<const Stored*>(model_.row(0))[codeword];
  }
  [[nodiscard]] Stored arranged(const Stored& stored) const noexcept {
    Stored out{};
    if (codeword_count() == 0) return out;
    detail::arrange<number_bits>(stored.bytes, out.bytes, sizeof out.bytes,
                                 [&](std::size_t i) { return model_.place_of(static_cast<std::uint32_t>(i)); });
    return out;
  }

 private:
  static constexpr int number_bits = detail::Storage<Stored>::number_bits;

  detail::FlashModel model_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
