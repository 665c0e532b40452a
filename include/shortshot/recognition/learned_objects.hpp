// shortshot/recognition/learned_objects.hpp: objects that are learned where they are seen, in memory that survives: a
// log of models of one object each (see flash_model.hpp), behind the model that was trained on a PC.
//
// A model's codewords are written as they come, then its names, its header, and its checksum at last: it is there with
// the last unit of that, or not at all. Where one ends, or was torn, the next one begins. All begin with a unit, so
// they are found by looking at each: at the first 8 characters, and if these are right, at the checksum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../base/math.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../frame/local_point.hpp"
#include "../status.hpp"
#include "../store/checksum.hpp"
#include "../store/storage.hpp"
#include "flash_model.hpp"
#include "hypothesis.hpp"
#include "model_view.hpp"
#include "unit_writer.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Memory for LearnedObjects in RAM: what is learned lasts as long as it does. All zeros is not erased: erase() it.
template <std::size_t Size>
class RamMemory {
 public:
  static constexpr std::size_t unit_bytes = 1;  ///< programmed at a time

  /// Forgets all: before the first open(), too.
  void erase() noexcept { std::memset(bytes_, detail::erased_byte, Size); }
  /// All of it.
  [[nodiscard]] const std::uint8_t* bytes() const noexcept { return bytes_; }
  /// How much that is.
  [[nodiscard]] std::size_t size_bytes() const noexcept { return Size; }
  /// Writes a unit; true.
  bool write(std::size_t place, const std::uint8_t* unit) noexcept {
    bytes_[place] = *unit;
    return true;
  }

 private:
  std::uint8_t bytes_[Size] = {};
};

/// Learns objects on a microcontroller. An object is there after commit(), also if the power goes at any time later,
/// and not before it: if the power goes before, or in commit(), open() finds what was there until then.
///
///     static LearnedObjects<Stored, MyFlash> learned;
///     learned.open(model, flash);
///     for (each key point) if (recognizer.describe(cloud, search, key point, 0.04f, key) == Status::ok)
///       learned.add(key, center);
///     learned.commit("mug", "my mug");
///     recognizer.start(learned.model());
///
/// `Stored`      what the model is of
/// `Memory`      what is written to. A type with `static constexpr std::size_t unit_bytes`, what is programmed at a
///               time: a power of two, up to 64; `const std::uint8_t* bytes()`, all of it, and `std::size_t
///               size_bytes()`; and `bool write(std::size_t place, const std::uint8_t* unit)`, which programs a unit,
///               false if it cannot. Bytes are 0xFF where they were erased. No unit is programmed twice; what was
///               programmed must be seen in bytes() at once. As RamMemory is
/// `MaxObjects`  calls of commit() in all, since the memory was erased; 32 bytes each, and on hosts 48
///
/// In the memory, a commit() takes 72 bytes, and the names; a codeword its descriptor and 8 bytes. What was torn takes
/// its place until all is erased, which the caller does, before open(). No allocation; one thread.
template <class Stored, class Memory, std::size_t MaxObjects = 16>
class LearnedObjects {
  static constexpr std::size_t unit_bytes = Memory::unit_bytes;
  static constexpr std::size_t header_bytes = detail::FlashLayout(sizeof(Stored), 0, 0, 1, 0).codewords;
  static_assert(unit_bytes >= 1 && (unit_bytes & (unit_bytes - 1)) == 0 && header_bytes % unit_bytes == 0,
                "LearnedObjects<Stored, Memory> supports memory that is programmed in units of 1, 2, 4, ..., 64 bytes");
  static_assert(MaxObjects >= 1 && MaxObjects <= 65536,
                "LearnedObjects<Stored, Memory, MaxObjects> supports 1 to 65536");

 public:
  /// All zeros: static ones take no flash and no code.
  constexpr LearnedObjects() noexcept = default;
  LearnedObjects(const LearnedObjects&) = delete;
  LearnedObjects& operator=(const LearnedObjects&) = delete;

