// For the tests of the paper's experiments: colored reliefs, seen from where one likes.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "paper/datasets/rigid_motion.hpp"
#include "tools/io/rgbd_cloud.hpp"
#include "tools/scene/random.hpp"

namespace paper_test {

/// Bumps and stripes, different ones for each object.
struct Relief {
  double bump = 60.0;       // radians per meter
  double height_m = 0.015;  //
  double stripe = 150.0;    // radians per meter
  double contrast = 50.0;   // of 255
};

/// Points of a patch 16 cm wide, half a meter before the camera, then moved. Another seed gives other points.
inline shortshot_bench::RgbdCloud view_of(const Relief& relief, const shortshot_bench::datasets::RigidMotion& motion,
                                          std::uint32_t seed, std::size_t points = 6000) {
  shortshot_bench::Random random(seed);
  shortshot_bench::RgbdCloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const double x = random.uniform(-0.08, 0.08);
    const double y = random.uniform(-0.08, 0.08);
    const double z =
        0.5 + relief.height_m * std::sin(relief.bump * x + 7.0 * y) * std::cos(relief.bump * 0.7 * y * (1.0 + 3.0 * x));
    for (std::size_t row = 0; row < 3; ++row) {
      const double* m = motion.data() + 4 * row;
      cloud.xyz.push_back(static_cast<float>(m[0] * x + m[1] * y + m[2] * z + m[3]));
    }
    const double stripe = std::sin(relief.stripe * (x + 0.4 * y * (1.0 + 4.0 * y)));
    for (const double channel : {1.0, 0.6, 0.3}) {
      cloud.rgb.push_back(static_cast<std::uint8_t>(60.0 + relief.contrast * channel * (1.0 + stripe)));
    }
  }
  cloud.width = points;
  cloud.height = 1;
  return cloud;
}

/// A turn about the patch's middle, in radians about the viewing direction and a little about x, and a step along x.
inline shortshot_bench::datasets::RigidMotion turned(double angle, double step_m = 0.0) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double tilt_c = std::cos(0.3 * angle);
  const double tilt_s = std::sin(0.3 * angle);
  // Rx(tilt) Rz(angle), about (0, 0, 0.5)
  return {c,          -s,         0.0,     step_m,              //
          tilt_c * s, tilt_c * c, -tilt_s, 0.5 * tilt_s,        //
          tilt_s * s, tilt_s * c, tilt_c,  0.5 - 0.5 * tilt_c,  //
          0.0,        0.0,        0.0,     1.0};
}

}  // namespace paper_test
