// shortshot/recognition/descriptor_rows.hpp: borrowed rows of descriptors, as matching and recognition take them.
// Hosted only.
#pragma once

#include <cstddef>
#include <vector>

#include "../batch/features.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../kernel/describe_at.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {

/// `count` descriptors of `size` floats each, row by row without gaps. Borrowed, like everything here.
struct DescriptorRows {
  const float* values;   ///< count * size
  std::size_t count;     ///< number of rows
  std::size_t size;      ///< floats in a row
  const Status* status;  ///< one per row: those that are not ok are left out; null: all are ok
};

/// Descriptors with the places and frames that they were made at.
struct FeatureRows {
  DescriptorRows descriptors;
  const KeyPoint* keypoints;  ///< one per row
  const Frame* frames;        ///< one per row
};

/// The rows of extract()'s result; the features must outlive them.
template <class D, class Color>
[[nodiscard]] DescriptorRows rows_of(const Features<D, Color>& features) noexcept {
  return {features.values.data(), features.size(), static_cast<std::size_t>(D::size), features.status.data()};
}

/// The same with the key points that extract() was given, of which there must be as many.
template <class D, class Color>
[[nodiscard]] FeatureRows rows_of(const Features<D, Color>& features, const std::vector<KeyPoint>& keypoints) noexcept {
  return {rows_of(features), keypoints.size() == features.size() ? keypoints.data() : nullptr, features.frames.data()};
}

/// Can these rows be used: no null pointer where there are rows, and at least one value in each? ok or bad_rows.
[[nodiscard]] inline Status check(const DescriptorRows& rows) noexcept {
  return rows.size > 0 && (rows.count == 0 || rows.values != nullptr) ? Status::ok : Status::bad_rows;
}

[[nodiscard]] inline Status check(const FeatureRows& rows) noexcept {
  const bool complete = rows.descriptors.count == 0 || (rows.keypoints != nullptr && rows.frames != nullptr);
  return complete ? check(rows.descriptors) : Status::bad_rows;
}

namespace detail {

[[nodiscard]] inline bool is_ok(const DescriptorRows& rows, std::size_t row) noexcept {
  return rows.status == nullptr || rows.status[row] == Status::ok;
}

}  // namespace detail

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
