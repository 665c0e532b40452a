#include "pcd_reader.hpp"

#include <lzf.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "pcd_header.hpp"
#include "text_rows.hpp"

namespace shortshot_bench {
namespace {

constexpr ByteOrder pcd_order = ByteOrder::little_endian;

// The fields the tools use, out of those the file has.
struct PointFields {
  std::array<PcdField, 3> xyz;
  PcdField color;
  PcdField intensity;
  bool has_color = false;
  bool has_intensity = false;
};

const PcdField* find_field(const PcdHeader& header, std::string_view name) {
  for (const PcdField& field : header.fields) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

InputError field_error(const ByteSource& source, const PcdHeader& header, const std::string& what) {
  return InputError::at_line(source.path(), header.fields_line, what);
}

void find_color(const ByteSource& source, const PcdHeader& header, PointFields& found) {
  const PcdField* color = find_field(header, "rgb");
  if (color == nullptr) color = find_field(header, "rgba");
  if (color == nullptr) return;
  if (color->type.size_bytes != 4 || color->count != 1) {
    throw field_error(source, header,
                      "expected SIZE 4 and COUNT 1 for field " + std::string(color->name) + ", found SIZE " +
                          std::to_string(color->type.size_bytes) + " and COUNT " + std::to_string(color->count));
  }
  found.color = *color;
  found.has_color = true;
}

// Of any type: laser scanners write floats as well as whole numbers of 8 or 16 bits.
void find_intensity(const ByteSource& source, const PcdHeader& header, PointFields& found) {
  const PcdField* const intensity = find_field(header, "intensity");
  if (intensity == nullptr) return;
  if (intensity->count != 1) {
    throw field_error(source, header,
                      "expected COUNT 1 for field intensity, found COUNT " + std::to_string(intensity->count));
  }
  found.intensity = *intensity;
  found.has_intensity = true;
}

PointFields find_point_fields(const ByteSource& source, const PcdHeader& header) {
  PointFields found;
  constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const PcdField* const field = find_field(header, axes[axis]);
    const std::string name(axes[axis]);
    if (field == nullptr) throw field_error(source, header, "expected a field " + name + ", found none");
    if (field->type.kind != ScalarKind::floating || field->count != 1) {
      throw field_error(source, header, "expected TYPE F and COUNT 1 for field " + name + ", found another");
    }
    found.xyz[axis] = *field;
  }
  find_color(source, header, found);
  find_intensity(source, header, found);
  return found;
}

// To be called after the points are known to be in the file.
RgbdCloud allocate_cloud(const PcdHeader& header, const PointFields& fields) {
  RgbdCloud cloud;
  cloud.width = static_cast<std::size_t>(header.width);
  cloud.height = static_cast<std::size_t>(header.height);
  cloud.viewpoint = header.viewpoint;
  cloud.xyz.resize(3 * static_cast<std::size_t>(header.points));
  if (fields.has_color) cloud.rgb.resize(cloud.xyz.size());
  if (fields.has_intensity) cloud.intensity.resize(cloud.size());
  return cloud;
}

// `packed` is 0xAARRGGBB.
void store_color(std::uint32_t packed, std::uint8_t* rgb) {
  rgb[0] = static_cast<std::uint8_t>(packed >> 16);
  rgb[1] = static_cast<std::uint8_t>(packed >> 8);
  rgb[2] = static_cast<std::uint8_t>(packed);
}

std::uint32_t ascii_color(const ByteSource& source, Word word, const PcdField& field) {
  if (field.type.kind != ScalarKind::floating) {
    // Signed and unsigned alike: writers disagree on the sign when alpha sets the top bit.
    return static_cast<std::uint32_t>(
        expect_integer(source, word, field.name, -(std::int64_t{1} << 31), (std::int64_t{1} << 32) - 1));
  }
  const float value = expect_float(source, word, field.name);
  if (std::isnan(value)) return 0;  // the text does not say which of the NaNs, so the color is lost
  std::uint32_t bits = 0;
  static_assert(sizeof bits == sizeof value, "a packed color is a 4-byte float");
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

// As a file of bytes would hold it: what its type has no room for is refused.
float ascii_scalar(const ByteSource& source, Word word, const PcdField& field) {
  const int bits = 8 * field.type.size_bytes;
  switch (field.type.kind) {
    case ScalarKind::unsigned_integer:
      return static_cast<float>(expect_count(source, word, field.name, 0, ~std::uint64_t{0} >> (64 - bits)));
    case ScalarKind::signed_integer: {
      const auto highest = static_cast<std::int64_t>(~std::uint64_t{0} >> (65 - bits));
      return static_cast<float>(expect_integer(source, word, field.name, -highest - 1, highest));
    }
    case ScalarKind::floating: break;
  }
  return expect_float(source, word, field.name);
}

RgbdCloud read_ascii(ByteSource& source, const PcdHeader& header, const PointFields& fields) {
  expect_room_for_rows(source, header.points, header.values_per_point);
  RgbdCloud cloud = allocate_cloud(header, fields);
  std::vector<std::string_view> words;
  for (std::size_t point = 0; point < cloud.size(); ++point) {
    if (!next_row(source, words)) {
      throw source.line_error("expected " + std::to_string(cloud.size()) + " points, found only " +
                              std::to_string(point) + " before the end of the file");
    }
    if (words.size() != header.values_per_point) {
      throw source.line_error("expected " + std::to_string(header.values_per_point) + " values for a point, found " +
                              std::to_string(words.size()));
    }
    const auto word_of = [&](const PcdField& field) {
      return Word{words[static_cast<std::size_t>(field.first_value)], source.line_number()};
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cloud.xyz[3 * point + axis] = expect_float(source, word_of(fields.xyz[axis]), fields.xyz[axis].name);
    }
    if (fields.has_color) {
      store_color(ascii_color(source, word_of(fields.color), fields.color), &cloud.rgb[3 * point]);
    }
    if (fields.has_intensity) {
      cloud.intensity[point] = ascii_scalar(source, word_of(fields.intensity), fields.intensity);
    }
  }
  return cloud;
}

// Where the value of a field of the first point is, and how far it is to that of the next point.
struct FieldPlace {
  std::size_t begin_bytes = 0;
  std::size_t stride_bytes = 0;
};

FieldPlace field_place(const PcdHeader& header, const PcdField& field) {
  if (header.data == PcdData::binary) {  // point after point
    return {static_cast<std::size_t>(field.offset_bytes), static_cast<std::size_t>(header.point_size_bytes)};
  }
  // Compressed data: field after field, for equal values compress better side by side.
  return {static_cast<std::size_t>(field.offset_bytes * header.points), static_cast<std::size_t>(field.size_bytes())};
}

// The numbers of a field, one per point, to `first` of `out` and every `step`-th behind it. `bytes` holds points *
// point_size_bytes bytes.
void decode_field(std::string_view bytes, const PcdHeader& header, const PcdField& field, std::size_t first,
                  std::size_t step, std::vector<float>& out) {
  const FieldPlace place = field_place(header, field);
  for (std::size_t point = 0; point < header.points; ++point) {
    const char* const value = bytes.data() + place.begin_bytes + point * place.stride_bytes;
    out[first + step * point] = to_float(load_scalar(value, field.type, pcd_order));
  }
}

// `bytes` holds points * point_size_bytes bytes.
RgbdCloud decode_binary(std::string_view bytes, const PcdHeader& header, const PointFields& fields) {
  RgbdCloud cloud = allocate_cloud(header, fields);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    decode_field(bytes, header, fields.xyz[axis], axis, 3, cloud.xyz);
  }
  if (fields.has_intensity) decode_field(bytes, header, fields.intensity, 0, 1, cloud.intensity);
  if (!fields.has_color) return cloud;
  const FieldPlace place = field_place(header, fields.color);
  for (std::size_t point = 0; point < cloud.size(); ++point) {
    // The bits and never a float value: many packed colors are NaNs, which a conversion may change.
    const char* const value = bytes.data() + place.begin_bytes + point * place.stride_bytes;
    store_color(static_cast<std::uint32_t>(load_bits(value, 4, pcd_order)), &cloud.rgb[3 * point]);
  }
  return cloud;
}

RgbdCloud read_binary(ByteSource& source, const PcdHeader& header, const PointFields& fields) {
  if (header.points > source.remaining_bytes() / header.point_size_bytes) {
    throw source.byte_error("expected " + std::to_string(header.points) + " points of " +
                            std::to_string(header.point_size_bytes) + " bytes, found only " +
                            std::to_string(source.remaining_bytes()) + " bytes");
  }
  return decode_binary(source.take(header.points * header.point_size_bytes, "points"), header, fields);
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

RgbdCloud read_compressed(ByteSource& source, const PcdHeader& header, const PointFields& fields) {
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
  std::vector<char> plain(plain_bytes);
  if (plain_bytes != 0 &&
      lzf_decompress(compressed.data(), compressed_bytes, plain.data(), plain_bytes) != plain_bytes) {
    throw InputError::at_byte(
        source.path(), data_begin,
        "expected LZF data of " + std::to_string(plain_bytes) + " bytes, found broken or shorter data");
  }
  return decode_binary({plain.data(), plain.size()}, header, fields);
}

}  // namespace

RgbdCloud read_pcd(ByteSource& source) {
  const PcdHeader header = read_pcd_header(source);
  const PointFields fields = find_point_fields(source, header);
  switch (header.data) {
    case PcdData::ascii: return read_ascii(source, header, fields);
    case PcdData::binary: return read_binary(source, header, fields);
    case PcdData::binary_compressed: break;
  }
  return read_compressed(source, header, fields);
}

}  // namespace shortshot_bench
