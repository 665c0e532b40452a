// Objects painted in one color: what is left of a descriptor where color tells nothing.
#pragma once

#include <array>
#include <cstdint>

#include "shortshot/cloud/cloud.hpp"
#include "tools/io/rgbd_cloud.hpp"

namespace shortshot_bench::tradeoff {

/// Two places for it, in a camera's coordinates: above and to the right, and to the left.
inline constexpr shortshot::Point lamp_at_right{0.4f, -0.5f, 0.1f};
inline constexpr shortshot::Point lamp_at_left{-0.6f, -0.2f, 0.3f};

struct Paint {
  std::array<double, 3> rgb;  // 0 to 255, under full light
  shortshot::Point lamp;      // in the cloud's own coordinates
  std::uint32_t seed;         // of the noise
};

/// The cloud as if all of its points had one color under a point lamp: Lambert's cosine for 70 % of the light, the rest
/// from everywhere, and noise of 4 in each channel. Points without a normal (within 1 cm, towards the cloud's
/// viewpoint) get the rest alone. Throws std::runtime_error.
RgbdCloud painted(RgbdCloud cloud, const Paint& paint);

}  // namespace shortshot_bench::tradeoff
