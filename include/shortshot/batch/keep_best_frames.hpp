// shortshot/batch/keep_best_frames.hpp: the key points whose frames are surest, and no others. Hosted only: allocates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../config.hpp"
#include "../frame/frame.hpp"
#include "../status.hpp"
#include "features.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Leave out all but the best share of the rows whose status is ok: those whose frames have most confidence(), of
/// equals the first (all are, if the frames are the caller's or there are none). The others become unsure_frame, and
/// zeros: rows keep their places and their key points, and matching, training and recognition pass over them. It saves
/// their time, and on frames of a room the rows that stay are right more often; elsewhere what it brings is little or
/// nothing: bench/paper/README.md, "Frame confidence". Thin out both clouds of a pair alike, or one of them alone.
///
/// `share`  above 0, at most 1 (bad_option; nothing is changed); the number is rounded to the nearest, and one row
///          stays at least. Called twice with 1/2 it leaves a quarter
///
/// O(rows); allocates 4 bytes a row. The same rows on every machine.
template <class D>
[[nodiscard]] Status keep_best_frames(Features<D>& features, float share) {
  if (!(share > 0.0f && share <= 1.0f)) return Status::bad_option;
  std::vector<std::uint32_t> rows;
  for (std::size_t row = 0; row < features.size(); ++row) {
    if (features.status[row] == Status::ok) rows.push_back(static_cast<std::uint32_t>(row));
  }
  const float wanted = __builtin_roundf(share * static_cast<float>(rows.size()));
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

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
