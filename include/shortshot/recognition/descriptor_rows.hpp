// shortshot/recognition/descriptor_rows.hpp: borrowed rows of descriptors, as matching and recognition take them.
// Hosted only.
#pragma once

#include <cstddef>
#include <vector>

#include "../batch/features.hpp"
#include "../cloud/keypoint.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// `count` descriptors of `size` floats each, row by row without gaps. Borrowed, like everything here.
struct DescriptorRows {
  const float* values;   ///< count * size
  std::size_t count;     ///< number of rows
  std::size_t size;      ///< floats in a row
  const Status* status;  ///< one per row: those that are not ok are left out; null: all are ok
};

/// Descriptors with the places and frames that they were made at.
struct FeatureRows {
  DescriptorRows descriptors;  ///< the rows
  const KeyPoint* keypoints;   ///< one per row
  const Frame* frames;         ///< one per row
};

}  // namespace SHORTSHOT_TYPES
inline namespace SHORTSHOT_CODE {

/// The rows of extract()'s result; the features must outlive them.
template <class D>
[[nodiscard]] DescriptorRows rows_of(const Features<D>& features) noexcept {
  return {features.values.data(), features.size(), static_cast<std::size_t>(D::size), features.status.data()};
}

/// The same with key points and frames.
template <class D>
[[nodiscard]] FeatureRows feature_rows_of(const Features<D>& features) noexcept {
  const bool complete = features.keypoints.size() == features.size() && features.frames.size() == features.size();
  return {rows_of(features), complete ? features.keypoints.data() : nullptr, features.frames.data()};
}

/// Can these rows be used: no null pointer where there are rows, and at least one value in each? ok or bad_rows.
[[nodiscard]] inline Status validate(const DescriptorRows& rows) noexcept {
  return rows.size > 0 && (rows.count == 0 || rows.values != nullptr) ? Status::ok : Status::bad_rows;
}

[[nodiscard]] inline Status validate(const FeatureRows& rows) noexcept {
  const bool complete = rows.descriptors.count == 0 || (rows.keypoints != nullptr && rows.frames != nullptr);
  return complete ? validate(rows.descriptors) : Status::bad_rows;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

template <class Rows>
[[nodiscard]] bool is_ok(const Rows& rows, std::size_t row) noexcept {
  return rows.status == nullptr || rows.status[row] == Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
