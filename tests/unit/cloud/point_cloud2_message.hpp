// A PointCloud2-shaped message, made as drivers make them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace unit {

struct CloudMessage {
  struct Field {
    std::string name;
    std::uint32_t offset;
    std::uint8_t datatype;
    std::uint32_t count;
  };
  std::uint32_t height = 1;
  std::uint32_t width = 0;
  std::vector<Field> fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;
  std::vector<std::uint8_t> data;
};

enum : std::uint8_t { int8 = 1, uint8, int16, uint16, int32, uint32, float32, float64 };

// Not inline: messages that are constants are made of it, after it.
const std::vector<CloudMessage::Field> floats_xyz{{"x", 0, float32, 1}, {"y", 4, float32, 1}, {"z", 8, float32, 1}};

inline std::vector<CloudMessage::Field> floats_xyz_and(const std::vector<CloudMessage::Field>& more) {
  std::vector<CloudMessage::Field> fields = floats_xyz;
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

/// Puts a number where a message has it, in its byte order.
template <class Number>
void put(CloudMessage& m, std::size_t at, Number number) {
  std::uint8_t bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  if (m.is_bigendian) std::reverse(bytes, bytes + sizeof number);  // (on a little-endian machine, as all that test)
  std::copy(bytes, bytes + sizeof number, m.data.begin() + static_cast<std::ptrdiff_t>(at));
}

inline void put_as(CloudMessage& m, std::size_t at, int type, double value) {
  switch (type) {
    case int8: return put(m, at, static_cast<std::int8_t>(value));
    case uint8: return put(m, at, static_cast<std::uint8_t>(value));
    case int16: return put(m, at, static_cast<std::int16_t>(value));
    case uint16: return put(m, at, static_cast<std::uint16_t>(value));
    case int32: return put(m, at, static_cast<std::int32_t>(value));
    case uint32: return put(m, at, static_cast<std::uint32_t>(value));
    case float32: return put(m, at, static_cast<float>(value));
    default: return put(m, at, value);
  }
}

/// What each point of message_of() is: column, row and 1; its color and the rest follow from its column.
inline std::uint8_t red_at(std::size_t column) { return static_cast<std::uint8_t>(column + 1); }
inline std::uint8_t green_at(std::size_t column) { return static_cast<std::uint8_t>(255 - column); }
inline constexpr std::uint8_t blue = 77;

/// Fields by their names: coordinates, rgb(a) as 32 bits or three bytes, separate colors, normals, anything else.
inline CloudMessage message_of(std::vector<CloudMessage::Field> fields, std::uint32_t step, std::uint32_t width,
                               std::uint32_t height, std::uint32_t row_bytes = 0, bool big = false) {
  CloudMessage m;
  m.fields = std::move(fields);
  m.is_bigendian = big;
  m.point_step = step;
  m.width = width;
  m.height = height;
  m.row_step = row_bytes == 0 ? step * width : row_bytes;
  m.data.assign(std::size_t{m.row_step} * height, 0xEE);
  for (std::uint32_t v = 0; v < height; ++v) {
    for (std::uint32_t u = 0; u < width; ++u) {
      const std::size_t point = std::size_t{v} * m.row_step + std::size_t{u} * step;
      const std::uint32_t word = 0xFF000000u | red_at(u) * 0x10000u | green_at(u) * 0x100u | blue;
      for (const CloudMessage::Field& field : m.fields) {
        const std::size_t at = point + field.offset;
        const std::string& name = field.name;
        const char first = static_cast<char>(name[0] | 0x20);
        if (name == "rgb" || name == "rgba") {
          if (field.count == 3) {
            m.data[at] = red_at(u), m.data[at + 1] = green_at(u), m.data[at + 2] = blue;
          } else {
            put(m, at, word);
          }
        } else if (name.size() == 1 && first >= 'x') {
          put_as(m, at, field.datatype, first == 'x' ? u : first == 'y' ? v : 1);
        } else if (first == 'n') {
          put_as(m, at, field.datatype, name.back() == 'z' ? 1 : 0);
        } else if (first == 'r' || first == 'g' || first == 'b') {
          put_as(m, at, field.datatype, first == 'r' ? red_at(u) : first == 'g' ? green_at(u) : blue);
        } else {
          put_as(m, at, field.datatype, u);
        }
      }
    }
  }
  return m;
}

}  // namespace unit
