#include "pcd_header.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "lower_case.hpp"
#include "text_rows.hpp"

namespace shortshot_bench {
namespace {

// For WIDTH, HEIGHT and the values of a point: products of two and sums over all fields cannot overflow.
constexpr std::uint64_t largest_count = 0xffffffffU;

enum Keyword : std::size_t { version, fields, size, type, count, width, height, viewpoint, points, data };
constexpr std::array<std::string_view, 10> keyword_names{"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                                         "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

// The position in keyword_names, or its size.
std::size_t keyword_of(std::string_view word) {
  const std::string lower = lower_case(word);
  if (lower == "columns") return fields;  // the name in files before v0.6
  const auto found = std::find_if(keyword_names.begin(), keyword_names.end(),
                                  [&](std::string_view name) { return lower_case(name) == lower; });
  return static_cast<std::size_t>(found - keyword_names.begin());
}

struct Entry {
  std::vector<std::string_view> words;  // without the keyword
  std::uint64_t line = 0;               // 0 = the header has no such line

  bool is_given() const { return line != 0; }
  Word word(std::size_t index) const { return {words[index], line}; }
};

using Entries = std::array<Entry, keyword_names.size()>;

Entries read_entries(ByteSource& source) {
  Entries entries;
  std::vector<std::string_view> words;
  while (!entries[data].is_given()) {
    if (!next_row(source, words)) throw source.line_error("expected a DATA line, found the end of the file");
    if (words.front().front() == '#') continue;
    const std::size_t keyword = keyword_of(words.front());
    if (keyword == keyword_names.size()) {
      throw source.line_error("expected a PCD header entry or the DATA line, found " + quoted(words.front()));
    }
    Entry& entry = entries[keyword];
    if (entry.is_given()) {
      throw source.line_error("expected one " + std::string(keyword_names[keyword]) +
                              " line, found a second one after line " + std::to_string(entry.line));
    }
    words.erase(words.begin());
    entry.words.swap(words);
    entry.line = source.line_number();
  }
  return entries;
}

void expect_words(const ByteSource& source, const Entries& entries, Keyword keyword, std::size_t expected) {
  const Entry& entry = entries[keyword];
  const std::string name(keyword_names[keyword]);
  if (!entry.is_given()) {
    throw source.line_error("expected a " + name + " line before the DATA line, found none");
  }
  if (entry.words.size() != expected) {
    throw InputError::at_line(source.path(), entry.line,
                              "expected " + std::to_string(expected) + " values after " + name + ", found " +
                                  std::to_string(entry.words.size()));
  }
}

std::uint64_t single_count(const ByteSource& source, const Entries& entries, Keyword keyword, std::uint64_t highest) {
  expect_words(source, entries, keyword, 1);
  return expect_count(source, entries[keyword].word(0), keyword_names[keyword], 0, highest);
}

ScalarType scalar_type(const ByteSource& source, Word type_word, Word size_word) {
  constexpr std::string_view letters = "iuf";
  constexpr std::array kinds{ScalarKind::signed_integer, ScalarKind::unsigned_integer, ScalarKind::floating};
  const std::size_t letter = letters.find(lower_case(type_word.text));
  if (type_word.text.size() != 1 || letter == std::string_view::npos) {
    throw InputError::at_line(source.path(), type_word.line,
                              "expected I, U or F as a TYPE, found " + quoted(type_word.text));
  }
  const std::uint64_t size_bytes = expect_count(source, size_word, "SIZE", 1, 8);
  const bool is_power_of_two = (size_bytes & (size_bytes - 1)) == 0;
  if (!is_power_of_two || (kinds[letter] == ScalarKind::floating && size_bytes < 4)) {
    throw InputError::at_line(source.path(), size_word.line,
                              "expected SIZE 1, 2, 4 or 8 (4 or 8 for TYPE F), found " + quoted(size_word.text) +
                                  " for TYPE " + std::string(type_word.text));
  }
  return {kinds[letter], static_cast<std::uint8_t>(size_bytes)};
}

void set_fields(const ByteSource& source, const Entries& entries, PcdHeader& header) {
  const std::size_t field_count = std::max<std::size_t>(entries[fields].words.size(), 1);
  expect_words(source, entries, fields, field_count);
  expect_words(source, entries, size, field_count);
  expect_words(source, entries, type, field_count);
  if (entries[count].is_given()) expect_words(source, entries, count, field_count);
  header.fields_line = entries[fields].line;
  header.fields.reserve(field_count);
  for (std::size_t i = 0; i < field_count; ++i) {
    PcdField field;
    field.name = entries[fields].words[i];
    field.type = scalar_type(source, entries[type].word(i), entries[size].word(i));
    if (entries[count].is_given()) {
      field.count = expect_count(source, entries[count].word(i), "COUNT", 1, largest_count);
    }
    field.first_value = header.values_per_point;
    field.offset_bytes = header.point_size_bytes;
    header.values_per_point += field.count;
    if (header.values_per_point > largest_count) {
      throw InputError::at_line(
          source.path(), entries[count].line,
          "expected at most " + std::to_string(largest_count) + " values per point, found a larger sum of COUNT");
    }
    header.point_size_bytes += field.size_bytes();
    header.fields.push_back(field);
  }
}

// Old files give only POINTS, some others only WIDTH and HEIGHT.
void set_dimensions(const ByteSource& source, const Entries& entries, PcdHeader& header) {
  if (!entries[width].is_given() && !entries[height].is_given()) {
    header.points = header.width = single_count(source, entries, points, largest_count);
    return;
  }
  header.width = single_count(source, entries, width, largest_count);
  if (entries[height].is_given()) header.height = single_count(source, entries, height, largest_count);
  header.points = header.width * header.height;
  if (!entries[points].is_given()) return;
  const std::uint64_t given = single_count(source, entries, points, ~std::uint64_t{0});
  if (given != header.points) {
    throw InputError::at_line(
        source.path(), entries[points].line,
        "expected WIDTH * HEIGHT = " + std::to_string(header.points) + " POINTS, found " + std::to_string(given));
  }
}

void set_viewpoint(const ByteSource& source, const Entries& entries, PcdHeader& header) {
  if (!entries[viewpoint].is_given()) return;
  expect_words(source, entries, viewpoint, 7);  // a translation and a quaternion
  for (std::size_t i = 0; i < header.viewpoint.size(); ++i) {
    header.viewpoint[i] = expect_number(source, entries[viewpoint].word(i), "VIEWPOINT");
    if (!std::isfinite(header.viewpoint[i])) {
      throw InputError::at_line(source.path(), entries[viewpoint].line,
                                "expected a finite VIEWPOINT, found " + quoted(entries[viewpoint].words[i]));
    }
  }
}

void set_data(const ByteSource& source, const Entries& entries, PcdHeader& header) {
  constexpr std::array<std::string_view, 3> names{"ascii", "binary", "binary_compressed"};
  expect_words(source, entries, data, 1);
  const auto found = std::find(names.begin(), names.end(), lower_case(entries[data].words.front()));
  if (found == names.end()) {
    throw source.line_error("expected DATA ascii, binary or binary_compressed, found " +
                            quoted(entries[data].words.front()));
  }
  header.data = static_cast<PcdData>(found - names.begin());
}

}  // namespace

bool is_pcd_keyword(std::string_view word) { return keyword_of(word) != keyword_names.size(); }

// VERSION is not looked at: the other lines say all about the layout, and files without it are common.
PcdHeader read_pcd_header(ByteSource& source) {
  const Entries entries = read_entries(source);
  PcdHeader header;
  set_fields(source, entries, header);
  set_dimensions(source, entries, header);
  set_viewpoint(source, entries, header);
  set_data(source, entries, header);
  return header;
}

}  // namespace shortshot_bench
