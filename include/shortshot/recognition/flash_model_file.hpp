// shortshot/recognition/flash_model_file.hpp: models for flash: written, as bytes or as a C++ header, and read back.
// Hosted only: allocates.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../config.hpp"
#include "../status.hpp"
#include "../store/byte_stream.hpp"
#include "../store/stored_features.hpp"
#include "codebook.hpp"
#include "flash_model.hpp"
#include "hypothesis.hpp"
#include "model_view.hpp"
#include "recognizer.hpp"
#include "telling_numbers.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr FileKind flash_model_file{{flash_model_magic, 8}, flash_model_version};

/// The smallest power of two of which 16 bits reach all centers; at least 2^-100.
[[nodiscard]] inline float unit_of_centers(const std::vector<Codebook::Codeword>& codewords) noexcept {
  float farthest = 0.0f;
  for (const Codebook::Codeword& codeword : codewords) {
    for (const float c : {codeword.center.x, codeword.center.y, codeword.center.z})
      farthest = std::max(farthest, std::abs(c));
  }
  float unit = std::ldexp(1.0f, -99);
  while (32767.0f * unit < farthest && unit < 1e29f) unit *= 2.0f;
  return unit;
}

[[nodiscard]] inline bool fits_flash(const Codebook& codebook) noexcept {
  const auto has_zero = [](const std::string& text) { return text.find(char{0}) != std::string::npos; };
  for (const std::vector<std::string>* const names : {&codebook.classes, &codebook.instances}) {
    if (names->size() > 65536) return false;
    for (const std::string& name : *names) {
      if (has_zero(name)) return false;
    }
  }
  return !has_zero(codebook.layout);
}

/// What stands behind the codewords.
[[nodiscard]] inline std::string flash_text(const Codebook& codebook) {
  std::string text = codebook.layout + char{0};
  for (const std::string& name : codebook.classes) text += name + char{0};
  for (const std::string& name : codebook.instances) text += name + char{0};
  return text;
}

/// How many codewords a model has that is no larger, with all names.
template <class Stored>
[[nodiscard]] std::size_t codewords_in_flash(const Codebook& codebook, std::size_t most_bytes) {
  constexpr auto row_bytes = static_cast<std::uint32_t>(sizeof(Stored));
  constexpr std::uint32_t numbers = 8 * row_bytes / Storage<Stored>::number_bits;
  const auto text_bytes = static_cast<std::uint32_t>(flash_text(codebook).size());
  const FlashLayout empty(row_bytes, numbers, 0, static_cast<std::uint32_t>(codebook.instances.size()), text_bytes);
  const std::uint64_t most = most_bytes / 4 * 4;
  if (most < empty.checksum + checksum_bytes) return 0;
  return static_cast<std::size_t>((most - checksum_bytes - empty.text - text_bytes) /
                                  (FlashLayout::before_row + row_bytes));
}

/// Is the order of a row's numbers one? (On a board, an order that is none does no harm.)
template <class Stored>
[[nodiscard]] bool is_permutation(const ModelView<Stored>& model) {
  std::vector<bool> known(model.number_count());
  for (std::uint32_t i = 0; i < model.number_count(); ++i) known[model.place_of(i)] = true;
  return std::find(known.begin(), known.end(), false) == known.end();
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A trained recognizer of descriptors in a storage of bytes (StoredFeatures of codes or bits), as ModelView reads it:
/// one byte sequence, the same on every machine (see flash_model.hpp). A codeword takes its descriptor and 8 bytes: its
/// center is kept in 16 bits a coordinate, in steps of at most a 32,000th of how far the farthest center lies from its
/// key point.
///
/// Statuses: not_trained, bad_option, other_descriptor (than storage_layout<Stored>()), bad_rows (2^32 bytes or
/// more, more than 65536 names of a kind, a name with a character 0, a center farther away than 1e33 m); `bytes` is
/// empty then. Allocates the bytes.
template <class Stored>
[[nodiscard]] Status save_for_flash(const Recognizer& recognizer, std::vector<std::uint8_t>& bytes) {
  const detail::Codebook& codebook = detail::RecognizerAccess::codebook(recognizer);
  bytes.clear();
  if (codebook.codewords.empty()) return Status::not_trained;
  if (validate(recognizer.options()) != Status::ok) return Status::bad_option;
  if (codebook.layout != storage_layout<Stored>()) return Status::other_descriptor;
  if (!detail::fits_flash(codebook)) return Status::bad_rows;
  const float unit = detail::unit_of_centers(codebook.codewords);
  if (unit > 1e29f) return Status::bad_rows;

  constexpr int bits = detail::Storage<Stored>::number_bits;
  const std::vector<std::uint32_t> order =
      detail::most_telling_first<bits>(codebook.packed.data(), codebook.codewords.size(), sizeof(Stored),
                                       [](unsigned a, unsigned b) { return (a - b) * (a - b); });
  const std::string text = detail::flash_text(codebook);
  const std::uint64_t most = 0xFFFFFFFFu;
  if (codebook.codewords.size() > most || text.size() > most) return Status::bad_rows;
  detail::FlashHeader header{0,
                             detail::storage_number<Stored>,
                             recognizer.options(),
                             sizeof(Stored),
                             bits,
                             static_cast<std::uint32_t>(codebook.codewords.size()),
                             static_cast<std::uint32_t>(codebook.instances.size()),
                             static_cast<std::uint32_t>(codebook.classes.size()),
                             static_cast<std::uint32_t>(text.size()),
                             unit};
  const detail::FlashLayout layout = header.layout();
  const std::uint64_t size_bytes = layout.checksum + detail::checksum_bytes;
  if (size_bytes > most) return Status::bad_rows;

  detail::ByteWriter to(bytes, detail::flash_model_file, static_cast<std::size_t>(size_bytes));
  header.size_bytes = static_cast<std::uint32_t>(size_bytes);
  detail::write(to, header);
  for (const std::uint32_t object_class : codebook.class_of) to.number(static_cast<std::uint16_t>(object_class));
  to.pad(static_cast<std::size_t>(layout.order));
  for (const std::uint32_t place : order) to.number(static_cast<std::uint16_t>(place));
  to.pad(static_cast<std::size_t>(layout.codewords));
  const std::uint8_t* row = codebook.packed.data();
  for (const detail::Codebook::Codeword& codeword : codebook.codewords) {
    detail::write_codeword(to, codeword.instance, codeword.center, unit);
    Stored arranged;
    detail::arrange<bits>(row, arranged.bytes, sizeof arranged.bytes, [&](std::size_t i) { return order[i]; });
    for (const std::uint8_t byte : arranged.bytes) to.number(byte);
    row += sizeof(Stored);
  }
  for (const char c : text) to.number(static_cast<std::uint8_t>(c));
  to.pad(static_cast<std::size_t>(layout.checksum));
  to.finish();
  return Status::ok;
}

/// The recognizer that gives the hypotheses that a MicroRecognizer gives with the model, also with what was learned on
/// the spot (LearnedObjects::model()), bit for bit: of its codewords, with centers as they were rounded.
///
/// Statuses: not_trained (no model is open), damaged_model (the order of a row's numbers is none); `out` has not
/// changed then. Allocates a few times the bytes at the most.
template <class Stored>
[[nodiscard]] Status load_from_flash(const ModelView<Stored>& model, Recognizer& out) {
  if (model.codeword_count() == 0) return Status::not_trained;
  if (!detail::is_permutation(model)) return Status::damaged_model;
  Recognizer loaded(model.options());
  detail::Codebook& codebook = detail::RecognizerAccess::codebook(loaded);
  codebook.layout = storage_layout<Stored>();
  codebook.row_size = sizeof(Stored);
  for (std::uint32_t i = 0; i < model.class_count(); ++i) codebook.classes.emplace_back(model.class_name(i));
  for (std::uint32_t i = 0; i < model.instance_count(); ++i) {
    codebook.instances.emplace_back(model.instance_name(i));
    codebook.class_of.push_back(model.class_of(i));
  }
  for (std::uint32_t i = 0; i < model.codeword_count(); ++i) {
    codebook.codewords.push_back({model.instance_of(i), model.center_of(i)});
    const Stored stored = model.descriptor(i);
    codebook.packed.insert(codebook.packed.end(), stored.bytes, stored.bytes + sizeof stored.bytes);
  }
  out = std::move(loaded);
  return Status::ok;
}

/// The same of the bytes that save_for_flash() has written. Also not_a_model, other_version, other_descriptor.
template <class Stored>
[[nodiscard]] Status load_from_flash(const std::uint8_t* bytes, std::size_t size_bytes, Recognizer& out) {
  ModelView<Stored> model;
  const Status status = model.open(bytes, size_bytes);
  return status == Status::ok ? load_from_flash(model, out) : status;
}

/// The bytes of a model as a C++ header: `alignas(4) constexpr unsigned char NAME[] = {...};`. `name` is a C++
/// identifier. Allocates some four times the bytes.
[[nodiscard]] inline std::string flash_model_header(const std::vector<std::uint8_t>& bytes, std::string_view name) {
  std::string text =
      "// A model for shortshot::ModelView, by save_for_flash().\n#pragma once\n\nalignas(4) inline constexpr unsigned "
      "char ";
  text += name;
  text += "[] = {";
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    text += i % 24 == 0 ? "\n    " : " ";
    text += std::to_string(bytes[i]);
    text += ',';
  }
  text += "\n};\n";
  return text;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
