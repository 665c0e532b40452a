// shortshot/cloud/normal_source.hpp: where a descriptor's normals come from.
#ifndef SHORTSHOT_CLOUD_NORMAL_SOURCE_HPP
#define SHORTSHOT_CLOUD_NORMAL_SOURCE_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "cloud.hpp"
#include "keypoint.hpp"
#include "point_lanes.hpp"
#include "read.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The normals of a cloud's own channel: the source of NormalCosine. A neighbor whose normal is not finite has none.
struct CloudNormals {
  static constexpr Channel channel = Channel::normals;  ///< of the cloud that it reads
  Float3Channel normals;                                ///< the cloud's
  /// Borrows the channel; one that is not there is missing_normals.
  explicit CloudNormals(const CloudView& cloud) noexcept : normals(cloud.normals) {}
  /// What a signal gets that the caller gives no source to.
  [[nodiscard]] static CloudNormals at(const CloudView& cloud, const KeyPoint&) noexcept { return CloudNormals(cloud); }
  /// ok or missing_normals.
  [[nodiscard]] Status status() const noexcept { return normals.x != nullptr ? Status::ok : Status::missing_normals; }
  /// One register of normals by index.
  [[nodiscard, gnu::always_inline]] extend::PointLanes operator()(const std::uint32_t* index) const noexcept {
    if constexpr (extend::simd::lanes == 1) {
      const Point n = extend::read(normals, *index);
      return {extend::simd::all(n.x), extend::simd::all(n.y), extend::simd::all(n.z)};
    }
    return extend::read_lanes(normals, [index](std::size_t lane) { return std::size_t{index[lane]}; });
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_CLOUD_NORMAL_SOURCE_HPP
