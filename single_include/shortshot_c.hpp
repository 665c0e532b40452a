// SPDX-License-Identifier: BSD-3-Clause
// shortshot_c.hpp: what shortshot_c.cpp is made of: how C's data become C++'s, the table of descriptors, and rows.
#pragma once

#include "shortshot.h"
#include "shortshot.hpp"

struct shortshot_recognizer {
  shortshot::Recognizer is;
};

namespace {

namespace ss = shortshot;
using ss::Status;

// ---- What both languages say of memory ------------------------------------------------------------------------------

static_assert(ss::status_count == SHORTSHOT_NOT_WRITTEN + 1 && sizeof(Status) == 1, "shortshot_status");
static_assert(int(ss::Viewpoint::Side::towards) == SHORTSHOT_TOWARDS, "viewpoint_side");
static_assert(int(ss::Viewpoint::Side::away_from) == SHORTSHOT_AWAY_FROM, "viewpoint_side");
static_assert(int(ss::ScalarType::uint8) == 1 && int(ss::ScalarType::uint16) == 2, "intensity_type");

/// Copies plain data of one language to that of the other, which has the same layout.
template <class From, class To>
void copy(const From* from, std::size_t count, To* to) noexcept {
  static_assert(sizeof(From) == sizeof(To) && alignof(From) == alignof(To), "the same layout");
  static_assert(std::is_trivially_copyable<From>::value && std::is_trivially_copyable<To>::value, "plain data");
  if (count > 0) std::memcpy(static_cast<void*>(to), from, count * sizeof(From));
}

/// No exception leaves the library. Besides memory, threads may be refused.
template <class Function>
shortshot_status guarded(const Function& function) noexcept {
  try {
    return static_cast<shortshot_status>(function());
  } catch (...) {
    return SHORTSHOT_OUT_OF_MEMORY;
  }
}

template <class Struct>
bool has_size(const Struct* of) noexcept {
  return of != nullptr && of->size_bytes == sizeof(Struct);
}

/// Writes a struct whose first member is its size, if it has the size that the caller says.
template <class Struct>
bool write_sized(Struct value, Struct* to, std::size_t size_bytes) noexcept {
  if (to == nullptr || size_bytes != sizeof(Struct)) return false;
  value.size_bytes = sizeof(Struct);
  *to = value;
  return true;
}

ss::CloudView view_of(const shortshot_cloud* cloud) noexcept {
  if (!has_size(cloud) || cloud->intensity_type > 2) return ss::detail::unusable_view(Status::bad_view);
  const auto bytes = [](const void* of) { return static_cast<const unsigned char*>(of); };
  ss::CloudView view{};
  view.points = {bytes(cloud->x), bytes(cloud->y), bytes(cloud->z), cloud->xyz_stride_bytes};
  view.colors = {cloud->r, cloud->g, cloud->b, cloud->rgb_stride_bytes};
  view.normals = {bytes(cloud->normal_x), bytes(cloud->normal_y), bytes(cloud->normal_z), cloud->normal_stride_bytes};
  view.intensities = {bytes(cloud->intensity), cloud->intensity_stride_bytes, ss::ScalarType(cloud->intensity_type)};
  view.size = view.width = cloud->count;
  view.height = 1;
  return view;
}

shortshot_options options_of(const ss::CloudOptions& from) noexcept {
  const ss::Viewpoint& v = from.viewpoint;
  const auto side = static_cast<std::uint32_t>(v.side);
  return {0, from.radius, from.frame_radius, from.best_frames, side, {v.point.x, v.point.y, v.point.z}, from.threads};
}

Status read(const shortshot_options* from, ss::CloudOptions& to) noexcept {
  if (from == nullptr) return Status::ok;
  if (!has_size(from) || from->viewpoint_side > SHORTSHOT_AWAY_FROM) return Status::bad_option;
  to.radius = from->radius;
  to.frame_radius = from->frame_radius;
  to.best_frames = from->best_frames;
  to.viewpoint.side = ss::Viewpoint::Side(from->viewpoint_side);
  to.viewpoint.point = {from->viewpoint[0], from->viewpoint[1], from->viewpoint[2]};
  to.threads = from->threads;
  return Status::ok;
}

ss::KeyPoint keypoint_of(const shortshot_keypoint& from) noexcept {
  ss::KeyPoint key({from.x, from.y, from.z});
  key.has_color = (from.has & SHORTSHOT_HAS_COLOR) != 0;
  key.has_intensity = (from.has & SHORTSHOT_HAS_INTENSITY) != 0;
  if (key.has_color) key.color = {from.r, from.g, from.b};
  if (key.has_intensity) key.intensity = from.intensity;
  return key;
}

shortshot_keypoint keypoint_of(const ss::KeyPoint& from) noexcept {
  const int has = (from.has_color ? SHORTSHOT_HAS_COLOR : 0) + (from.has_intensity ? SHORTSHOT_HAS_INTENSITY : 0);
  const ss::Point& at = from.position;
  return {at.x, at.y, at.z, from.intensity, from.color.r, from.color.g, from.color.b, static_cast<std::uint8_t>(has)};
}

// ---- The table of descriptors ---------------------------------------------------------------------------------------

constexpr float no_values[1344] = {};  // as many as the largest has

struct Storage {
  std::size_t row_bytes;
  float step;                                    // of codes
  void (*make)(const float* values, void* row);  // by bytes: a row may lie anywhere
  std::string (*layout)();
};

/// Writes rows, statuses and frames to where the caller wants them.
void write(const float* values, std::size_t row_size, const Status* status, const ss::Frame* frames,
           const Storage& storage, const shortshot_features& to) noexcept {
  auto* const rows = static_cast<unsigned char*>(to.rows);
  for (std::size_t i = 0; i < to.count; ++i) storage.make(values + i * row_size, rows + i * storage.row_bytes);
  if (to.status != nullptr) copy(status, to.count, to.status);
  if (to.frames != nullptr) copy(frames, to.count, to.frames);
}

template <class D>
Status describe(const ss::CloudView& cloud, const std::vector<ss::KeyPoint>& keypoints, const ss::CloudOptions& options,
                const Storage& storage, const shortshot_features& to) {
  const ss::Support support = ss::detail::support_of(options, options.radius);
  ss::Features<D> features;
  const ss::GridSearch search(cloud, options.radius);
  Status status = ss::extract(cloud, search, keypoints, support, features, options.threads);
  if (status == Status::ok) status = ss::keep_best_frames(features, options.best_frames);
  if (status != Status::ok) return status;
  write(features.values.data(), D::size, features.status.data(), features.frames.data(), storage, to);
  return Status::ok;
}

template <class D>
constexpr Storage floats = {D::size_bytes, 0.0f,
                            [](const float* values, void* row) { std::memcpy(row, values, D::size_bytes); },
                            ss::layout_of<D>};
template <class Stored>
constexpr Storage stored(float step) {
  const auto make = [](const float* values, void* row) {
    Stored made;
    ss::detail::Storage<Stored>::make(values, made);
    std::memcpy(row, &made, sizeof made);
  };
  return {sizeof(Stored), step, make, ss::storage_layout<Stored>};
}
template <class D, int Bits>
constexpr Storage coded = stored<ss::CodedDescriptor<D, Bits>>(ss::CodedDescriptor<D, Bits>::step);

struct Entry {
  shortshot_descriptor number;
  const char* name;
  std::uint32_t needs;
  decltype(&describe<ss::Ssh32>) describe;
  Storage storages[SHORTSHOT_SUM_BITS + 1];
};

template <class D>
constexpr Entry entry(shortshot_descriptor number, const char* name) {
  static_assert(std::size_t{D::size} <= sizeof no_values / sizeof(float), "no_values has enough");
  const int needs = (D::needs_colors ? SHORTSHOT_NEEDS_COLORS : 0) + (D::needs_normals ? SHORTSHOT_NEEDS_NORMALS : 0) +
                    (D::needs_intensities ? SHORTSHOT_NEEDS_INTENSITIES : 0);
  return {number,
          name,
          static_cast<std::uint32_t>(needs),
          describe<D>,
          {floats<D>, stored<ss::HalfDescriptor<D>>(0.0f), coded<D, 8>, coded<D, 4>, coded<D, 3>,
           stored<ss::BinaryDescriptor<D>>(0.0f), stored<ss::SumBits<D>>(0.0f)}};
}

constexpr Entry table[] = {
    entry<ss::Ssh32>(SHORTSHOT_SSH32, "Ssh32"),
    entry<ss::Ssh96>(SHORTSHOT_SSH96, "Ssh96"),
    entry<ss::Scsh336>(SHORTSHOT_SCSH336, "Scsh336"),
    entry<ss::Scsh696>(SHORTSHOT_SCSH696, "Scsh696"),
    entry<ss::Shot352>(SHORTSHOT_SHOT352, "Shot352"),
    entry<ss::Cshot1344>(SHORTSHOT_CSHOT1344, "Cshot1344"),
    entry<ss::PclShot352>(SHORTSHOT_PCL_SHOT352, "PclShot352"),
    entry<ss::PclCshot1344>(SHORTSHOT_PCL_CSHOT1344, "PclCshot1344"),
    entry<ss::IntensityShape336>(SHORTSHOT_INTENSITY_SHAPE336, "IntensityShape336"),
    entry<ss::ShapeColor95>(SHORTSHOT_SHAPE_COLOR95, "ShapeColor95"),
    entry<ss::ShapeColor32>(SHORTSHOT_SHAPE_COLOR32, "ShapeColor32"),
    entry<ss::RoomColor95>(SHORTSHOT_ROOM_COLOR95, "RoomColor95"),
    entry<ss::HeightShape96>(SHORTSHOT_HEIGHT_SHAPE96, "HeightShape96"),
    entry<ss::ColorRings27>(SHORTSHOT_COLOR_RINGS27, "ColorRings27"),
};

const Entry* find(shortshot_descriptor number) noexcept {
  for (const Entry& entry : table) {
    if (entry.number == number) return &entry;
  }
  return nullptr;
}

const Storage* find(shortshot_descriptor number, shortshot_storage storage) noexcept {
  const Entry* const entry = find(number);
  return entry == nullptr || storage > SHORTSHOT_SUM_BITS ? nullptr : entry->storages + storage;
}

// ---- Rows of the caller's -------------------------------------------------------------------------------------------

/// Features as C++ reads them; `status` says whether they can be.
struct View {
  const Storage* storage = nullptr;
  std::size_t values = 0;
  std::vector<Status> statuses;  // copied: bytes of C
  std::vector<ss::KeyPoint> keypoints;
  std::vector<ss::Frame> frames;
  const void* rows = nullptr;
  Status status = Status::bad_rows;

