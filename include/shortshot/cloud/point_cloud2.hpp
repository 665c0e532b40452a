// shortshot/cloud/point_cloud2.hpp: what a sensor_msgs/PointCloud2-shaped message says of itself, checked before any of
// its bytes is read: which fields are its coordinates, colors, normals and intensities, and where its rows lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "../config.hpp"
#include "../status.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// PointField's datatypes.
enum FieldType : int {
  field_int8 = 1,
  field_uint8,
  field_int16,
  field_uint16,
  field_int32,
  field_uint32,
  field_float32,
  field_float64
};

/// Bytes of a number; 0 for a type that there is not.
[[nodiscard]] inline std::uint64_t size_of_type(std::uint64_t type) noexcept {
  constexpr std::uint8_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  return type < sizeof sizes ? sizes[type] : 0;
}

/// A message's numbers have 32 bits. What has more in another's struct, and what is negative, becomes 2^32.
template <class Number>
[[nodiscard]] std::uint64_t message_number(const Number& number) noexcept {
  constexpr std::uint64_t too_large = std::uint64_t{1} << 32;
  const auto wide = static_cast<std::uint64_t>(number);
  return wide < too_large ? wide : too_large;
}

template <class Field, class = void>
struct HasElementCount : std::false_type {};
template <class Field>
struct HasElementCount<Field, std::void_t<decltype(std::declval<const Field&>().count)>> : std::true_type {};

struct MessageField {
  bool exists;
  std::uint64_t offset;
  std::uint64_t type;
  std::uint64_t count;
};

/// The first field of a name. A count of 0 means 1: some drivers never set it, and PCL reads them so.
template <class Message>
[[nodiscard]] MessageField field_of(const Message& message, const char* name) noexcept {
  for (const auto& field : message.fields) {
    if (!(field.name == name)) continue;
    MessageField found{true, message_number(field.offset), message_number(field.datatype), 1};
    if constexpr (HasElementCount<std::decay_t<decltype(field)>>::value)
      found.count = field.count == 0 ? 1 : message_number(field.count);
    return found;
  }
  return {};
}

/// Three numbers of a point, or one: where they are, and whether they can be read: ok in place, needs_conversion by a
/// copy, else why not.
struct MessageChannel {
  Status status;
  std::size_t offset[3];
  int type[3];
};

/// Which types a channel may have, and what it is to have none, or only some of its fields.
struct ChannelRule {
  Status (*accept)(std::uint64_t type, std::uint64_t count);
  Status missing;
  Status partial;
};

inline Status accept_coordinate(std::uint64_t type, std::uint64_t count) noexcept {
  if (count != 1 || size_of_type(type) == 0) return Status::bad_field;
  return type == field_float32 ? Status::ok : Status::needs_conversion;
}
inline Status accept_normal(std::uint64_t type, std::uint64_t count) noexcept {
  if (count != 1 || (type != field_float32 && type != field_float64)) return Status::unread_channel;
  return type == field_float32 ? Status::ok : Status::needs_conversion;
}
inline Status accept_intensity(std::uint64_t type, std::uint64_t count) noexcept {
  if (count != 1 || size_of_type(type) == 0) return Status::unread_channel;
  const bool in_place = type == field_float32 || type == field_uint8 || type == field_uint16;
  return in_place ? Status::ok : Status::needs_conversion;
}
/// Other types than bytes may mean 0 to 1, 0 to 255 or 0 to 65535: a guess could be a wrong color.
inline Status accept_byte(std::uint64_t type, std::uint64_t count) noexcept {
  return count == 1 && type == field_uint8 ? Status::ok : Status::unread_channel;
}
/// 0xAARRGGBB in 32 bits, whatever they are called.
inline Status accept_packed(std::uint64_t type, std::uint64_t count) noexcept {
  const bool word = type == field_int32 || type == field_uint32 || type == field_float32;
  return count == 1 && word ? Status::ok : Status::unread_channel;
}
inline Status accept_packed_or_bytes(std::uint64_t type, std::uint64_t count) noexcept {
  return count == 3 && type == field_uint8 ? Status::ok : accept_packed(type, count);
}

/// How bad it is. From `damaged` on the message contradicts itself, and nothing of it is believed.
inline constexpr int missing_channel = 3;
inline constexpr int damaged_channel = 4;
[[nodiscard]] inline int severity(Status status) noexcept {
  switch (status) {
    case Status::ok: return 0;
    case Status::needs_conversion: return 1;
    case Status::bad_field:
    case Status::unread_channel: return 2;
    case Status::field_outside: return damaged_channel;
    default: return missing_channel;
  }
}

/// The channel of `count` fields; if none of them is there, its status is rule.missing.
template <class Message>
[[nodiscard]] MessageChannel channel_of(const Message& message, const char* const* names, std::size_t count,
                                        const ChannelRule& rule) noexcept {
  MessageChannel channel{};
  std::size_t missing = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const MessageField field = field_of(message, names[k]);
    if (!field.exists) {
      ++missing;
      continue;
    }
    const std::uint64_t size = size_of_type(field.type);
    const std::uint64_t end = field.offset + (size == 0 ? 1 : size) * field.count;
    Status status = rule.accept(field.type, field.count);
    if (end > message_number(message.point_step)) status = Status::field_outside;
    if (severity(status) > severity(channel.status)) channel.status = status;
    if (severity(status) >= damaged_channel) continue;
    channel.offset[k] = static_cast<std::size_t>(field.offset);
    channel.type[k] = static_cast<int>(field.type <= field_float64 ? field.type : 0);
  }
  if (severity(channel.status) >= damaged_channel || missing == 0) return channel;
  channel.status = missing == count ? rule.missing : rule.partial;
  return channel;
}

/// Of two channels that mean the same: damage is not passed over, else the one that can be read more easily.
[[nodiscard]] inline const MessageChannel& better(const MessageChannel& a, const MessageChannel& b) noexcept {
  const int of_a = severity(a.status);
  const int of_b = severity(b.status);
  if (of_a >= damaged_channel || of_b >= damaged_channel) return of_a >= of_b ? a : b;
  return of_a <= of_b ? a : b;
}

template <class Message>
[[nodiscard]] MessageChannel coordinates_of(const Message& message) noexcept {
  constexpr const char* names[][3] = {{"x", "y", "z"}, {"X", "Y", "Z"}};
  const ChannelRule rule{accept_coordinate, Status::no_coordinates, Status::no_coordinates};
  return better(channel_of(message, names[0], 3, rule), channel_of(message, names[1], 3, rule));
}

template <class Message>
[[nodiscard]] MessageChannel normals_in(const Message& message) noexcept {
  constexpr const char* names[][3] = {{"normal_x", "normal_y", "normal_z"}, {"nx", "ny", "nz"}};
  const ChannelRule rule{accept_normal, Status::missing_normals, Status::unread_channel};
  return better(channel_of(message, names[0], 3, rule), channel_of(message, names[1], 3, rule));
}

template <class Message>
[[nodiscard]] MessageChannel intensities_in(const Message& message) noexcept {
  constexpr const char* name = "intensity";
  return channel_of(message, &name, 1, {accept_intensity, Status::missing_intensities, Status::missing_intensities});
}

/// Offsets are those of the bytes red, green and blue.
template <class Message>
[[nodiscard]] MessageChannel colors_in(const Message& message) noexcept {
  constexpr const char* words[] = {"rgb", "rgba"};
  constexpr const char* bytes[][3] = {
      {"r", "g", "b"}, {"red", "green", "blue"}, {"R", "G", "B"}, {"Red", "Green", "Blue"}};
  MessageChannel colors{Status::missing_colors, {}, {}};
  const bool big = static_cast<bool>(message.is_bigendian);
  for (const auto& name : words) {
    const bool is_rgb = &name == &words[0];
    MessageChannel word =
        channel_of(message, &name, 1,
                   {is_rgb ? accept_packed_or_bytes : accept_packed, Status::missing_colors, Status::missing_colors});
    const bool is_packed = word.type[0] != field_uint8;
    const std::size_t places[3] = {is_packed ? (big ? 1u : 2u) : 0u,
                                   is_packed && !big ? 1u
                                   : is_packed       ? 2u
                                                     : 1u,
                                   is_packed ? (big ? 3u : 0u) : 2u};
    for (std::size_t k = 3; k-- > 0;) word.offset[k] = word.offset[0] + places[k];
    colors = better(colors, word);
  }
  for (const auto& names : bytes) {
    colors =
        better(colors, channel_of(message, names, 3, {accept_byte, Status::missing_colors, Status::unread_channel}));
  }
  return colors;
}

/// Where the points lie in a message's data.
struct MessageRows {
  Status status;  ///< ok: all points follow each other by `step`; padded_rows: rows by `row_bytes`; else why not
  std::size_t width;
  std::size_t height;
  std::size_t step;
  std::size_t row_bytes;
};

/// Data that is as long as all points tells the truth, whatever row_step says. No product leaves 64 bits: there are
/// less than 2^32 points, hence rows and columns together, and steps are 2^32 at most. What fits the data fits
/// std::size_t.
template <class Message>
[[nodiscard]] MessageRows rows_in(const Message& message) noexcept {
  const std::uint64_t width = message_number(message.width);
  const std::uint64_t height = message_number(message.height);
  const std::uint64_t step = message_number(message.point_step);
  const std::uint64_t size = message.data.size();
  const auto refused = [](Status status) { return MessageRows{status, 0, 0, 0, 0}; };
  if (width == 0 || height == 0) return refused(Status::empty_cloud);
  if (step == 0) return refused(Status::no_point_step);
  if (width > 0xFFFFFFFFu / height) return refused(Status::too_many_points);
  const std::uint64_t row = width * step;
  if (size < row * height) return refused(Status::short_data);
  const std::uint64_t said = height > 1 ? message_number(message.row_step) : row;
  const bool dense = said == row || size == row * height;
  if (!dense && said < row) return refused(Status::short_rows);
  if (!dense && size < said * (height - 1) + row) return refused(Status::short_data);
  return {dense ? Status::ok : Status::padded_rows, static_cast<std::size_t>(width), static_cast<std::size_t>(height),
          static_cast<std::size_t>(step), static_cast<std::size_t>(dense ? row : said)};
}

[[nodiscard]] inline bool is_little_endian() noexcept { return __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__; }

/// All of it.
struct MessageParts {
  Status status;  ///< ok: copy_point_cloud2() can read the points, if not view_point_cloud2()
  bool has_other_order;
  MessageRows rows;
  MessageChannel points;
  MessageChannel colors;
  MessageChannel normals;
  MessageChannel intensities;
};

template <class Message>
[[nodiscard]] MessageParts parts_of(const Message& message) noexcept {
  MessageParts parts{Status::ok,
                     static_cast<bool>(message.is_bigendian) == is_little_endian(),
                     rows_in(message),
                     coordinates_of(message),
                     colors_in(message),
                     normals_in(message),
                     intensities_in(message)};
  const Status of_rows = parts.rows.status;
  const auto refuse = [&](Status status) {
    if (parts.status == Status::ok) parts.status = status;
  };
  if (parts.points.status == Status::no_coordinates) refuse(Status::no_coordinates);
  if (of_rows == Status::empty_cloud || of_rows == Status::no_point_step) refuse(of_rows);
  if (severity(parts.points.status) > severity(Status::needs_conversion)) refuse(parts.points.status);
  for (const MessageChannel* channel : {&parts.colors, &parts.normals, &parts.intensities}) {
    if (severity(channel->status) >= damaged_channel) refuse(channel->status);
  }
  if (of_rows != Status::padded_rows) refuse(of_rows);
  return parts;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
