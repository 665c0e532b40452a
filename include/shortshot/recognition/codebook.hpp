// shortshot/recognition/codebook.hpp: what a recognizer has learnt. Hosted only: allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "../base/math.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/keypoint.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../frame/local_point.hpp"
#include "../status.hpp"
#include "descriptor_rows.hpp"
#include "match.hpp"
#include "packed_rows.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_TYPES {

/// Every descriptor of a training view is a codeword.
struct Codebook {
  struct Codeword {
    std::uint32_t instance;
    Point center;  // of the training view, in the key point's frame
  };

  std::string layout;
  std::size_t row_size = 0;
  std::vector<std::string> classes;
  std::vector<std::string> instances;
  std::vector<std::uint32_t> class_of;  // of each instance
  std::vector<Codeword> codewords;
  std::vector<float> values;         // codewords.size() * row_size, or
  std::vector<std::uint8_t> packed;  // as many bytes, if descriptors are stored as codes or bits
};

/// Rows in any format, with places and frames: one of each a row.
template <class Rows>
struct PlacedRows {
  Rows descriptors;
  const KeyPoint* keypoints;
  const Frame* frames;
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

[[nodiscard]] inline bool is_finite(const float* values, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    if (!math::is_finite(values[i])) return false;
  }
  return true;
}

/// Rows that there are, and descriptors that can be compared: all of their values are finite. ok or bad_rows.
[[nodiscard]] inline Status check_values(const DescriptorRows& rows) noexcept {
  Status status = validate(rows);
  for (std::size_t row = 0; row < rows.count && status == Status::ok; ++row) {
    if (is_ok(rows, row) && !is_finite(rows.values + row * rows.size, rows.size)) status = Status::bad_rows;
  }
  return status;
}

template <int Bits>
[[nodiscard]] Status check_values(const CodedRows<Bits>& rows) noexcept {
  return validate(rows);
}
[[nodiscard]] inline Status check_values(const BitRows& rows) noexcept { return validate(rows); }

/// The same, with places and frames that one can cast a vote from: also invalid_keypoint and bad_frame.
template <class Rows>
[[nodiscard]] Status check_values(const PlacedRows<Rows>& rows) noexcept {
  const bool is_complete = rows.descriptors.count == 0 || (rows.keypoints != nullptr && rows.frames != nullptr);
  Status status = is_complete ? check_values(rows.descriptors) : Status::bad_rows;
  for (std::size_t row = 0; row < rows.descriptors.count && status == Status::ok; ++row) {
    if (!is_ok(rows.descriptors, row)) continue;
    status = is_finite(rows.keypoints[row].position) ? validate(rows.frames[row]) : Status::invalid_keypoint;
  }
  return status;
}

/// The codewords as rows that can be compared with these, which are of the same layout.
[[nodiscard]] inline DescriptorRows rows_like(const DescriptorRows&, const Codebook& codebook) noexcept {
  return {codebook.values.data(), codebook.codewords.size(), codebook.row_size, nullptr};
}
template <int Bits>
[[nodiscard]] CodedRows<Bits> rows_like(const CodedRows<Bits>& rows, const Codebook& codebook) noexcept {
  return {codebook.packed.data(), codebook.codewords.size(), codebook.row_size, rows.step, nullptr};
}
[[nodiscard]] inline BitRows rows_like(const BitRows&, const Codebook& codebook) noexcept {
  return {codebook.packed.data(), codebook.codewords.size(), codebook.row_size, nullptr};
}

/// Appends a row to what the codebook has.
inline void append(Codebook& codebook, const DescriptorRows& rows, std::size_t row) {
  const float* const values = rows.values + row * rows.size;
  codebook.values.insert(codebook.values.end(), values, values + rows.size);
}
template <class Rows>
void append(Codebook& codebook, const Rows& rows, std::size_t row) {
  const std::uint8_t* const bytes = rows.bytes + row * rows.size;
  codebook.packed.insert(codebook.packed.end(), bytes, bytes + rows.size);
}

/// Are these the descriptors that it was made of?
[[nodiscard]] inline Status validate_queries(const Codebook& codebook, std::size_t row_size, bool are_packed,
                                             std::string_view layout) noexcept {
  if (codebook.codewords.empty()) return Status::not_trained;
  const bool alike = row_size == codebook.row_size && are_packed == !codebook.packed.empty();
  return alike && layout == codebook.layout ? Status::ok : Status::other_descriptor;
}

/// The number of a class, or of an instance; a new one if there is none of that name.
[[nodiscard]] inline std::uint32_t class_number(Codebook& codebook, std::string_view name) {
  const std::size_t count = codebook.classes.size();
  std::size_t number = 0;
  while (number < count && codebook.classes[number] != name) ++number;
  if (number == count) codebook.classes.push_back(std::string(name));
  return static_cast<std::uint32_t>(number);
}
[[nodiscard]] inline std::uint32_t instance_number(Codebook& codebook, std::uint32_t object_class,
                                                   std::string_view name) {
  const std::size_t count = codebook.instances.size();
  const auto is_it = [&](std::size_t i) {
    return codebook.class_of[i] == object_class && codebook.instances[i] == name;
  };
  std::size_t number = 0;
  while (number < count && !is_it(number)) ++number;
  if (number == count) {
    codebook.instances.push_back(std::string(name));
    codebook.class_of.push_back(object_class);
  }
  return static_cast<std::uint32_t>(number);
}

/// Adds the rows, which were validated, of an object of which `center` is the center. All or nothing.
template <class Rows>
[[nodiscard]] Status add(Codebook& codebook, const PlacedRows<Rows>& rows, const Point& center,
                         std::string_view object_class, std::string_view instance) {
  const Rows& descriptors = rows.descriptors;
  std::vector<Point> centers(descriptors.count);
  std::size_t added = 0;
  for (std::size_t row = 0; row < descriptors.count; ++row) {
    if (!is_ok(descriptors, row)) continue;
    centers[row] = to_local(center, rows.keypoints[row].position, rows.frames[row]);
    if (!shortshot::is_finite(centers[row])) return Status::invalid_keypoint;  // farther away than floats reach
    ++added;
  }
  if (added == 0) return Status::ok;
  if (added >= no_row - codebook.codewords.size()) return Status::bad_rows;

  const std::string name(instance);  // a copy: the view may be of a name in the codebook, which a new class moves
  const std::uint32_t number = instance_number(codebook, class_number(codebook, object_class), name);
  for (std::size_t row = 0; row < descriptors.count; ++row) {
    if (!is_ok(descriptors, row)) continue;
    append(codebook, descriptors, row);
    codebook.codewords.push_back({number, centers[row]});
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
