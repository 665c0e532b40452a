#include "ply_values.hpp"

#include <string>

#include "scalar_type.hpp"
#include "text_rows.hpp"

namespace shortshot_bench {

void PlyTextValues::expect_room_for_rows(const PlyElement& element) const {
  shortshot_bench::expect_room_for_rows(source_, element.count, element.properties.size());
}

void PlyTextValues::begin_row(const PlyElement& element, std::uint64_t row) {
  next_ = 0;
  if (!next_row(source_, words_)) {
    throw source_.line_error("expected " + std::to_string(element.count) + " rows of element " + quoted(element.name) +
                             ", found only " + std::to_string(row) + " before the end of the file");
  }
}

Word PlyTextValues::next_word(std::string_view what) {
  if (next_ == words_.size()) {
    throw source_.line_error("expected a value for " + quoted(what) + ", found the end of the line");
  }
  return {words_[next_++], source_.line_number()};
}

double PlyTextValues::read(const PlyProperty& property) {
  return expect_number(source_, next_word(property.name), property.name);
}

std::uint64_t PlyTextValues::read_length(const PlyProperty& list) {
  const std::uint64_t length = expect_count(source_, next_word(list.name), list.name, 0, ~std::uint64_t{0});
  const std::size_t available = words_.size() - next_;
  if (length > available) {
    throw source_.line_error("expected " + std::to_string(length) + " values in list " + quoted(list.name) +
                             ", found only " + std::to_string(available));
  }
  return length;
}

void PlyTextValues::skip(const PlyProperty& property) {
  if (property.is_list) {
    next_ += static_cast<std::size_t>(read_length(property));
  } else {
    next_word(property.name);
  }
}

void PlyTextValues::end_row() {
  if (next_ != words_.size()) {
    throw source_.line_error("expected " + std::to_string(next_) + " values in this row, found " +
                             std::to_string(words_.size()));
  }
}

void PlyBinaryValues::expect_room_for_rows(const PlyElement& element) const {
  std::uint64_t least_row_bytes = 0;  // with all lists empty
  for (const PlyProperty& property : element.properties) {
    least_row_bytes += property.is_list ? property.count_type.size_bytes : property.type.size_bytes;
  }
  if (least_row_bytes != 0 && element.count > source_.remaining_bytes() / least_row_bytes) {
    throw source_.byte_error("expected " + std::to_string(element.count) + " rows of element " + quoted(element.name) +
                             " of at least " + std::to_string(least_row_bytes) + " bytes, found only " +
                             std::to_string(source_.remaining_bytes()) + " bytes");
  }
}

double PlyBinaryValues::read(const PlyProperty& property) {
  return load_scalar(read_bytes(property).data(), property.type, order_);
}

std::string_view PlyBinaryValues::read_bytes(const PlyProperty& property) {
  return source_.take(property.type.size_bytes, "a property value");
}

std::uint64_t PlyBinaryValues::read_length(const PlyProperty& list) {
  const std::size_t count_begin = source_.offset_bytes();
  const std::string_view bytes = source_.take(list.count_type.size_bytes, "a list count");
  const double length = load_scalar(bytes.data(), list.count_type, order_);
  if (length < 0) {
    throw InputError::at_byte(source_.path(), count_begin,
                              "expected a count of 0 or more for list " + quoted(list.name) + ", found " +
                                  std::to_string(static_cast<std::int64_t>(length)));
  }
  return static_cast<std::uint64_t>(length);  // a count has at most 4 bytes: exact
}

void PlyBinaryValues::skip(const PlyProperty& property) {
  if (property.is_list) {
    source_.take(read_length(property) * property.type.size_bytes, "list values");
  } else {
    read_bytes(property);
  }
}

}  // namespace shortshot_bench