  explicit View(const shortshot_features* from, bool with_places = false) {
    if (!has_size(from) || (from->count > 0 && from->rows == nullptr) || from->reserved != 0) return;
    if (with_places && from->count > 0 && (from->keypoints == nullptr || from->frames == nullptr)) return;
    storage = find(from->descriptor, from->storage);
    status = storage == nullptr ? Status::bad_option : Status::ok;
    if (storage == nullptr) return;
    values = find(from->descriptor)->storages[SHORTSHOT_FLOATS].row_bytes / sizeof(float);
    rows = from->rows;
    statuses.assign(from->count, Status::ok);
    if (from->status != nullptr) copy(from->status, from->count, statuses.data());
    if (!with_places) return;
    keypoints.resize(from->count);
    for (std::size_t i = 0; i < from->count; ++i) keypoints[i] = keypoint_of(from->keypoints[i]);
    frames.resize(from->count);
    copy(from->frames, from->count, frames.data());
  }

  template <class Number>
  [[nodiscard]] const Number* first() const noexcept {
    return static_cast<const Number*>(rows);
  }
  void as(ss::DescriptorRows& to) const { to = {first<float>(), statuses.size(), values, statuses.data()}; }
  void as(ss::HalfRows& to) const { to = {first<std::uint16_t>(), statuses.size(), values, statuses.data()}; }
  void as(ss::BitRows& to) const { to = {first<std::uint8_t>(), statuses.size(), storage->row_bytes, statuses.data()}; }
  template <int Bits>
  void as(ss::CodedRows<Bits>& to) const {
    to = {first<std::uint8_t>(), statuses.size(), storage->row_bytes, storage->step, statuses.data()};
  }
};

/// Calls use() with rows, of nothing yet, in C++'s type for a storage.
template <class Use>
Status with_type_of(shortshot_storage storage, const Use& use) {
  switch (storage) {
    case SHORTSHOT_FLOATS: return use(ss::DescriptorRows{});
    case SHORTSHOT_HALVES: return use(ss::HalfRows{});
    case SHORTSHOT_BYTES: return use(ss::CodedRows<8>{});
    case SHORTSHOT_NIBBLES: return use(ss::CodedRows<4>{});
    case SHORTSHOT_OCTALS: return use(ss::CodedRows<3>{});
    default: return use(ss::BitRows{});
  }
}

/// Calls match(rows, rows) with two sets that can be compared.
template <class Match>
shortshot_status match_rows(const shortshot_features* a, const shortshot_features* b, const Match& match) noexcept {
  return guarded([&] {
    const View from(a), to(b);
    if (from.status != Status::ok || to.status != Status::ok)
      return from.status != Status::ok ? from.status : to.status;
    if (from.storage != to.storage) return Status::bad_rows;
    return with_type_of(a->storage, [&](auto from_rows) {
      auto to_rows = from_rows;
      from.as(from_rows);
      to.as(to_rows);
      return match(from_rows, to_rows);
    });
  });
}

/// Calls use(rows with places, layout) with a view that is learned or looked at; halves as the floats they stand for.
template <class Use>
Status with_places(const shortshot_features* features, const Use& use) {
  const View view(features, true);
  if (view.status != Status::ok) return view.status;
  return with_type_of(features->storage, [&](auto rows) {
    view.as(rows);
    if constexpr (std::is_same<decltype(rows), ss::HalfRows>::value) {
      const ss::detail::HalvesAsFloats floats(rows);
      const ss::DescriptorRows wide{floats.values.data(), rows.count, rows.size, rows.status};
      return use(ss::detail::PlacedRows<ss::DescriptorRows>{wide, view.keypoints.data(), view.frames.data()},
                 view.storage->layout());
    } else {
      return use(ss::detail::PlacedRows<decltype(rows)>{rows, view.keypoints.data(), view.frames.data()},
                 view.storage->layout());
    }
  });
}

}  // namespace
