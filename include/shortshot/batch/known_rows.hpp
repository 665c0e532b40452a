// shortshot/batch/known_rows.hpp: rows of key points that lie on top of each other, to be computed once. Hosted only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "../cloud/keypoint.hpp"
#include "../config.hpp"
#include "features.hpp"
#include "known_normals.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

[[nodiscard]] inline bool are_same(const KeyPoint& a, const KeyPoint& b) noexcept {
  return a.position.x == b.position.x && a.position.y == b.position.y && a.position.z == b.position.z &&
         a.intensity == b.intensity && a.color.r == b.color.r && a.color.g == b.color.g && a.color.b == b.color.b &&
         a.has_color == b.has_color && a.has_intensity == b.has_intensity;
}

/// The rows of the last few crowded key points of one thread in one call; see KnownNormals.
class KnownRows {
 public:
  /// An earlier row of the same key point, or `row` if none is known.
  template <class D>
  [[nodiscard]] std::size_t find(const Features<D>& features, std::size_t row) const noexcept {
    const KeyPoint& key = features.keypoints[row];
    const std::size_t known = rows_[slot_of_place(key.position)];
    return known != 0 && are_same(features.keypoints[known - 1], key) ? known - 1 : row;
  }

  template <class D>
  void keep(const Features<D>& features, std::size_t row) noexcept {
    if (features.neighbors[row] < KnownNormals::crowd) return;
    rows_[slot_of_place(features.keypoints[row].position)] = row + 1;
  }

 private:
  std::array<std::size_t, place_slots> rows_{};  // 1 more than the number of a row; 0: none
};

/// All of a row but its key point.
template <class D>
void copy_row(Features<D>& features, std::size_t from, std::size_t to) noexcept {
  float* const values = features.values.data();
  std::memcpy(values + to * std::size_t{D::size}, values + from * std::size_t{D::size}, D::size_bytes);
  features.status[to] = features.status[from];
  features.frames[to] = features.frames[from];
  features.frame_confidence[to] = features.frame_confidence[from];
  features.neighbors[to] = features.neighbors[from];
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
