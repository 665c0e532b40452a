// shortshot/store/stored_features.hpp: what extract() gives with its descriptors stored smaller, in memory and in
// files. Hosted only: allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "../batch/describe_cloud.hpp"
#include "../batch/features.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "../descriptor/layout_of.hpp"
#include "../status.hpp"
#include "features_file.hpp"
#include "storage.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Features with descriptors in a storage: HalfDescriptor, CodedDescriptor (bytes, nibbles), BinaryDescriptor or
/// SumBits of a D. One row per key point, in the order of the features that they were made of.
template <class Stored>
struct StoredFeatures {
  std::vector<Stored> descriptors;                ///< of zeros where the status is not ok
  std::vector<Status> status;                     ///< the others as Features have them
  std::vector<KeyPoint> keypoints;                ///< what was described
  std::vector<Frame> frames;                      ///< of each
  std::vector<FrameConfidence> frame_confidence;  ///< how sure each of them is
  std::vector<std::uint32_t> neighbors;           ///< found within the larger radius

  /// Number of rows.
  [[nodiscard, gnu::always_inline]] std::size_t size() const noexcept { return status.size(); }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Descriptors as the numbers that they are made of.
template <class Stored>
inline constexpr std::size_t stored_values = sizeof(Stored) / sizeof(typename Storage<Stored>::Value);

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The layout of the descriptor and how it is stored, with all that belongs to it (bits, steps, groups): what two
/// files, or two rows, must have in common. Allocates.
template <class Stored>
[[nodiscard]] std::string storage_layout() {
  detail::StringText text;
  detail::add_storage_layout<Stored>(text);
  return text.string;
}

/// Features in a storage. Rows whose status is not ok are of zeros. ok or bad_rows (vectors that are not as long as
/// each other); `out` is empty then. Allocates `out`. Reentrant.
template <class D, class Stored>
[[nodiscard]] Status store(const Features<D>& features, StoredFeatures<Stored>& out) {
  static_assert(std::is_same<typename detail::Storage<Stored>::Descriptor, D>::value,
                "store() supports storages of the descriptor that the features are of");
  out = StoredFeatures<Stored>{};
  if (features.values.size() != features.size() * std::size_t{D::size}) return Status::bad_rows;
  out.descriptors.resize(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) detail::Storage<Stored>::make(features[i], out.descriptors[i]);
  out.keypoints = features.keypoints;
  out.frames = features.frames;
  out.frame_confidence = features.frame_confidence;
  out.neighbors = features.neighbors;
  out.status = features.status;  // last: whatever is thrown before, there is no row
  return Status::ok;
}

/// A whole cloud's descriptors in a storage: describe_cloud(), then store(). Statuses as of describe_cloud(). Allocates
/// the features in floats, too, for as long as it lasts.
template <class Stored>
[[nodiscard]] Status describe_cloud(const CloudView& cloud, const CloudOptions& options, StoredFeatures<Stored>& out) {
  Features<typename detail::Storage<Stored>::Descriptor> features;
  const Status status = describe_cloud(cloud, options, features);
  const Status stored = store(features, out);
  return status != Status::ok ? status : stored;
}

/// As features are saved: the same bytes on every machine, and so many for a row as the storage has, and 73 more. The
/// file says storage_layout<Stored>().
///
/// Statuses: bad_rows (vectors that are not as long as each other; halves, frames or confidences that are not finite);
/// `bytes` is empty then. Allocates the bytes, and the descriptors once more. Reentrant.
template <class Stored>
[[nodiscard]] Status save(const StoredFeatures<Stored>& features, std::vector<std::uint8_t>& bytes) {
  using Value = typename detail::Storage<Stored>::Value;
  using Columns = detail::ColumnsToSave<Value>;
  constexpr std::size_t row_size = detail::stored_values<Stored>;
  std::vector<Value> values(features.descriptors.size() * row_size);
  if (!values.empty()) std::memcpy(values.data(), features.descriptors.data(), values.size() * sizeof(Value));
  const std::string layout = storage_layout<Stored>();
  const auto& const_values = values;
  return detail::save_columns(detail::columns_of<Columns>(features, const_values, layout, row_size), bytes);
}

/// What save() made these bytes of. Statuses as for features: those of another descriptor, of another storage or scale,
/// or of floats are other_descriptor. `out` has not changed if it is not ok.
template <class Stored>
[[nodiscard]] Status load(const std::uint8_t* bytes, std::size_t size, StoredFeatures<Stored>& out) {
  using Value = typename detail::Storage<Stored>::Value;
  using Columns = detail::ColumnsToLoad<Value>;
  constexpr std::size_t row_size = detail::stored_values<Stored>;
  StoredFeatures<Stored> loaded;
  std::vector<Value> values;
  const std::string layout = storage_layout<Stored>();
  const Status status =
      detail::load_columns(bytes, size, detail::columns_of<Columns>(loaded, values, layout, row_size));
  if (status != Status::ok) return status;
  loaded.descriptors.resize(loaded.size());
  if (!values.empty()) std::memcpy(loaded.descriptors.data(), values.data(), values.size() * sizeof(Value));
  out = std::move(loaded);
  return Status::ok;
}

/// The same in a file: also no_file, as for features.
template <class Stored>
[[nodiscard]] Status save(const StoredFeatures<Stored>& features, const std::string& path) {
  std::vector<std::uint8_t> bytes;
  const Status status = save(features, bytes);
  return status == Status::ok ? detail::replace_file(path, bytes) : status;
}
template <class Stored>
[[nodiscard]] Status load(const std::string& path, StoredFeatures<Stored>& out) {
  std::vector<std::uint8_t> bytes;
  const Status status = detail::read_file(path, bytes);
  return status == Status::ok ? load(bytes.data(), bytes.size(), out) : status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
