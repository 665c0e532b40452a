// shortshot/batch/features.hpp: rows of descriptors with where and how they were made. Hosted only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../cloud/keypoint.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// What extract() and describe_cloud() give: one row per key point, in their order. Rows only: copying it copies no
/// scratch memory. Keep it from frame to frame and its memory is used again.
///
/// A descriptor that needs no frame has none here either: train() and recognize(), which cast votes from frames, say
/// bad_frame. Give extract() frames of your own then, and it keeps them.
template <class D>
struct Features {
  std::vector<float> values;        ///< size() * D::size, row by row; zeros where the status is not ok
  std::vector<Status> status;       ///< one per key point
  std::vector<KeyPoint> keypoints;  ///< what was described; zeros for an index outside of the cloud
  std::vector<Frame> frames;        ///< of each; zeros where the status is not ok, or if D::needs_frame is false
  std::vector<FrameConfidence> frame_confidence;  ///< how sure each of them is; zeros: not ok, or the caller's frame
  std::vector<std::uint32_t> neighbors;           ///< found within the larger radius, the key point itself included
                                                  ///< (the frame's counts if there is one)

  /// Number of rows.
  [[nodiscard, gnu::always_inline]] std::size_t size() const noexcept { return status.size(); }
  /// Row `row`: D::size values.
  [[nodiscard, gnu::always_inline]] const float* operator[](std::size_t row) const noexcept {
    return values.data() + row * static_cast<std::size_t>(D::size);
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// What a row holds whose status is not ok.
template <class D>
void clear_row(Features<D>& features, std::size_t row) noexcept {
  constexpr auto row_size = static_cast<std::size_t>(D::size);
  features.frames[row] = Frame{};
  features.frame_confidence[row] = FrameConfidence{};
  std::fill_n(features.values.data() + row * row_size, row_size, 0.0f);
}

/// `count` rows without a descriptor, all with one status. Whatever is thrown while memory is asked for, no row of
/// before is left.
template <class D>
void clear_rows(Features<D>& out, std::size_t count, Status status) {
  out.status.clear();
  out.values.assign(count * static_cast<std::size_t>(D::size), 0.0f);
  out.keypoints.assign(count, KeyPoint{});
  out.frames.assign(count, Frame{});
  out.frame_confidence.assign(count, FrameConfidence{});
  out.neighbors.assign(count, 0);
  out.status.assign(count, status);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
