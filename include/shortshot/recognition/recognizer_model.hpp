// shortshot/recognition/recognizer_model.hpp: a trained recognizer as bytes, or in a file. Hosted only: allocates.
//
// All numbers are little-endian, floats by their bits, counts and lengths 8 bytes:
//
//     "SSHOTREC", 4 bytes format version
//     layout (length, characters), values of a row
//     options: 4 bytes each bandwidth, neighbors, most
//     count of classes, for each: name (length, characters)
//     count of instances, for each: 4 bytes class, name (length, characters)
//     count of codewords, for each: 4 bytes instance, 3 floats center in the key point's frame
//     values, row by row
//     8 bytes checksum (64-bit FNV-1a) of all bytes before it
//
// FNV-1a is three lines, and each of its steps is a bijection: no single wrong byte goes unnoticed, and other damage
// does once in 2^64 times. It is no protection from who means harm; load() believes no number because of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../base/math.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "codebook.hpp"
#include "recognize.hpp"
#include "recognizer.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr std::string_view model_magic = "SSHOTREC";
inline constexpr std::uint32_t model_version = 1;
inline constexpr std::size_t checksum_bytes = 8;

[[nodiscard]] inline std::uint64_t checksum(const std::uint8_t* bytes, std::size_t size) noexcept {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 0x100000001B3u;
  return hash;
}

class ModelWriter {
 public:
  explicit ModelWriter(std::vector<std::uint8_t>& bytes) noexcept : bytes_(bytes) {}

  template <class Unsigned>
  void number(Unsigned value) {
    number(value, sizeof value);
  }
  void count(std::size_t value) { number(std::uint64_t{value}); }
  void real(float value) { number(math::bits_of(value)); }
  void characters(std::string_view text) {
    for (const char c : text) number(static_cast<std::uint8_t>(c));
  }
  void name(std::string_view text) {
    count(text.size());
    characters(text);
  }

 private:
  [[gnu::noinline]] void number(std::uint64_t value, std::size_t bytes) {
    for (std::size_t k = 0; k < bytes; ++k) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * k) & 0xFFu));
  }

  std::vector<std::uint8_t>& bytes_;
};

/// Reads what may be damaged: from the first thing on that cannot be, all is zero and good() false.
class ModelReader {
 public:
  ModelReader(const std::uint8_t* bytes, std::size_t size) noexcept : at_(bytes), left_(size) {}

  [[nodiscard]] bool good() const noexcept { return good_; }
  [[nodiscard]] std::size_t left() const noexcept { return left_; }
  void require(bool condition) noexcept { good_ = good_ && condition; }

