// shortshot/cloud/normal_source.hpp: where a descriptor's normals come from.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "cloud.hpp"

namespace shortshot {
inline namespace SHORTSHOT_ISA {

/// The normals of a cloud's own channel: what a NormalCosine looks at. A neighbor whose normal is not finite has none.
struct CloudNormals {
  Float3Channel normals;  ///< the cloud's
  explicit CloudNormals(const CloudView& cloud) noexcept : normals(cloud.normals) {}
  [[nodiscard]] Status status() const noexcept { return normals.x != nullptr ? Status::ok : Status::missing_normals; }
  /// One register of normals by index.
  [[nodiscard, gnu::always_inline]] PointLanes operator()(const std::uint32_t* index) const noexcept {
    if constexpr (simd::lanes == 1) {
      const Point n = read(normals, *index);
      return {simd::all(n.x), simd::all(n.y), simd::all(n.z)};
    }
    return read_lanes(normals, [index](std::size_t lane) { return std::size_t{index[lane]}; });
  }
};

/// For descriptors without normals.
struct NoNormals {
  [[nodiscard]] static Status status() noexcept { return Status::ok; }
};

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
