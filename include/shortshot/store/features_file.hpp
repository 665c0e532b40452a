// shortshot/store/features_file.hpp: what extract() gives as bytes, or in a file. Hosted only: allocates.
//
// Between what byte_stream.hpp puts around it ("SSHOTFEA", the version and the checksum), n rows of s values:
//
//     layout (length, characters), s, n
//     values: n * s floats, row by row; or what they are stored as (stored_features.hpp), which the layout says then
//     statuses: n bytes
//     key points, for each: 3 floats position, float intensity, 3 bytes red, green, blue, 1 byte: 1 if there is a color
//       plus 2 if there is an intensity
//     frames: n * 9 floats, the x axis first
//     frames' confidences: n * 3 floats (gap, margin of x, margin of z)
//     neighbors: n * 4 bytes
//
// Numbers of statuses are part of the format: Status only ever grows at its end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "../base/math.hpp"
#include "../batch/features.hpp"
#include "../cloud/keypoint.hpp"
#include "../config.hpp"
#include "../descriptor/layout_of.hpp"
#include "../status.hpp"
#include "byte_stream.hpp"
#include "replace_file.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

inline constexpr FileKind features_file{"SSHOTFEA", 1};

/// Values of a row may be floats, halves or bytes.
[[nodiscard]] inline bool is_value(float value) noexcept { return math::is_finite(value); }
[[nodiscard]] inline bool is_value(std::uint16_t half) noexcept { return (half & 0x7C00u) != 0x7C00u; }
[[nodiscard]] inline bool is_value(std::uint8_t) noexcept { return true; }
inline void write_value(ByteWriter& to, float value) { to.real(value); }
inline void write_value(ByteWriter& to, std::uint16_t half) { to.number(half); }
inline void write_value(ByteWriter& to, std::uint8_t byte) { to.number(byte); }
inline void read_value(ByteReader& from, float& value) noexcept { value = from.any_real(); }
inline void read_value(ByteReader& from, std::uint16_t& half) noexcept { half = from.number<std::uint16_t>(); }
inline void read_value(ByteReader& from, std::uint8_t& byte) noexcept { byte = from.number<std::uint8_t>(); }

/// Of a row, without its values.
inline constexpr std::size_t feature_bytes = 1 + (3 + 1) * sizeof(float) + 4 + (9 + 3) * sizeof(float) + 4;

/// The vectors of a Features<D>, or of a const one: what follows is compiled once for all D, and, being templates, not
/// at all where no features are saved.
template <template <class> class MaybeConst, class Number>
struct FeatureColumns {
  using Value = Number;
  std::string_view layout;
  std::size_t row_size;
  MaybeConst<std::vector<Value>>& values;
  MaybeConst<std::vector<Status>>& status;
  MaybeConst<std::vector<KeyPoint>>& keypoints;
  MaybeConst<std::vector<Frame>>& frames;
  MaybeConst<std::vector<FrameConfidence>>& confidence;
  MaybeConst<std::vector<std::uint32_t>>& neighbors;
};
template <class T>
using Same = T;
template <class Value>
using ColumnsToSave = FeatureColumns<std::add_const_t, Value>;
template <class Value>
using ColumnsToLoad = FeatureColumns<Same, Value>;

template <class Columns, class SomeFeatures, class Values>
[[nodiscard]] Columns columns_of(SomeFeatures& features, Values& values, std::string_view layout,
                                 std::size_t row_size) noexcept {
  return {layout,
          row_size,
          values,
          features.status,
          features.keypoints,
          features.frames,
          features.frame_confidence,
          features.neighbors};
}

/// What load() would take: as many of everything, and no value that is not finite. A key point's position and intensity
/// may be anything: that is what its status says.
template <class Columns>
[[nodiscard]] bool can_be_saved(const Columns& from) noexcept {
  const std::size_t count = from.status.size();
  bool can = from.values.size() == count * from.row_size && from.keypoints.size() == count &&
             from.frames.size() == count && from.confidence.size() == count && from.neighbors.size() == count;
  for (const auto value : from.values) can = can && is_value(value);
  for (const Status status : from.status) can = can && static_cast<int>(status) < status_count;
  for (const Frame& frame : from.frames) {
    can = can && math::is_finite(frame.x) && math::is_finite(frame.y) && math::is_finite(frame.z);
  }
  for (const FrameConfidence& c : from.confidence) {
    can = can && is_finite(Point{c.eigenvalue_gap, c.x_margin, c.z_margin});
  }
  return can;
}

template <class Columns>
void write_columns(ByteWriter& to, const Columns& from) {
  to.name(from.layout);
  to.count(from.row_size);
  to.count(from.status.size());
  for (const auto value : from.values) write_value(to, value);
  for (const Status status : from.status) to.number(static_cast<std::uint8_t>(status));
  for (const KeyPoint& key : from.keypoints) {
    to.point(key.position);
    to.real(key.intensity);
    for (const std::uint8_t channel : {key.color.r, key.color.g, key.color.b}) to.number(channel);
    to.number(static_cast<std::uint8_t>((key.has_color ? 1 : 0) + (key.has_intensity ? 2 : 0)));
  }
  for (const Frame& frame : from.frames) {
    to.reals(frame.x, 3);
    to.reals(frame.y, 3);
    to.reals(frame.z, 3);
  }
  for (const FrameConfidence& c : from.confidence) to.point({c.eigenvalue_gap, c.x_margin, c.z_margin});
  for (const std::uint32_t count : from.neighbors) to.number(count);
}