  /// Finds what was learned. `trained` is what it is learned in addition to (its bytes must stay), or a ModelView of
  /// nothing but options; another one than last time is another numbering, no more. What is not whole is passed over.
  /// Takes a look at each byte. Ends the life of views that model() gave.
  ///
  /// Statuses: bad_option (of the options), bad_view (no memory, or 2^32 bytes or more), other_descriptor (there are
  /// learned objects of another one), out_of_memory (there are more than MaxObjects). Nothing can be added then.
  [[nodiscard]] Status open(const ModelView<Stored>& trained, Memory& memory) noexcept {
    memory_ = nullptr;
    model_ = ModelView<Stored>(trained.model_);
    model_.learned_ = learned_;
    if (validate(trained.options()) != Status::ok) return Status::bad_option;
    const std::uint64_t size_bytes = memory.size_bytes() / unit_bytes * unit_bytes;
    if (memory.bytes() == nullptr || size_bytes > 0xFFFFFFFFu) return Status::bad_view;
    std::size_t end = 0;
    for (std::size_t at = 0; at < size_bytes;) {
      detail::FlashModel found;
      Status status = open_at(memory, at, found);
      if (status == Status::ok) status = append(found);
      if (status == Status::other_descriptor || status == Status::out_of_memory) return status;
      at += status == Status::ok ? whole_units(found.size_bytes()) : unit_bytes;
      if (status == Status::ok) end = at;
    }
    memory_ = &memory;
    begin_behind(end);
    return Status::ok;
  }

  /// A key point of the object that is being learned. `center`: the same place of the object in each of its views, in
  /// the coordinates of the view.
  ///
  /// Statuses, the first one that applies: not_trained (nothing is open), invalid_keypoint (it or the center is not
  /// finite, or they lie more than some 64 bandwidths apart), bad_frame, out_of_memory, not_written: then all of this
  /// object is lost. Of the others the key point alone.
  [[nodiscard]] Status add(const StoredKeyPoint<Stored>& key, const Point& center) noexcept {
    if (memory_ == nullptr) return Status::not_trained;
    if (!is_finite(key.position) || !is_finite(center)) return Status::invalid_keypoint;
    if (validate(key.frame) != Status::ok) return Status::bad_frame;
    const Point local = detail::to_local(center, key.position, key.frame);
    const float reach = 32767.0f * unit();
    for (const float c : {local.x, local.y, local.z}) {
      if (!(c >= -reach && c <= reach)) return Status::invalid_keypoint;
    }
    if (!fits(writer_.at() + detail::FlashLayout::before_row + sizeof(Stored))) return Status::out_of_memory;
    ++codewords_;
    detail::write_codeword(writer_, 0, local, unit());
    writer_.bytes(key.descriptor.bytes, sizeof(Stored));
    if (writer_.good()) return Status::ok;
    discard();
    return Status::not_written;
  }

  /// Makes a known object of the key points since the last one, or another view of an object that is known by these
  /// names. It is in model() then.
  ///
  /// Statuses: not_trained (no key point was added), bad_option (a null pointer), out_of_memory (more than MaxObjects,
  /// or the names do not fit): nothing is lost then. not_written: the object is.
  [[nodiscard]] Status commit(const char* object_class, const char* instance) noexcept {
    if (codewords_ == 0) return Status::not_trained;
    if (object_class == nullptr || instance == nullptr) return Status::bad_option;
    const std::uint64_t text_bytes = std::uint64_t{1} + text_size(object_class) + text_size(instance);
    if (model_.learned_count_ == MaxObjects || !fits(text_bytes)) return Status::out_of_memory;
    detail::FlashHeader header{0,
                               detail::storage_number<Stored>,
                               model_.options(),
                               sizeof(Stored),
                               0,  // the descriptor's order: what is learned does not depend on what was trained
                               codewords_,
                               1,
                               1,
                               static_cast<std::uint32_t>(text_bytes),
                               unit()};
    const auto checked_bytes = static_cast<std::size_t>(header.layout().checksum);
    header.size_bytes = static_cast<std::uint32_t>(checked_bytes + detail::checksum_bytes);
    if (!fits(std::uint64_t{begin_} + header.size_bytes)) return Status::out_of_memory;
    write_names(object_class, instance);
    writer_.pad(begin_ + checked_bytes, 0);
    write_header(header);
    writer_.number(writer_.checksum_since(begin_));
    writer_.pad(whole_units(writer_.at()), detail::erased_byte);
    return finish();
  }

  /// Forgets the key points since the last commit().
  void discard() noexcept {
    if (memory_ != nullptr) begin_behind(begin_);
  }

