// shortshot/recognition/recognizer_model.hpp: a trained recognizer as bytes, or in a file. Hosted only: allocates.
//
// Between what byte_stream.hpp puts around it ("SSHOTREC", the version and the checksum):
//
//     layout (length, characters), values of a row
//     options: 4 bytes each bandwidth, neighbors, most
//     count of classes, for each: name (length, characters)
//     count of instances, for each: 4 bytes class, name (length, characters)
//     count of codewords, for each: 4 bytes instance, 3 floats center in the key point's frame
//     values, row by row: floats; of version 2 bytes, which are codes or bits, as the layout says
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "../store/byte_stream.hpp"
#include "../store/replace_file.hpp"
#include "codebook.hpp"
#include "recognize.hpp"
#include "recognizer.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr FileKind recognizer_file{"SSHOTREC", 1};
inline constexpr FileKind packed_recognizer_file{"SSHOTREC", 2};

inline void write(ByteWriter& to, const RecognizerOptions& options, const Codebook& codebook) {
  to.name(codebook.layout);
  to.count(codebook.row_size);
  to.real(options.bandwidth);
  to.number(options.neighbors);
  to.number(options.most);
  to.count(codebook.classes.size());
  for (const std::string& name : codebook.classes) to.name(name);
  to.count(codebook.instances.size());
  for (std::size_t i = 0; i < codebook.instances.size(); ++i) {
    to.number(codebook.class_of[i]);
    to.name(codebook.instances[i]);
  }
  to.count(codebook.codewords.size());
  for (const Codebook::Codeword& codeword : codebook.codewords) {
    to.number(codeword.instance);
    to.point(codeword.center);
  }
  to.reals(codebook.values.data(), codebook.values.size());
  for (const std::uint8_t byte : codebook.packed) to.number(byte);
}

/// False if not all of it can be: then what has been read is of no use.
[[nodiscard]] inline bool read(ByteReader& from, bool is_packed, RecognizerOptions& options, Codebook& codebook) {
  const std::size_t value_bytes = is_packed ? 1 : sizeof(float);
  codebook.layout = from.name();
  codebook.row_size = from.count(value_bytes);
  options.bandwidth = from.real();
  options.neighbors = from.number<std::uint32_t>();
  options.most = from.number<std::uint32_t>();
  from.require(validate(options) == Status::ok);
  for (std::size_t i = from.count(8); i > 0 && from.good(); --i) codebook.classes.push_back(from.name());
  for (std::size_t i = from.count(12); i > 0 && from.good(); --i) {
    codebook.class_of.push_back(from.index(codebook.classes.size()));
    codebook.instances.push_back(from.name());
  }
  const std::size_t codewords = from.count(16);
  from.require(codewords > 0 && codewords < no_row);
  codebook.codewords.reserve(codewords);
  for (std::size_t i = codewords; i > 0 && from.good(); --i) {
    const std::uint32_t instance = from.index(codebook.instances.size());
    codebook.codewords.push_back({instance, from.point()});
  }
  const std::size_t row_bytes = value_bytes * codebook.row_size;
  from.require(row_bytes > 0 && from.left() % row_bytes == 0 && from.left() / row_bytes == codewords);
  if (!from.good()) return false;
  if (is_packed) {
    codebook.packed.resize(codewords * codebook.row_size);
    for (std::uint8_t& byte : codebook.packed) byte = from.number<std::uint8_t>();
  } else {
    codebook.values.resize(codewords * codebook.row_size);
    from.reals(codebook.values.data(), codebook.values.size());
  }
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
  const bool is_packed = !detail::RecognizerAccess::codebook(recognizer).packed.empty();
  const detail::FileKind& kind = is_packed ? detail::packed_recognizer_file : detail::recognizer_file;
  detail::ByteWriter to(bytes, kind, 4096 + recognizer.codeword_count() * codeword_bytes);
  detail::write(to, recognizer.options(), detail::RecognizerAccess::codebook(recognizer));
  to.finish();
  return Status::ok;
}

/// The recognizer that save() made these bytes of, for descriptors of a layout (see Recognizer; layout_of()).
///
/// Statuses, the first one that applies: not_a_model, other_version, damaged_model (the bytes end early, or go on; the
/// checksum is wrong; or they are not what save() writes), other_descriptor. `out` has not changed then. Allocates a
/// few times the bytes at the most, whatever they say.
[[nodiscard]] inline Status load(const std::uint8_t* bytes, std::size_t size, std::string_view layout,
                                 Recognizer& out) {
  detail::ByteReader body(nullptr, 0);
  Status status = detail::open_checked(bytes, size, detail::recognizer_file, body);
  const bool is_packed = status == Status::other_version;
  if (is_packed) status = detail::open_checked(bytes, size, detail::packed_recognizer_file, body);
  if (status != Status::ok) return status;
  Recognizer loaded;
  detail::Codebook& codebook = detail::RecognizerAccess::codebook(loaded);
  RecognizerOptions options;
  if (!detail::read(body, is_packed, options, codebook)) return Status::damaged_model;
  if (codebook.layout != layout) return Status::other_descriptor;
  loaded.set_options(options);
  out = std::move(loaded);
  return Status::ok;
}

/// The same in a file. Also no_file: it cannot be opened, or not all of it written or read. If that happens to save()
/// (the disk is full), what was in the file still is: the new one is written beside it, as `path` + ".tmp-00" (or 01,
/// ...), and takes its name when it is complete. So there must be room for both, and its folder must be writable.
[[nodiscard]] inline Status save(const Recognizer& recognizer, const std::string& path) {
  std::vector<std::uint8_t> bytes;
  const Status status = save(recognizer, bytes);
  return status == Status::ok ? detail::replace_file(path, bytes) : status;
}

[[nodiscard]] inline Status load(const std::string& path, std::string_view layout, Recognizer& out) {
  std::vector<std::uint8_t> bytes;
  const Status status = detail::read_file(path, bytes);
  return status == Status::ok ? load(bytes.data(), bytes.size(), layout, out) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
