// What the board, and the host that prepares its model, must have in common.
#pragma once

#include <cstddef>

#if __has_include("shortshot.hpp")
#include "shortshot.hpp"  // the board's only header
#else
#include "shortshot/shortshot.hpp"
#endif

namespace recognition {

using Descriptor = shortshot::ShapeColor95;
using Stored = shortshot::SumBits<Descriptor>;

inline constexpr float radius = 0.025f;
inline constexpr std::size_t keypoints = 100;  // of a view that is asked for, at the most

/// Turns frames towards the camera, which is the origin.
inline shortshot::Support support() {
  shortshot::Support of_radius = radius;
  of_radius.viewpoint = shortshot::Viewpoint::towards({});
  return of_radius;
}

/// Calls use(index) for `most` of the points, or fewer: evenly along their order.
template <class Use>
void for_keypoints(std::size_t points, std::size_t most, const Use& use) {
  const std::size_t stride = (points + most - 1) / most;
  for (std::size_t i = stride / 2; i < points; i += stride) use(i);
}

}  // namespace recognition
