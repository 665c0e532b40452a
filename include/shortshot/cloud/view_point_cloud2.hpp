// shortshot/cloud/view_point_cloud2.hpp: views of sensor_msgs/PointCloud2-shaped messages, without including ROS.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../config.hpp"
#include "../status.hpp"
#include "cloud.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// PointField datatypes that can be read in place.
inline constexpr int field_uint8 = 2;
inline constexpr int field_uint16 = 4;
inline constexpr int field_uint32 = 6;
inline constexpr int field_float32 = 7;

[[nodiscard]] inline bool is_little_endian() noexcept {
  const std::uint16_t one = 1;
  unsigned char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 1;
}

template <class Name>
[[nodiscard]] bool is_named(const Name& name, const char* text) noexcept {
  return name == text;
}

inline constexpr std::int64_t no_field = -1;       ///< of this name and a readable type
inline constexpr std::int64_t outside_point = -2;  ///< there is one, but it ends behind its point

/// Offset of a field with this name and a readable type, or one of these.
template <class Message>
[[nodiscard]] std::int64_t offset_of(const Message& message, const char* name, bool packed_color) noexcept {
  for (const auto& field : message.fields) {
    if (!is_named(field.name, name)) continue;
    const int type = static_cast<int>(field.datatype);
    const bool readable = type == field_float32 || (packed_color && type == field_uint32);
    const bool inside = static_cast<std::uint64_t>(field.offset) + 4 <= static_cast<std::uint64_t>(message.point_step);
    if (!readable) return no_field;
    return inside ? static_cast<std::int64_t>(field.offset) : outside_point;
  }
  return no_field;
}

/// The channel of a field `intensity` of FLOAT32, UINT8 or UINT16; absent if there is none.
template <class Message>
[[nodiscard]] ScalarChannel intensities_of(const Message& message, const unsigned char* data) noexcept {
  for (const auto& field : message.fields) {
    if (!is_named(field.name, "intensity")) continue;
    const int type = static_cast<int>(field.datatype);
    const bool readable = type == field_float32 || type == field_uint8 || type == field_uint16;
    const std::uint64_t size_bytes = type == field_float32 ? 4 : type == field_uint16 ? 2 : 1;
    const std::uint64_t end = static_cast<std::uint64_t>(field.offset) + size_bytes;
    if (!readable || end > static_cast<std::uint64_t>(message.point_step)) return {};
    const ScalarType scalar = type == field_float32  ? ScalarType::float32
                              : type == field_uint16 ? ScalarType::uint16
                                                     : ScalarType::uint8;
    return {data + field.offset, static_cast<std::size_t>(message.point_step), scalar};
  }
  return {};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// View of a message with members data (data(), size()), fields (name, offset, datatype), point_step, row_step, width,
/// height and is_bigendian. Fields x, y, z must be FLOAT32; color is a field `rgb` or `rgba`, a FLOAT32 or UINT32 with
/// 0xAARRGGBB packed into it; normals are FLOAT32 fields normal_x, normal_y, normal_z; an intensity is a FLOAT32,
/// UINT8 or UINT16. The view borrows the message's bytes.
///
/// Statuses (and an empty view): empty_cloud (no point), no_coordinates, field_outside, other_byte_order, padded_rows,
/// short_data. Colors, normals or intensities that cannot be read are absent. No allocation.
template <class Message>
[[nodiscard]] Status view_point_cloud2(const Message& message, CloudView& view) noexcept {
  view = CloudView{};
  const std::int64_t x = detail::offset_of(message, "x", false);
  const std::int64_t y = detail::offset_of(message, "y", false);
  const std::int64_t z = detail::offset_of(message, "z", false);
  if (x == detail::no_field || y == detail::no_field || z == detail::no_field) return Status::no_coordinates;
  if (x < 0 || y < 0 || z < 0) return Status::field_outside;
  if (static_cast<bool>(message.is_bigendian) == detail::is_little_endian()) return Status::other_byte_order;

  const auto step = static_cast<std::size_t>(message.point_step);
  const auto width = static_cast<std::size_t>(message.width);
  const auto height = static_cast<std::size_t>(message.height);
  if (height > 1 && static_cast<std::uint64_t>(message.row_step) != static_cast<std::uint64_t>(width) * step) {
    return Status::padded_rows;
  }
  if (width == 0 || height == 0) return Status::empty_cloud;
  if (message.data.size() / step / width < height) return Status::short_data;

  const auto* data = reinterpret_cast<const unsigned char*>(message.data.data());
  view.points = {data + x, data + y, data + z, step};
  view.size = width * height;
  view.width = width;
  view.height = height;

  std::int64_t color = detail::offset_of(message, "rgb", true);
  if (color < 0) color = detail::offset_of(message, "rgba", true);
  if (color >= 0) {
    const unsigned char* packed = data + color;
    const bool little = detail::is_little_endian();
    view.colors = {packed + (little ? 2 : 1), packed + (little ? 1 : 2), packed + (little ? 0 : 3), step};
  }
  view.intensities = detail::intensities_of(message, data);
  const std::int64_t normal_x = detail::offset_of(message, "normal_x", false);
  const std::int64_t normal_y = detail::offset_of(message, "normal_y", false);
  const std::int64_t normal_z = detail::offset_of(message, "normal_z", false);
  if (normal_x >= 0 && normal_y >= 0 && normal_z >= 0) {
    view.normals = {data + normal_x, data + normal_y, data + normal_z, step};
  }
  return Status::ok;
}

/// A message that dies at the end of the statement cannot be viewed.
template <class Message>
Status view_point_cloud2(const Message&& message, CloudView& view) = delete;

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
