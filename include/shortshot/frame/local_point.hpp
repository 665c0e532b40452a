// shortshot/frame/local_point.hpp: a point as a frame sees it.
#pragma once

#include "../base/unfused.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "frame.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A point in a frame's coordinates, and back.
[[nodiscard]] inline Point to_local(const Point& p, const Point& origin, const Frame& frame) noexcept {
  const float offset[3] = {p.x - origin.x, p.y - origin.y, p.z - origin.z};
  return {dot(frame.x, offset), dot(frame.y, offset), dot(frame.z, offset)};
}
[[nodiscard]] inline Point from_local(const Point& p, const Point& origin, const Frame& frame) noexcept {
  const auto component = [&](int k) {
    return (unfused(p.x * frame.x[k]) + unfused(p.y * frame.y[k])) + unfused(p.z * frame.z[k]);
  };
  return {origin.x + component(0), origin.y + component(1), origin.z + component(2)};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail
