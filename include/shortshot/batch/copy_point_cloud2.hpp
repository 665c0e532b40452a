// shortshot/batch/copy_point_cloud2.hpp: copies of sensor_msgs/PointCloud2-shaped messages that cannot be viewed as
// they are: padded rows, the other byte order, doubles and integers. Hosted only: allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "../base/math.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/point_cloud2.hpp"
#include "../config.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// A cloud with memory of its own, one after the other: what copy_point_cloud2() copies into. Empty: there is none.
struct CloudCopy {
  std::vector<float> xyz;              ///< 3 a point
  std::vector<std::uint8_t> rgb;       ///< 3 a point
  std::vector<SurfaceNormal> normals;  ///< 1 a point
  std::vector<float> intensities;      ///< 1 a point
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

template <class Number>
[[nodiscard]] Number number_of(const unsigned char (&bytes)[8]) noexcept {
  Number number{};
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// The float nearest to a FLOAT64 of these bits, the even one of two; NaN for what is no finite float. In integers: a
/// program that traps floating-point exceptions sees none.
[[nodiscard]] inline float narrowed(std::uint64_t bits) noexcept {
  constexpr std::uint32_t smallest = 1023 - 126;  // exponent of floats with all their digits
  constexpr std::uint32_t largest = 1023 + 127;
  const auto sign = static_cast<std::uint32_t>(bits >> 63 << 31);
  const auto exponent = static_cast<std::uint32_t>(bits >> 52 & 0x7FFu);
  if (exponent > largest) return std::numeric_limits<float>::quiet_NaN();
  const std::uint32_t shift = 29 + (exponent < smallest ? smallest - exponent : 0);
  if (shift > 54) return math::float_of(sign);  // less than half of the smallest float
  const std::uint64_t digits = (bits & 0xFFFFFFFFFFFFFu) | std::uint64_t{1} << 52;
  const std::uint64_t half = std::uint64_t{1} << (shift - 1);
  const std::uint64_t rest = digits & (2 * half - 1);
  auto rounded = static_cast<std::uint32_t>(digits >> shift);
  if (rest > half || (rest == half && (rounded & 1u) != 0)) ++rounded;
  const std::uint32_t magnitude = rounded + (exponent < smallest ? 0 : (exponent - smallest) << 23);
  return magnitude < 0x7F800000u ? math::float_of(sign | magnitude) : std::numeric_limits<float>::quiet_NaN();
}

/// The number at a place, of a type that there is.
[[nodiscard]] inline float field_at(const unsigned char* at, int type, bool is_swapped) noexcept {
  const auto size = static_cast<std::size_t>(size_of_type(static_cast<std::uint64_t>(type)));
  unsigned char bytes[8] = {};
  for (std::size_t k = 0; k < size; ++k) bytes[k] = at[is_swapped ? size - 1 - k : k];
  switch (type) {
    case field_int8: return static_cast<float>(number_of<std::int8_t>(bytes));
    case field_uint8: return static_cast<float>(number_of<std::uint8_t>(bytes));
    case field_int16: return static_cast<float>(number_of<std::int16_t>(bytes));
    case field_uint16: return static_cast<float>(number_of<std::uint16_t>(bytes));
    case field_int32: return static_cast<float>(number_of<std::int32_t>(bytes));
    case field_uint32: return static_cast<float>(number_of<std::uint32_t>(bytes));
    case field_float64: return narrowed(number_of<std::uint64_t>(bytes));
    default: return number_of<float>(bytes);
  }
}

/// Can a copy be made of it?
[[nodiscard]] inline bool is_copied(const MessageChannel& channel) noexcept {
  return channel.status == Status::ok || channel.status == Status::needs_conversion;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Copies a message as view_point_cloud2() takes it into `storage`, and makes a view of that, organized as the message;
/// the message may go then. Also reads padded rows, either byte order, coordinates and intensities of any type, and
/// normals of FLOAT64. Numbers are rounded to the nearest float (move coordinates of a map's size to their middle
/// before); what is not finite or too large is NaN.
///
/// Statuses: unread_channel: the message has colors, normals or intensities that are not read: the view has the rest,
/// and point_cloud2_channels() says which. All others leave an empty view and empty storage: those of
/// view_point_cloud2() but for the ones that it leaves to this one, and out_of_memory (more points than a vector has
/// room for). Allocates the storage (3 to 31 bytes a point, of which 12 for coordinates), and nothing if it was as
/// large before. May throw std::bad_alloc; the view is empty then. Reentrant.
template <class Message>
[[nodiscard]] Status copy_point_cloud2(const Message& message, CloudCopy& storage, CloudView& view) {
  view = CloudView{};
  storage.xyz.clear();
  storage.rgb.clear();
  storage.normals.clear();
  storage.intensities.clear();
  const detail::MessageParts parts = detail::parts_of(message);
  if (parts.status != Status::ok) return parts.status;
  const detail::MessageRows& rows = parts.rows;
  const std::size_t count = rows.width * rows.height;
  if (count > storage.xyz.max_size() / 3) return Status::out_of_memory;

  const auto* data = reinterpret_cast<const unsigned char*>(message.data.data());
  const auto for_each_point = [&](auto&& take) {
    std::size_t i = 0;
    for (std::size_t row = 0; row < rows.height; ++row) {
      const unsigned char* const first = data + row * rows.row_bytes;
      for (std::size_t column = 0; column < rows.width; ++column) take(i++, first + column * rows.step);
    }
  };
  const auto number = [&](const unsigned char* point, const detail::MessageChannel& channel, std::size_t k) {
    return detail::field_at(point + channel.offset[k], channel.type[k], parts.has_other_order);
  };
  storage.xyz.resize(3 * count);
  for_each_point([&](std::size_t i, const unsigned char* point) {
    for (std::size_t k = 0; k < 3; ++k) storage.xyz[3 * i + k] = number(point, parts.points, k);
  });
  if (detail::is_copied(parts.colors)) {
    storage.rgb.resize(3 * count);
    for_each_point([&](std::size_t i, const unsigned char* point) {
      for (std::size_t k = 0; k < 3; ++k) storage.rgb[3 * i + k] = point[parts.colors.offset[k]];
    });
  }
  if (detail::is_copied(parts.normals)) {
    storage.normals.resize(count);
    for_each_point([&](std::size_t i, const unsigned char* point) {
      const detail::MessageChannel& from = parts.normals;
      storage.normals[i] = {number(point, from, 0), number(point, from, 1), number(point, from, 2)};
    });
  }
  if (detail::is_copied(parts.intensities)) {
    storage.intensities.resize(count);
    for_each_point([&](std::size_t i, const unsigned char* point) {
      storage.intensities[i] = number(point, parts.intensities, 0);
    });
  }
  const auto memory_of = [](const auto& vector) { return vector.empty() ? nullptr : vector.data(); };
  view = view_xyz_rgb(storage.xyz.data(), memory_of(storage.rgb), count);
  view = with_intensities(with_normals(view, memory_of(storage.normals)), memory_of(storage.intensities));
  view = organized(view, rows.width, rows.height);
  bool all_read = true;
  for (const detail::MessageChannel* channel : {&parts.colors, &parts.normals, &parts.intensities}) {
    all_read = all_read && channel->status != Status::unread_channel;
  }
  return all_read ? Status::ok : Status::unread_channel;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
