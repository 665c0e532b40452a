// shortshot/batch/keypoints.hpp: uniform key points, one per occupied voxel. Hosted only: allocates.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../base/unroll.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/keypoint.hpp"
#include "../cloud/point_lanes.hpp"
#include "../cloud/read.hpp"
#include "../cloud/voxel_lanes.hpp"
#include "../config.hpp"
#include "../dispatch/widest.hpp"
#include "../status.hpp"
#include "voxels.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Calls f(voxel's number, squared distance to its center, index) for each valid point, in order.
template <class Function>
[[nodiscard]] inline Status for_each_in_voxel(const CloudView& cloud, float leaf, Function f) {
  const Status usable = validate(cloud);
  if (usable != Status::ok) return usable;
  if (!math::is_finite(leaf) || !(leaf > 0.0f)) return Status::bad_leaf;
  bool any_valid = false;
  float numbers[3][voxel_block];
  float d2[voxel_block];
  for (std::size_t begin = 0; begin < cloud.size; begin += voxel_block) {
    const std::size_t size = place_widest(cloud, leaf, begin, numbers, d2);
    for (std::size_t k = 0; k < size; ++k) {
      if (d2[k] < 0.0f) continue;
      any_valid = true;
      const float number[3] = {numbers[0][k], numbers[1][k], numbers[2][k]};
      f(number, d2[k], static_cast<std::uint32_t>(begin + k));
    }
  }
  return any_valid ? Status::ok : Status::empty_cloud;
}

/// What is added up over the points of a voxel.
struct VoxelSums {
  float place[3] = {};
  std::uint64_t rgb[3] = {};
  float intensities = 0.0f;
  std::uint32_t echoes = 0;  ///< intensities that are numbers

  void add_channels(const CloudView& cloud, std::uint32_t index) noexcept {
    if (has_colors(cloud)) {
      const Rgb c = color(cloud, index);
      rgb[0] += c.r;
      rgb[1] += c.g;
      rgb[2] += c.b;
    }
    const float echo = has_intensities(cloud) ? intensity(cloud, index) : 0.0f;
    if (!math::is_finite(echo)) return;
    intensities += echo;
    ++echoes;
  }

  /// Points of the cloud in one voxel, named by the lower halves of `members`.
  void add_all(const CloudView& cloud, float leaf, const std::uint64_t* members, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; i += simd::lanes) {
      const std::size_t size = count - i < simd::lanes ? count - i : simd::lanes;
      const auto index_at = [&](std::size_t lane) {
        return static_cast<std::uint32_t>(members[i + (lane < size ? lane : 0)]);
      };
      const VoxelLanes voxels = voxels_of(read_lanes(cloud.points, index_at), leaf);
      unroll<3>([&](auto axis) {
        float places[simd::lanes];
        simd::store(places, voxels.place[axis]);
        for (std::size_t lane = 0; lane < size; ++lane) place[axis] += places[lane];
      });
      for (std::size_t lane = 0; lane < size; ++lane) add_channels(cloud, index_at(lane));
    }
  }
};