  /// What was trained and what was learned until now: for start(), after each commit() anew.
  [[nodiscard]] const ModelView<Stored>& model() const noexcept { return model_; }

  /// What is left for more, including an object that is being learned.
  [[nodiscard]] std::size_t bytes_left() const noexcept { return memory_ == nullptr ? 0 : size_bytes() - begin_; }

 private:
  [[nodiscard]] static constexpr std::size_t whole_units(std::size_t bytes) noexcept {
    return (bytes + unit_bytes - 1) / unit_bytes * unit_bytes;
  }
  /// With the 0 behind it; more than the memory has if it does not fit. (Without a bound it were a call of strlen.)
  [[nodiscard]] std::size_t text_size(const char* text) const noexcept {
    std::size_t size = 1;
    while (size <= size_bytes() && text[size - 1] != 0) ++size;
    return size;
  }
  [[nodiscard]] std::size_t size_bytes() const noexcept { return memory_->size_bytes() / unit_bytes * unit_bytes; }
  [[nodiscard]] bool fits(std::uint64_t end) const noexcept { return end <= size_bytes(); }

  /// Of centers: the power of two below a 256th of the bandwidth, so that 16 bits reach 64 bandwidths.
  [[nodiscard]] float unit() const noexcept {
    constexpr std::uint32_t exponent = 0x7F800000u;
    return detail::math::float_of(detail::math::bits_of(model_.options().bandwidth) & exponent) / 256.0f;
  }

  /// A whole model of one object of this storage, if one begins there.
  [[nodiscard]] static Status open_at(const Memory& memory, std::size_t begin, detail::FlashModel& out) noexcept {
    const std::uint8_t* const bytes = memory.bytes() + begin;
    const std::size_t left = memory.size_bytes() - begin;
    const std::size_t size = left < header_bytes ? left : detail::number32(bytes + 12);
    if (size > left) return Status::damaged_model;
    const Status status = out.open(bytes, size);
    if (status != Status::ok) return status;
    if (!ModelView<Stored>::is_of_storage(out)) return Status::other_descriptor;
    const bool is_one_object = out.class_count() == 1 && out.instance_count() == 1 && out.number_bits() == 0;
    return is_one_object ? Status::ok : Status::damaged_model;
  }
  [[nodiscard]] Status append(const detail::FlashModel& found) noexcept {
    if (model_.learned_count_ == MaxObjects) return Status::out_of_memory;
    detail::LearnedModel& next = learned_[model_.learned_count_];
    next = {found.codewords(), found.class_name(0), found.instance_name(0), 0, 0};
    model_.append(next);
    return Status::ok;
  }

  /// The next one begins behind all that was ever written, and not before `least`.
  void begin_behind(std::size_t least) noexcept {
    std::size_t end = size_bytes();
    while (end > least && memory_->bytes()[end - 1] == detail::erased_byte) --end;
    begin_ = whole_units(end);
    writer_ = {*memory_, begin_ + header_bytes};
    codewords_ = 0;
  }

  void write_names(const char* object_class, const char* instance) noexcept {
    writer_.number(std::uint8_t{0});  // no layout: its number is in the header
    writer_.text(object_class);
    writer_.text(instance);
  }
  void write_header(const detail::FlashHeader& header) noexcept {
    detail::UnitWriter<Memory> to(*memory_, begin_);
    to.bytes(reinterpret_cast<const std::uint8_t*>(detail::flash_model_magic), 8);
    to.number(detail::flash_model_version);
    detail::write(to, header);
    to.pad(begin_ + header_bytes, 0);  // the class of the instance, too
  }

  [[nodiscard]] Status finish() noexcept {
    detail::FlashModel made;
    const bool is_made = writer_.good() && open_at(*memory_, begin_, made) == Status::ok;
    if (is_made) static_cast<void>(append(made));
    begin_behind(is_made ? writer_.at() : begin_);
    return is_made ? Status::ok : Status::not_written;
  }

  Memory* memory_ = nullptr;
  ModelView<Stored> model_;
  detail::LearnedModel learned_[MaxObjects] = {};
  std::size_t begin_ = 0;  // of the object that is being learned, which is none yet
  std::uint32_t codewords_ = 0;
  detail::UnitWriter<Memory> writer_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
