// shortshot/batch/features.hpp: what extract() gives, with the memory that it uses again for the next cloud. Hosted
// only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "../color/lab.hpp"
#include "../color/lab_table.hpp"
#include "../color/packed_lab.hpp"
#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../search/neighborhood.hpp"
#include "../status.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {
namespace detail {

/// A workspace that grows: one per thread.
class GrowingWorkspace {
 public:
  [[nodiscard]] Neighborhood neighborhood() noexcept {
    const std::size_t n = index_.size();
    float* p = floats_.data();
    return {p, p + n, p + 2 * n, p + 3 * n, index_.data(), static_cast<std::uint32_t>(n), 0, 0};
  }

  /// A search's gather(); grows until the neighbors fit.
  template <class Search>
  [[nodiscard]] Status gather(const Search& search, const Point& center, Radius radius, Neighborhood& n) {
    n = neighborhood();
    const Status status = search.gather(center, radius, n);
    if (status != Status::too_many_neighbors || n.found > max_neighbors) return status;
    reserve(n.found);
    n = neighborhood();
    return search.gather(center, radius, n);
  }

  /// Room for `neighbors`; half as much again where it has to grow, so that it seldom does.
  void reserve(std::size_t neighbors) {
    if (neighbors <= index_.size()) return;
    const std::size_t capacity = neighbors + neighbors / 2;
    floats_.resize(4 * capacity);
    index_.resize(capacity);
  }

 private:
  std::vector<float> floats_;
  std::vector<std::uint32_t> index_;
};

}  // namespace detail

/// What extract() gives: one row per key point, in their order. Keep it from frame to frame and its memory is reused.
/// `Color` is how a cloud's colors are kept meanwhile: Lab, 12 bytes a point, or PackedLab, 4 bytes a point and less
/// exact.
template <class D, class Color = Lab>
struct Features {
  static_assert(std::is_same<Color, Lab>::value || std::is_same<Color, PackedLab>::value,
                "Features<D, Color> supports Lab and PackedLab");

  std::vector<float> values;   ///< size() * D::size, row by row; zeros where the status is not ok
  std::vector<Status> status;  ///< one per key point
  std::vector<Frame> frames;   ///< the local reference frame of each; zeros where the status is not ok
  std::vector<FrameConfidence> frame_confidence;  ///< how sure each of them is; zeros where the status is not ok
  std::vector<std::uint32_t> neighbors;           ///< found within the larger radius, the key point itself included

  [[nodiscard]] std::size_t size() const noexcept { return status.size(); }
  [[nodiscard]] const float* operator[](std::size_t row) const noexcept {
    return values.data() + row * static_cast<std::size_t>(D::size);
  }

  struct {
    LabTable<typename D::LabRule> to_lab;
    std::vector<Color> lab;                            // the cloud's colors
    std::vector<detail::GrowingWorkspace> workspaces;  // one per thread
    std::size_t leveled_for = 0;                       // neighbors that each of them has had room made for
  } scratch;                                           ///< extract()'s own; nothing to read there
};

namespace detail {

/// What a row holds whose status is not ok.
template <class D, class Color>
void clear_row(Features<D, Color>& features, std::size_t row) noexcept {
  constexpr auto row_size = static_cast<std::size_t>(D::size);
  features.frames[row] = Frame{};
  features.frame_confidence[row] = FrameConfidence{};
  std::fill_n(features.values.data() + row * row_size, row_size, 0.0f);
}

}  // namespace detail

/// Leave out all but the best share of the rows whose status is ok: those whose frames have most confidence(), of
/// equals the first. The others become unsure_frame, and zeros: rows keep their places and their key points, and
/// matching, training and recognition pass over them. It saves their time, and on frames of a room the rows that stay
/// are right more often; elsewhere what it brings is little or nothing: bench/paper/README.md, "Frame confidence".
/// Thin out both clouds of a pair alike, or one of them alone.
///
/// `share`  above 0, at most 1 (bad_option; nothing is changed); the number is rounded to the nearest, and one row
///          stays at least. Called twice with 1/2 it leaves a quarter
///
/// O(rows); allocates 4 bytes a row. The same rows on every machine.
template <class D, class Color>
[[nodiscard]] Status keep_best_frames(Features<D, Color>& features, float share) {
  if (!(share > 0.0f && share <= 1.0f)) return Status::bad_option;
  std::vector<std::uint32_t> rows;
  for (std::size_t row = 0; row < features.size(); ++row) {
    if (features.status[row] == Status::ok) rows.push_back(static_cast<std::uint32_t>(row));
  }
  const float wanted = std::round(share * static_cast<float>(rows.size()));
  const auto kept = std::max<std::size_t>(1, static_cast<std::size_t>(wanted));
  if (share == 1.0f || kept >= rows.size()) return Status::ok;
  const auto end = rows.begin() + static_cast<std::ptrdiff_t>(kept);
  std::nth_element(rows.begin(), end, rows.end(), [&](std::uint32_t a, std::uint32_t b) {
    const float of_a = confidence(features.frame_confidence[a]);
    const float of_b = confidence(features.frame_confidence[b]);
    return of_a != of_b ? of_a > of_b : a < b;
  });
  for (auto row = end; row != rows.end(); ++row) {
    features.status[*row] = Status::unsure_frame;
    detail::clear_row(features, *row);
  }
  return Status::ok;
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