[[nodiscard]] inline Status read_status(ByteReader& from) noexcept {
  const auto number = from.number<std::uint8_t>();
  from.require(number < status_count);
  return from.good() ? static_cast<Status>(number) : Status::ok;
}

[[nodiscard]] inline KeyPoint read_keypoint(ByteReader& from) noexcept {
  KeyPoint key{};
  for (float* value : {&key.position.x, &key.position.y, &key.position.z, &key.intensity}) *value = from.any_real();
  for (std::uint8_t* channel : {&key.color.r, &key.color.g, &key.color.b}) *channel = from.number<std::uint8_t>();
  const auto has = from.number<std::uint8_t>();
  from.require(has < 4);
  key.has_color = (has & 1u) != 0;
  key.has_intensity = (has & 2u) != 0;
  return key;
}

/// ok, other_descriptor or damaged_model; what is not ok may leave anything.
template <class Columns>
[[nodiscard]] Status read_columns(ByteReader& from, const Columns& to) {
  const std::string layout = from.name();
  const auto row_size = from.number<std::uint64_t>();
  if (!from.good()) return Status::damaged_model;
  if (layout != to.layout) return Status::other_descriptor;
  from.require(row_size == to.row_size);
  const std::size_t row_bytes = to.row_size * sizeof(typename Columns::Value) + feature_bytes;
  const std::size_t count = from.count(row_bytes);
  from.require(from.left() == count * row_bytes);
  if (!from.good()) return Status::damaged_model;
  to.values.resize(count * to.row_size);
  for (auto& value : to.values) {
    read_value(from, value);
    from.require(is_value(value));
  }
  to.status.reserve(count);
  while (to.status.size() < count) to.status.push_back(read_status(from));
  to.keypoints.reserve(count);
  while (to.keypoints.size() < count) to.keypoints.push_back(read_keypoint(from));
  to.frames.resize(count);
  for (Frame& frame : to.frames) {
    from.reals(frame.x, 3);
    from.reals(frame.y, 3);
    from.reals(frame.z, 3);
  }
  to.confidence.reserve(count);
  while (to.confidence.size() < count) {
    const Point c = from.point();
    to.confidence.push_back({c.x, c.y, c.z});
  }
  to.neighbors.reserve(count);
  while (to.neighbors.size() < count) to.neighbors.push_back(from.number<std::uint32_t>());
  return from.good() ? Status::ok : Status::damaged_model;
}

template <class Columns>
[[nodiscard]] Status save_columns(const Columns& from, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  if (!can_be_saved(from)) return Status::bad_rows;
  const std::size_t row_bytes = from.row_size * sizeof(typename Columns::Value) + feature_bytes;
  ByteWriter to(bytes, features_file, 4096 + from.status.size() * row_bytes);
  write_columns(to, from);
  to.finish();
  return Status::ok;
}
template <class Columns>
[[nodiscard]] Status load_columns(const std::uint8_t* bytes, std::size_t size, const Columns& to) {
  ByteReader body(nullptr, 0);
  const Status status = open_checked(bytes, size, features_file, body);
  return status == Status::ok ? read_columns(body, to) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// What extract() gave, as bytes: the same ones on every machine, 4 * D::size + 73 for a row and some hundred more.
///
/// Statuses: bad_rows (vectors that are not as long as each other, as extract() makes them; values, frames or
/// confidences that are not finite); `bytes` is empty then. Allocates the bytes. Reentrant.
template <class D>
[[nodiscard]] Status save(const Features<D>& features, std::vector<std::uint8_t>& bytes) {
  const std::string layout = layout_of<D>();
  using Columns = detail::ColumnsToSave<float>;
  return detail::save_columns(detail::columns_of<Columns>(features, features.values, layout, std::size_t{D::size}),
                              bytes);
}

/// The features that save() made these bytes of, bit for bit. What layout_of<D>() does not say (radii, how frames were
/// turned) is for the caller to know.
///
/// Statuses, the first one that applies: not_a_model (no features' bytes), other_version, damaged_model (the bytes end
/// early, or go on; the checksum is wrong), other_descriptor (of another layout than D's), damaged_model (the bytes are
/// not what save() writes). `out` has not changed then. Allocates about as much as there are bytes, whatever they say.
/// Reentrant.
template <class D>
[[nodiscard]] Status load(const std::uint8_t* bytes, std::size_t size, Features<D>& out) {
  const std::string layout = layout_of<D>();
  Features<D> loaded;
  using Columns = detail::ColumnsToLoad<float>;
  const Status status = detail::load_columns(
      bytes, size, detail::columns_of<Columns>(loaded, loaded.values, layout, std::size_t{D::size}));
  if (status == Status::ok) out = std::move(loaded);
  return status;
}

/// The same in a file. Also no_file: it cannot be opened, or not all of it written or read. If that happens to save()
/// (the disk is full), what was in the file still is: the new one is written beside it, as `path` + ".tmp-00" (or 01,
/// ...), and takes its name when it is complete. So there must be room for both, and its folder must be writable.
template <class D>
[[nodiscard]] Status save(const Features<D>& features, const std::string& path) {
  std::vector<std::uint8_t> bytes;
  const Status status = save(features, bytes);
  return status == Status::ok ? detail::replace_file(path, bytes) : status;
}
template <class D>
[[nodiscard]] Status load(const std::string& path, Features<D>& out) {
  std::vector<std::uint8_t> bytes;
  const Status status = detail::read_file(path, bytes);
  return status == Status::ok ? load(bytes.data(), bytes.size(), out) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
