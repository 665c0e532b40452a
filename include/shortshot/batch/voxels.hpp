// shortshot/batch/voxels.hpp: the voxels of a cloud, numbered in one pass. Hosted only: allocates.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../base/math.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A voxel that holds points, and which of them is nearest to its center.
struct Voxel {
  float number[3];
  float d2;
  std::uint32_t nearest;
  std::uint32_t points;
};

/// Voxels in the order in which their first points come. Memory is kept from cloud to cloud.
class VoxelTable {
 public:
  void clear() {
    voxels_.clear();
    if (slots_.empty()) slots_.resize(std::size_t{1} << (64 - shift_));
    std::fill(slots_.begin(), slots_.end(), 0u);
    last_ = 0;
  }

  [[nodiscard]] const std::vector<Voxel>& voxels() const noexcept { return voxels_; }

  /// The place, among voxels(), of a point's voxel, with the point in it. Points come in the order of their indices.
  std::uint32_t add(const float (&number)[3], float d2, std::uint32_t index) {
    if (voxels_.empty() || !is_at(voxels_[last_], number)) last_ = find(number);
    Voxel& voxel = voxels_[last_];
    ++voxel.points;
    if (d2 < voxel.d2) {
      voxel.d2 = d2;
      voxel.nearest = index;
    }
    return last_;
  }

 private:
  [[nodiscard]] static bool is_at(const Voxel& voxel, const float (&number)[3]) noexcept {
    return voxel.number[0] == number[0] && voxel.number[1] == number[1] && voxel.number[2] == number[2];
  }

  /// The slot that has a voxel, or the free one for it. Odd factors of 64 bits for each axis: the upper bits of the sum
  /// depend on all bits of the numbers.
  [[nodiscard]] std::size_t slot_of(const float (&number)[3]) const noexcept {
    const std::uint64_t sum = math::bits_of(number[0]) * std::uint64_t{0x9E3779B97F4A7C15} +
                              math::bits_of(number[1]) * std::uint64_t{0xC2B2AE3D27D4EB4F} +
                              math::bits_of(number[2]) * std::uint64_t{0x165667B19E3779F9};
    auto slot = static_cast<std::size_t>(sum >> shift_);
    while (slots_[slot] != 0 && !is_at(voxels_[slots_[slot] - 1], number)) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  [[nodiscard]] std::uint32_t find(const float (&number)[3]) {
    const std::size_t slot = slot_of(number);
    if (slots_[slot] != 0) return slots_[slot] - 1;
    const auto place = static_cast<std::uint32_t>(voxels_.size());
    voxels_.push_back({{number[0], number[1], number[2]}, HUGE_VALF, 0, 0});
    slots_[slot] = place + 1;
    if (2 * voxels_.size() > slots_.size()) grow();
    return place;
  }

  void grow() {
    std::vector<std::uint32_t> slots(2 * slots_.size());
    slots_.swap(slots);
    --shift_;
    for (std::size_t k = 0; k < voxels_.size(); ++k)
      slots_[slot_of(voxels_[k].number)] = static_cast<std::uint32_t>(k + 1);
  }

  std::vector<Voxel> voxels_;
  std::vector<std::uint32_t> slots_;  // a power of two of them, half of them empty or more: place + 1 in voxels_, or 0
  int shift_ = 54;                    // 64 - log2 of their number
  std::uint32_t last_ = 0;            // neighbors in the cloud mostly share a voxel
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