/// The centroid of a voxel's points, with the means of their colors and of their intensities (the finite ones).
[[nodiscard]] inline KeyPoint centroid_of(const CloudView& cloud, float leaf, const Voxel& voxel,
                                          const VoxelSums& sums) noexcept {
  const std::uint32_t count = voxel.points;
  const auto at = [&](std::size_t axis) {
    return (voxel.number[axis] + sums.place[axis] / static_cast<float>(count)) * leaf;
  };
  const auto mean = [&](std::size_t c) { return static_cast<std::uint8_t>((sums.rgb[c] + count / 2) / count); };
  KeyPoint key(Point{at(0), at(1), at(2)});
  // Beyond the reach of voxel numbers a point stands for itself.
  if (!is_finite(key.position)) return keypoint(cloud, voxel.nearest);
  if (has_colors(cloud)) key = KeyPoint(key.position, {mean(0), mean(1), mean(2)});
  key.has_intensity = has_intensities(cloud) && sums.echoes > 0;
  if (key.has_intensity) key.intensity = sums.intensities / static_cast<float>(sums.echoes);
  return key;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Chooses key points of clouds, one for each voxel of `leaf` meters that holds a valid point; voxels lie on a grid
/// through the origin. Keep it from frame to frame: what it allocated for one frame it has for the next. One thread at
/// a time; a pass over the points takes less than starting others would.
class KeypointSampler {
 public:
  /// The point nearest to each voxel's center (the one with the smaller index if two are as near). `keypoints` receives
  /// indices into the cloud in ascending order. Statuses: empty_cloud (also if no point is valid), bad_view, bad_leaf;
  /// no key points then. Linear in the points; allocates 40 bytes a voxel and a bit a point, none if it has had as much
  /// before; the same result on every machine.
  [[nodiscard]] Status sample_uniform(const CloudView& cloud, float leaf, std::vector<std::uint32_t>& keypoints) {
    keypoints.clear();
    table_.clear();
    const Status status = detail::for_each_in_voxel(
        cloud, leaf, [this](const float(&number)[3], float d2, std::uint32_t index) { table_.add(number, d2, index); });
    if (status != Status::ok) return status;
    chosen_.assign((cloud.size + 63) / 64, 0u);
    for (const detail::Voxel& voxel : table_.voxels()) chosen_[voxel.nearest / 64] |= bit_of(voxel.nearest);
    keypoints.reserve(table_.voxels().size());
    for (std::size_t word = 0; word < chosen_.size(); ++word) {
      for (std::uint64_t left = chosen_[word]; left != 0; left &= left - 1)
        keypoints.push_back(static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(__builtin_ctzll(left)));
    }
    return Status::ok;
  }

  /// The same with the centroid, the mean color and the mean intensity (of what the cloud has) of each voxel's points:
  /// less noise than any one of them has, which pays most where the key point's color is what color distances refer
  /// to. Voxels by z, then y, then x. Allocates 20 bytes a point besides.
  [[nodiscard]] Status sample_centroids(const CloudView& cloud, float leaf, std::vector<KeyPoint>& keypoints) {
    keypoints.clear();
    table_.clear();
    voxel_of_.clear();
    member_.clear();
    const Status status =
        detail::for_each_in_voxel(cloud, leaf, [this](const float(&number)[3], float d2, std::uint32_t index) {
          voxel_of_.push_back(table_.add(number, d2, index));
          member_.push_back(std::uint64_t{detail::math::bits_of(d2)} << 32 | index);
        });
    if (status != Status::ok) return status;
    sort_members();
    const std::vector<detail::Voxel>& voxels = table_.voxels();
    keypoints.reserve(voxels.size());
    for (const std::uint32_t v : order_) {
      detail::VoxelSums sums;
      sums.add_all(cloud, leaf, sorted_.data() + first_[v], voxels[v].points);
      keypoints.push_back(detail::centroid_of(cloud, leaf, voxels[v], sums));
    }
    return Status::ok;
  }

 private:
  [[nodiscard]] static std::uint64_t bit_of(std::uint32_t index) noexcept { return std::uint64_t{1} << index % 64; }

  /// Members voxel after voxel, in each the one nearest to its center first: sums of floats have one order, whatever
  /// that of the points. And the order of the voxels.
  void sort_members() {
    const std::vector<detail::Voxel>& voxels = table_.voxels();
    first_.resize(voxels.size());
    order_.resize(voxels.size());
    std::uint32_t end = 0;
    for (std::size_t v = 0; v < voxels.size(); ++v) {
      first_[v] = end;
      end += voxels[v].points;
      order_[v] = static_cast<std::uint32_t>(v);
    }
    sorted_.resize(member_.size());
    for (std::size_t k = 0; k < member_.size(); ++k) sorted_[first_[voxel_of_[k]]++] = member_[k];
    for (std::size_t v = 0; v < voxels.size(); ++v) {
      std::uint64_t* const past = sorted_.data() + first_[v];
      first_[v] -= voxels[v].points;
      std::sort(sorted_.data() + first_[v], past);
    }
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      for (std::size_t axis = 3; axis-- > 0;) {
        if (voxels[a].number[axis] != voxels[b].number[axis]) return voxels[a].number[axis] < voxels[b].number[axis];
      }
      return false;
    });
  }

  detail::VoxelTable table_;
  std::vector<std::uint64_t> chosen_;    // a bit for each point
  std::vector<std::uint32_t> voxel_of_;  // of each valid point
  std::vector<std::uint64_t> member_;    // squared distance to the center, which orders as its bits do, and index
  std::vector<std::uint64_t> sorted_;
  std::vector<std::uint32_t> first_, order_;  // of voxels: their first member, and their order by z, y, x
};

/// KeypointSampler::sample_uniform() for one cloud.
[[nodiscard]] inline Status sample_uniform(const CloudView& cloud, float leaf, std::vector<std::uint32_t>& keypoints) {
  return KeypointSampler().sample_uniform(cloud, leaf, keypoints);
}

/// KeypointSampler::sample_centroids() for one cloud.
[[nodiscard]] inline Status sample_centroids(const CloudView& cloud, float leaf, std::vector<KeyPoint>& keypoints) {
  return KeypointSampler().sample_centroids(cloud, leaf, keypoints);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
