// shortshot/cloud/view_point_cloud2.hpp: views of sensor_msgs/PointCloud2-shaped messages, without including ROS.
#pragma once

#include <cstddef>

#include "../config.hpp"
#include "../status.hpp"
#include "cloud.hpp"
#include "point_cloud2.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What a message has, and who reads it. Each is ok (view_point_cloud2() reads it, and so does copy_point_cloud2()),
/// needs_conversion (copy_point_cloud2() alone), or why nobody does: no_coordinates, missing_colors, missing_normals,
/// missing_intensities (there is none), bad_field, unread_channel (a type or a number of elements that is not read, or
/// a part of it is missing), field_outside.
struct PointCloud2Channels {
  Status coordinates;  ///< fields x, y and z
  Status colors;       ///< rgb or rgba
  Status normals;      ///< normal_x, normal_y and normal_z
  Status intensities;  ///< intensity
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// What a message has; only its fields, point_step and is_bigendian are looked at. No allocation; reentrant.
template <class Message>
[[nodiscard]] PointCloud2Channels point_cloud2_channels(const Message& message) noexcept {
  return {detail::coordinates_of(message).status, detail::colors_in(message).status, detail::normals_in(message).status,
          detail::intensities_in(message).status};
}

/// View of a message with members data (data(), size()), fields (name, offset, datatype and, if it has one, count),
/// point_step, row_step, width, height and is_bigendian. The view borrows the message's bytes, and is organized as the
/// message.
///
/// Read are fields x, y, z (or X, Y, Z) of FLOAT32; colors `rgb` or `rgba`, 0xAARRGGBB packed into a FLOAT32, UINT32 or
/// INT32, `rgb` of three UINT8 (red first), or UINT8 fields r g b, red green blue, R G B, Red Green Blue; normals
/// normal_x, normal_y, normal_z or nx, ny, nz of FLOAT32; an intensity of FLOAT32, UINT8 or UINT16. A row_step that is
/// wrong does no harm where data.size() is width * height * point_step.
///
/// Statuses: unread_channel: the message has colors, normals or intensities that are not read in place: the view has
/// the rest, and point_cloud2_channels() says which. All others leave an empty view: no_coordinates, empty_cloud (no
/// point), no_point_step, bad_field, field_outside (a field of any of these names), too_many_points,
/// short_data, short_rows; and those that copy_point_cloud2() reads: other_byte_order, needs_conversion (coordinates),
/// padded_rows. The first one that applies. No allocation; reentrant.
template <class Message>
[[nodiscard]] Status view_point_cloud2(const Message& message, CloudView& view) noexcept {
  view = CloudView{};
  const detail::MessageParts parts = detail::parts_of(message);
  if (parts.status != Status::ok) return parts.status;
  if (parts.has_other_order) return Status::other_byte_order;
  if (parts.points.status != Status::ok) return parts.points.status;
  if (parts.rows.status != Status::ok) return parts.rows.status;

  const auto* data = reinterpret_cast<const unsigned char*>(message.data.data());
  const std::size_t step = parts.rows.step;
  const auto floats = [=](const detail::MessageChannel& channel) -> Float3Channel {
    return {data + channel.offset[0], data + channel.offset[1], data + channel.offset[2], step};
  };
  view.size = parts.rows.width * parts.rows.height;
  view.width = parts.rows.width;
  view.height = parts.rows.height;
  view.points = floats(parts.points);
  bool all_read = true;
  const auto is_read = [&](const detail::MessageChannel& channel) {
    all_read =
        all_read && (channel.status == Status::ok || detail::severity(channel.status) == detail::missing_channel);
    return channel.status == Status::ok;
  };
  if (is_read(parts.colors)) {
    const std::size_t(&rgb)[3] = parts.colors.offset;
    view.colors = {data + rgb[0], data + rgb[1], data + rgb[2], step};
  }
  if (is_read(parts.normals)) view.normals = floats(parts.normals);
  if (is_read(parts.intensities)) {
    const int type = parts.intensities.type[0];
    view.intensities = {data + parts.intensities.offset[0], step,
                        type == detail::field_float32  ? ScalarType::float32
                        : type == detail::field_uint16 ? ScalarType::uint16
                                                       : ScalarType::uint8};
  }
  return all_read ? Status::ok : Status::unread_channel;
}

/// A message that dies at the end of the statement cannot be viewed.
template <class Message>
Status view_point_cloud2(const Message&& message, CloudView& view) = delete;

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
