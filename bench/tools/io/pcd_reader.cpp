#include "pcd_reader.hpp"

#include <lzf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "make_cloud.hpp"
#include "pcd_header.hpp"
#include "point_table.hpp"
#include "text_rows.hpp"

namespace shortshot_bench {
namespace {

constexpr ByteOrder pcd_order = ByteOrder::little_endian;

// Three values under one name, such as COUNT 3 for rgb, are a channel each; with a fourth one, alpha.
void add_field(const ByteSource& source, const PcdHeader& header, const PcdField& field, PointTable& table) {
  Channel channel;
  channel.name = field.name;
  channel.type = field.type;
  channel.is_text = header.data == PcdData::ascii;
  channel.count = field.count;
  const NamedRole named = role_of_name(field.name);
  if (field.count != 1 && named.role <= Role::z) {
    throw InputError::at_line(
        source.path(), header.fields_line,
        "expected COUNT 1 for field " + channel.name + ", found COUNT " + std::to_string(field.count));
  }
  std::array<Role, 3> roles = roles_of_triple(field.name);
  if (field.count == 4 && named.role == Role::packed_color) roles = roles_of_triple("rgb");
  const bool is_triple = field.count == 3 || (field.count == 4 && named.role == Role::packed_color);
  if (!is_triple || roles[0] == Role::none) {
    table.channels.push_back(channel);
    return;
  }
  channel.count = 1;
  for (const Role role : roles) {
    channel.named.role = role;
    table.channels.push_back(channel);
  }
}

// Where a channel's values are: of which field, and which of its values.
struct Part {
  const PcdField* field;
  std::size_t index;
};

// In the order of the channels, which add_field() made.
std::vector<Part> parts_of(const PcdHeader& header, const PointTable& table) {
  std::vector<Part> parts;
  for (const PcdField& field : header.fields) {
    const Channel& first = table.channels[parts.size()];
    const std::size_t count = field.count > 1 && first.count == 1 ? 3 : 1;
    for (std::size_t index = 0; index < count; ++index) parts.push_back({&field, index});
  }
  return parts;
}

// As a file of bytes would hold it: what its type has no room for is refused.
double ascii_value(const ByteSource& source, Word word, const PcdField& field, Role role) {
  if (field.type.kind == ScalarKind::floating) return expect_number(source, word, field.name);
  if (role == Role::packed_color && field.type.size_bytes == 4) {
    // Signed and unsigned alike: writers disagree on the sign when alpha sets the top bit.
    return static_cast<double>(
        expect_integer(source, word, field.name, -(std::int64_t{1} << 31), (std::int64_t{1} << 32) - 1));
  }
  const int bits = 8 * field.type.size_bytes;
  if (field.type.kind == ScalarKind::unsigned_integer) {
    return static_cast<double>(expect_count(source, word, field.name, 0, ~std::uint64_t{0} >> (64 - bits)));
  }
  const auto highest = static_cast<std::int64_t>(~std::uint64_t{0} >> (65 - bits));
  return static_cast<double>(expect_integer(source, word, field.name, -highest - 1, highest));
}

void read_ascii(ByteSource& source, const PcdHeader& header, PointTable& table) {
  expect_room_for_rows(source, header.points, header.values_per_point);
  const std::vector<Part> all_parts = parts_of(header, table);
  std::vector<Part> parts;  // of channels that are used
  std::vector<Channel*> used;
  for (std::size_t i = 0; i < all_parts.size(); ++i) {
    if (!table.uses(table.channels[i])) continue;
    used.push_back(&table.channels[i]);
    parts.push_back(all_parts[i]);
  }
  table.own_values.resize(used.size() * table.size());
  std::vector<std::string_view> words;
  double* out = table.own_values.data();
  for (std::size_t point = 0; point < table.size(); ++point) {
    if (!next_row(source, words)) {
      throw source.line_error("expected " + std::to_string(table.size()) + " points, found only " +
                              std::to_string(point) + " before the end of the file");
    }
    if (words.size() != header.values_per_point) {
      throw source.line_error("expected " + std::to_string(header.values_per_point) + " values for a point, found " +
                              std::to_string(words.size()));
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string_view word = words[static_cast<std::size_t>(parts[i].field->first_value) + parts[i].index];
      *out++ = ascii_value(source, {word, source.line_number()}, *parts[i].field, used[i]->named.role);
    }
  }
  set_text_columns(table, used);
}

// `bytes` holds points * point_size_bytes bytes: point after point, or in compressed files field after field, for equal
// values compress better side by side.
void set_columns(std::string_view bytes, const PcdHeader& header, PointTable& table) {
  const std::vector<Part> parts = parts_of(header, table);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const PcdField& field = *parts[i].field;
    const bool is_by_point = header.data == PcdData::binary;
    const std::uint64_t begin = is_by_point ? field.offset_bytes : field.offset_bytes * header.points;
    ValueColumn& column = table.channels[i].values;
    column.first = bytes.data() + static_cast<std::size_t>(begin) + parts[i].index * field.type.size_bytes;
    column.stride_bytes = static_cast<std::size_t>(is_by_point ? header.point_size_bytes : field.size_bytes());
    column.type = field.type;
    column.order = pcd_order;
  }
}

void read_binary(ByteSource& source, const PcdHeader& header, PointTable& table) {
  if (header.points > source.remaining_bytes() / header.point_size_bytes) {
    throw source.byte_error("expected " + std::to_string(header.points) + " points of " +
                            std::to_string(header.point_size_bytes) + " bytes, found only " +
                            std::to_string(source.remaining_bytes()) + " bytes");
  }
  set_columns(source.take(header.points * header.point_size_bytes, "points"), header, table);
}

// What the uncompressed size should have been, or empty if it is possible: asked before it is allocated.
std::string expected_plain_size(const PcdHeader& header, std::uint64_t compressed_bytes, std::uint64_t plain_bytes) {
  if (header.points > plain_bytes / header.point_size_bytes ||  // guards the product against an overflow
      header.points * header.point_size_bytes != plain_bytes) {
    return std::to_string(header.points) + " points of " + std::to_string(header.point_size_bytes) + " bytes";
  }
  // LZF's longest back reference gives 264 bytes for 3. The bound also keeps an empty input away from
  // lzf_decompress, which reads a first byte in any case.
  constexpr std::uint64_t largest_expansion = 88;
  if (plain_bytes <= largest_expansion * compressed_bytes) return {};
  return "at most " + std::to_string(largest_expansion) + " times the compressed " + std::to_string(compressed_bytes) +
         " bytes";
}

void read_compressed(ByteSource& source, const PcdHeader& header, PointTable& table) {
  const std::size_t sizes_begin = source.offset_bytes();
  const std::string_view sizes = source.take(8, "the compressed and the uncompressed size");
  const auto compressed_bytes = static_cast<unsigned int>(load_bits(sizes.data(), 4, pcd_order));
  const auto plain_bytes = static_cast<unsigned int>(load_bits(sizes.data() + 4, 4, pcd_order));
  const std::string expected = expected_plain_size(header, compressed_bytes, plain_bytes);
  if (!expected.empty()) {
    throw InputError::at_byte(
        source.path(), sizes_begin + 4,
        "expected an uncompressed size of " + expected + ", found " + std::to_string(plain_bytes) + " bytes");
  }
  const std::size_t data_begin = source.offset_bytes();
  const std::string_view compressed = source.take(compressed_bytes, "compressed points");
  std::vector<char>& plain = table.own_bytes;
  plain.resize(plain_bytes);
  if (plain_bytes != 0 &&
      lzf_decompress(compressed.data(), compressed_bytes, plain.data(), plain_bytes) != plain_bytes) {
    throw InputError::at_byte(
        source.path(), data_begin,
        "expected LZF data of " + std::to_string(plain_bytes) + " bytes, found broken or shorter data");
  }
  set_columns({plain.data(), plain.size()}, header, table);
}

}  // namespace

RgbdCloud read_pcd(ByteSource& source) {
  const PcdHeader header = read_pcd_header(source);
  PointTable table;
  table.width = static_cast<std::size_t>(header.width);
  table.height = static_cast<std::size_t>(header.height);
  table.viewpoint = header.viewpoint;
  for (const PcdField& field : header.fields) add_field(source, header, field, table);
  assign_roles(table, source.path(), header.fields_line, "field", "");
  switch (header.data) {
    case PcdData::ascii: read_ascii(source, header, table); break;
    case PcdData::binary: read_binary(source, header, table); break;
    case PcdData::binary_compressed: read_compressed(source, header, table); break;
  }
  note_rest_of_file(source, table);
  return make_cloud(table);
}

}  // namespace shortshot_bench
