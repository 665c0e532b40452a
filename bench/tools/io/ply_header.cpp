#include "ply_header.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <system_error>

#include "lower_case.hpp"
#include "text_rows.hpp"

namespace shortshot_bench {
namespace {

struct TypeName {
  std::string_view name;
  ScalarType type;
};

constexpr std::array<TypeName, 18> type_names{{
    {"char", {ScalarKind::signed_integer, 1}},
    {"int8", {ScalarKind::signed_integer, 1}},
    {"uchar", {ScalarKind::unsigned_integer, 1}},
    {"uint8", {ScalarKind::unsigned_integer, 1}},
    {"short", {ScalarKind::signed_integer, 2}},
    {"int16", {ScalarKind::signed_integer, 2}},
    {"ushort", {ScalarKind::unsigned_integer, 2}},
    {"uint16", {ScalarKind::unsigned_integer, 2}},
    {"int", {ScalarKind::signed_integer, 4}},
    {"int32", {ScalarKind::signed_integer, 4}},
    {"uint", {ScalarKind::unsigned_integer, 4}},
    {"uint32", {ScalarKind::unsigned_integer, 4}},
    {"int64", {ScalarKind::signed_integer, 8}},
    {"uint64", {ScalarKind::unsigned_integer, 8}},
    {"float", {ScalarKind::floating, 4}},
    {"float32", {ScalarKind::floating, 4}},
    {"double", {ScalarKind::floating, 8}},
    {"float64", {ScalarKind::floating, 8}},
}};

ScalarType parse_type(const ByteSource& source, std::string_view word) {
  const std::string lower = lower_case(word);
  const auto found = std::find_if(type_names.begin(), type_names.end(),
                                  [&](const TypeName& candidate) { return candidate.name == lower; });
  if (found == type_names.end()) {
    throw source.line_error("expected a PLY type such as uchar or float, found " + quoted(word));
  }
  return found->type;
}

void expect_words(const ByteSource& source, const std::vector<std::string_view>& words, std::size_t expected,
                  const std::string& form) {
  if (words.size() != expected) {
    throw source.line_error("expected '" + form + "', found " + std::to_string(words.size()) + " words");
  }
}

PlyFormat parse_format(const ByteSource& source, const std::vector<std::string_view>& words) {
  constexpr std::array<std::string_view, 3> names{"ascii", "binary_little_endian", "binary_big_endian"};
  expect_words(source, words, 3, "format FORMAT VERSION");
  const auto found = std::find(names.begin(), names.end(), lower_case(words[1]));
  if (found == names.end()) {
    throw source.line_error("expected the format ascii, binary_little_endian or binary_big_endian, found " +
                            quoted(words[1]));
  }
  return static_cast<PlyFormat>(found - names.begin());
}

PlyElement parse_element(const ByteSource& source, const std::vector<std::string_view>& words) {
  expect_words(source, words, 3, "element NAME COUNT");
  PlyElement element;
  element.name = words[1];
  element.line = source.line_number();
  element.count = expect_count(source, {words[2], element.line}, "the element count", 0, ~std::uint64_t{0});
  return element;
}

PlyProperty parse_property(const ByteSource& source, const std::vector<std::string_view>& words) {
  PlyProperty property;
  property.is_list = words.size() > 1 && lower_case(words[1]) == "list";
  if (property.is_list) {
    expect_words(source, words, 5, "property list COUNT_TYPE TYPE NAME");
    property.count_type = parse_type(source, words[2]);
    if (property.count_type.kind == ScalarKind::floating) {
      throw source.line_error("expected a whole number type for a list count, found " + quoted(words[2]));
    }
    if (property.count_type.size_bytes > 4) {
      throw source.line_error("expected a type of at most 4 bytes for a list count, found " + quoted(words[2]));
    }
  } else {
    expect_words(source, words, 3, "property TYPE NAME");
  }
  property.type = parse_type(source, words[words.size() - 2]);
  property.name = words.back();
  return property;
}

// "obj_info num_cols 512" and "obj_info num_rows 400"; whatever else obj_info says is free text.
void parse_grid_size(const std::vector<std::string_view>& words, PlyHeader& header) {
  if (words.size() != 3) return;
  const std::string name = lower_case(words[1]);
  std::uint64_t* const size = name == "num_cols" ? &header.columns : name == "num_rows" ? &header.rows : nullptr;
  if (size == nullptr) return;
  const char* const end = words[2].data() + words[2].size();
  std::uint32_t value = 0;
  const std::from_chars_result result = std::from_chars(words[2].data(), end, value);
  *size = result.ec == std::errc() && result.ptr == end ? value : 0;
}

void parse_entry(const ByteSource& source, const std::vector<std::string_view>& words, PlyHeader& header,
                 bool& has_format) {
  const std::string keyword = lower_case(words.front());
  if (keyword == "comment") return;
  if (keyword == "obj_info") return parse_grid_size(words, header);
  if (keyword == "format") {
    header.format = parse_format(source, words);
    has_format = true;
  } else if (keyword == "element") {
    header.elements.push_back(parse_element(source, words));
  } else if (keyword == "property") {
    if (header.elements.empty()) throw source.line_error("expected an element before its first property");
    header.elements.back().properties.push_back(parse_property(source, words));
  } else {
    throw source.line_error("expected a PLY header entry or end_header, found " + quoted(words.front()));
  }
}

}  // namespace

PlyHeader read_ply_header(ByteSource& source) {
  PlyHeader header;
  bool has_format = false;
  std::vector<std::string_view> words;
  next_row(source, words);  // "ply", by which the file was recognized
  for (;;) {
    if (!next_row(source, words)) throw source.line_error("expected end_header, found the end of the file");
    if (lower_case(words.front()) == "end_header") break;
    parse_entry(source, words, header, has_format);
  }
  if (!has_format) throw source.line_error("expected a format line before end_header, found none");
  return header;
}

}  // namespace shortshot_bench