  template <class Unsigned>
  [[nodiscard]] Unsigned number() noexcept {
    const std::uint8_t* const bytes = take(sizeof(Unsigned));
    Unsigned value = 0;
    for (std::size_t k = sizeof value; good_ && k-- > 0;) value = static_cast<Unsigned>(value << 8 | bytes[k]);
    return value;
  }
  [[nodiscard]] float real() noexcept {
    const float value = math::float_of(number<std::uint32_t>());
    require(math::is_finite(value));
    return good_ ? value : 0.0f;
  }
  [[nodiscard]] Point point() noexcept {
    const float x = real();
    const float y = real();
    return {x, y, real()};
  }
  /// How many there are of something that takes `least` bytes or more each: no more than the bytes that are left hold.
  [[nodiscard]] std::size_t count(std::size_t least) noexcept {
    const auto value = number<std::uint64_t>();
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

/// The C library's: <fstream> takes more time to compile than all that would be used of it.
class File {
 public:
  File(const std::string& path, const char* mode) noexcept : file_(std::fopen(path.c_str(), mode)) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { static_cast<void>(close()); }

  [[nodiscard]] bool write(const std::vector<std::uint8_t>& bytes) noexcept {
    return file_ != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size();
  }
  /// All that is left.
  [[nodiscard]] bool read(std::vector<std::uint8_t>& bytes) {
    if (file_ == nullptr) return false;
    std::uint8_t block[4096];
    while (const std::size_t count = std::fread(block, 1, sizeof block, file_)) {
      bytes.insert(bytes.end(), block, block + count);
    }
    return std::ferror(file_) == 0;
  }
  /// Only then the last bytes are known to be written.
  [[nodiscard]] bool close() noexcept {
    const bool is_closed = file_ != nullptr && std::fclose(file_) == 0;
    file_ = nullptr;
    return is_closed;
  }

 private:
  std::FILE* file_;
};

inline void write(ModelWriter& to, const RecognizerOptions& options, const Codebook& codebook) {
  to.name(codebook.layout);
  to.count(codebook.row_size);
  to.real(options.bandwidth);
  to.number(options.neighbors);
  to.number(options.most);
  to.count(codebook.classes.size());
  for (const std::string& name : codebook.classes) to.name(name);
  to.count(codebook.instances.size());
  for (const Codebook::Instance& instance : codebook.instances) {
    to.number(instance.object_class);
    to.name(instance.name);
  }
  to.count(codebook.codewords.size());
  for (const Codebook::Codeword& codeword : codebook.codewords) {
    to.number(codeword.instance);
    for (std::size_t axis = 0; axis < 3; ++axis) to.real(coordinate(codeword.center, axis));
  }
  for (const float value : codebook.values) to.real(value);
}

/// False if not all of it can be: then what has been read is of no use.
[[nodiscard]] inline bool read(ModelReader& from, RecognizerOptions& options, Codebook& codebook) {
  codebook.layout = from.name();
  codebook.row_size = from.count(sizeof(float));
  options.bandwidth = from.real();
  options.neighbors = from.number<std::uint32_t>();
  options.most = from.number<std::uint32_t>();
  from.require(validate(options) == Status::ok);
  for (std::size_t i = from.count(8); i > 0 && from.good(); --i) codebook.classes.push_back(from.name());
  for (std::size_t i = from.count(12); i > 0 && from.good(); --i) {
    const std::uint32_t object_class = from.index(codebook.classes.size());
    codebook.instances.push_back({object_class, from.name()});
  }
  const std::size_t codewords = from.count(16);
  from.require(codewords > 0 && codewords < no_row);
  codebook.codewords.reserve(codewords);
  for (std::size_t i = codewords; i > 0 && from.good(); --i) {
    const std::uint32_t instance = from.index(codebook.instances.size());
    codebook.codewords.push_back({instance, from.point()});
  }
  const std::size_t row_bytes = sizeof(float) * codebook.row_size;
  from.require(row_bytes > 0 && from.left() % row_bytes == 0 && from.left() / row_bytes == codewords);
  if (!from.good()) return false;
  codebook.values.reserve(from.left() / sizeof(float));
  while (from.left() > 0 && from.good()) codebook.values.push_back(from.real());
  return from.good();
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A trained recognizer, with its options, as bytes: the same ones on every machine. Statuses: not_trained, bad_option;
/// `bytes` is empty then. Allocates the bytes.
[[nodiscard]] inline Status save(const Recognizer& recognizer, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  if (recognizer.codeword_count() == 0) return Status::not_trained;
  if (validate(recognizer.options()) != Status::ok) return Status::bad_option;
  const std::size_t codeword_bytes = 16 + sizeof(float) * recognizer.row_size();
  bytes.reserve(4096 + recognizer.codeword_count() * codeword_bytes);
  detail::ModelWriter to(bytes);
  to.characters(detail::model_magic);
  to.number(detail::model_version);
  detail::write(to, recognizer.options(), detail::RecognizerAccess::codebook(recognizer));
  to.number(detail::checksum(bytes.data(), bytes.size()));
  return Status::ok;
}

/// The recognizer that save() made these bytes of, for descriptors of a layout (see Recognizer; layout_of()).
///
/// Statuses, the first one that applies: not_a_model, other_version, damaged_model (the bytes end early, or go on; the
/// checksum is wrong; or they are not what save() writes), other_descriptor. `out` has not changed then. Allocates a
/// few times the bytes at the most, whatever they say.
[[nodiscard]] inline Status load(const std::uint8_t* bytes, std::size_t size, std::string_view layout,
                                 Recognizer& out) {
  constexpr std::size_t magic_bytes = detail::model_magic.size();
  constexpr std::size_t header_bytes = magic_bytes + sizeof detail::model_version;
  if (bytes == nullptr || size < magic_bytes || std::memcmp(bytes, detail::model_magic.data(), magic_bytes) != 0) {
    return Status::not_a_model;
  }
  detail::ModelReader header(bytes + magic_bytes, size - magic_bytes);
  const auto version = header.number<std::uint32_t>();
  if (header.good() && version != detail::model_version) return Status::other_version;
  if (header.left() < detail::checksum_bytes) return Status::damaged_model;
  const std::size_t checked_bytes = size - detail::checksum_bytes;
  detail::ModelReader checksum(bytes + checked_bytes, detail::checksum_bytes);
  if (checksum.number<std::uint64_t>() != detail::checksum(bytes, checked_bytes)) return Status::damaged_model;

  Recognizer loaded;
  detail::Codebook& codebook = detail::RecognizerAccess::codebook(loaded);
  RecognizerOptions options;
  detail::ModelReader body(bytes + header_bytes, checked_bytes - header_bytes);
  if (!detail::read(body, options, codebook)) return Status::damaged_model;
  if (codebook.layout != layout) return Status::other_descriptor;
  loaded.set_options(options);
  out = std::move(loaded);
  return Status::ok;
}

/// The same in a file, which is written anew. Also no_file: it cannot be opened, or not all of it written or read. If
/// that happens to save(), the file may be damaged, and load() will say so.
[[nodiscard]] inline Status save(const Recognizer& recognizer, const std::string& path) {
  std::vector<std::uint8_t> bytes;
  const Status status = save(recognizer, bytes);
  if (status != Status::ok) return status;
  detail::File file(path, "wb");
  const bool is_written = file.write(bytes);
  return file.close() && is_written ? Status::ok : Status::no_file;
}

[[nodiscard]] inline Status load(const std::string& path, std::string_view layout, Recognizer& out) {
  std::vector<std::uint8_t> bytes;
  detail::File file(path, "rb");
  return file.read(bytes) ? load(bytes.data(), bytes.size(), layout, out) : Status::no_file;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
