// shortshot/frame/fixed_lamp_frame.hpp: frames whose x axis points to where a surface is brighter. A function of its
// own: who does not call it has no byte of it.
#pragma once

#include <cstdint>

#include "../base/fixed_point.hpp"
#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../color/color_source.hpp"
#include "../config.hpp"
#include "../search/neighborhood.hpp"
#include "../search/radius.hpp"
#include "../status.hpp"
#include "frame.hpp"
#include "viewpoint.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Sums over the members, as integers: of weights w = 1 - |v| / R, of w L, and of both times 4 v / R (so that no term
/// is above the scale), with L from 0 to 1.
struct BrightnessSums {
  float weight, light;
  float offset[3], light_offset[3];
};

template <class Neighbors, class Colors>
[[nodiscard]] inline BrightnessSums brightness_sums(const Neighbors& n, const Colors& colors, Radius radius) noexcept {
  using simd::all;
  using simd::F32;
  const F32 zero = all(0.0f);
  const F32 inverse = all(1.0f / radius.value);
  const F32 scale = all(fixed_point_scale(n.size));
  simd::I32 weights{}, lights{}, offsets[3] = {}, light_offsets[3] = {};
  for (std::uint32_t i = 0; i < n.size; i += simd::lanes) {
    const NeighborLanes v = load_neighbors(n, i);
    std::uint32_t index[simd::lanes];
    simd::store(index, v.index);
    const F32 own = extend::colors_at(colors, index).L;
    const F32 light = simd::max(simd::min(own, all(100.0f)), zero) * all(0.01f);
    const simd::Mask member = within(v, radius) & (simd::abs(v.dx) + simd::abs(v.dy) + simd::abs(v.dz) > zero);
    const F32 weight = keep(member, (all(1.0f) - simd::sqrt(v.d2) * inverse) * scale);
    weights = weights + round_to_int(weight);
    lights = lights + round_to_int(weight * light);
    const F32 at[3] = {v.dx, v.dy, v.dz};
    each<3>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
      const F32 weighted = weight * (at[k] * inverse * all(4.0f));
      offsets[k] = offsets[k] + round_to_int(weighted);
      light_offsets[k] = light_offsets[k] + round_to_int(weighted * light);
    });
  }
  BrightnessSums sums{static_cast<float>(sum(weights)), static_cast<float>(sum(lights)), {}, {}};
  each<3>([&](auto k) {
    sums.offset[k] = static_cast<float>(sum(offsets[k]));
    sums.light_offset[k] = static_cast<float>(sum(light_offsets[k]));
  });
  return sums;
}

/// Turns x and y of a frame about z, until x points to where it is brighter; if that is nowhere, they stay.
template <class Neighbors, class Colors>
inline void turn_to_brightness(const Neighbors& n, const Colors& colors, Radius radius, Frame& frame) noexcept {
  const BrightnessSums sums = brightness_sums(n, colors, radius);
  if (!(sums.weight > 0.0f)) return;
  const float mean = sums.light / sums.weight;
  float gradient[3], tangent[3];
  for (int k = 0; k < 3; ++k) gradient[k] = sums.light_offset[k] - unfused(mean * sums.offset[k]);
  const float upwards = dot(gradient, frame.z);
  for (int k = 0; k < 3; ++k) tangent[k] = gradient[k] - unfused(upwards * frame.z[k]);

  // What the rounding of the members to integers may have made of no gradient; and of one straight along z.
  const float resolution = unfused(8.0f * static_cast<float>(n.size));
  const float length = simd::sqrt(dot(tangent, tangent));
  if (!(length > resolution + unfused(1e-3f * simd::sqrt(dot(gradient, gradient))))) return;
  for (int k = 0; k < 3; ++k) frame.x[k] = tangent[k] / length;
  set_y(frame);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A local reference frame for things that stay under their lamp: z is that of estimate_frame(), x points to where the
/// surface is brighter, y = z cross x. **A lamp that moves turns it**, and so do shadows. Where two views of an object
/// have the same light it is found again more often than SHOT's frame, whose x follows the shape alone; in rooms, and
/// for recognition, less often. (In a study with the means of 8 cells' colors, 80 of 100 key points were found again
/// under the same lamp, and 57 after it had moved.) Its brightness is CIELAB's L: a gain of all channels changes
/// little.
///
/// x is the projection on the tangent plane, of length 1, of the sum of (R - |v|) (L - mean L) v over the members,
/// where the mean has the weights R - |v| too. If that is 0 but for rounding (all colors are equal, or the gradient is
/// along z), x and y are those of estimate_frame().
///
/// `colors`     of the neighbors by index: RgbColors, LabColors, PackedColors or what else gives a Lab; the reference
///              is not looked at
/// `radius`     the frame's own; it may be smaller than the one the neighborhood was gathered with
/// `viewpoint`  turns z; compact descriptors want one
///
/// Statuses: missing_colors, and those of estimate_frame(); `frame` is zeroed then. No allocation, reentrant. The
/// result does not depend on the order of the neighbors, and has the same bits on every machine. describe() and
/// describe_at() take the frame, extract() one for each key point: "How to add a frame" in include/shortshot/README.md
/// has the loop.
template <class Neighbors, class Colors>
[[nodiscard]] inline Status estimate_frame_under_fixed_lamp(const Neighbors& n, const Colors& colors, Radius radius,
                                                            Frame& frame, const Viewpoint& viewpoint = {}) noexcept {
  frame = Frame{};
  Status status = colors.status();
  if (status == Status::ok) status = estimate_frame(n, radius, frame, viewpoint);
  if (status == Status::ok) detail::turn_to_brightness(n, colors, radius, frame);
  return status;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot
