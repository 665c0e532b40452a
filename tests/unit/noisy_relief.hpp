// A surface of hills, scanned with noise as often as you like: what is found on one scan can be checked on the next.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fixtures.hpp"

namespace unit {

/// 30 cm by 30 cm; eight waves 4 to 16 cm long, as high as a tenth of their length.
class NoisyRelief {
 public:
  explicit NoisyRelief(std::uint32_t seed) : seed_(seed) {
    Random random(seed);
    for (Wave& wave : waves_) {
      const float length = random.between(0.04f, 0.16f);
      const float direction = random.between(0.0f, two_pi);
      wave = {two_pi / length * std::cos(direction), two_pi / length * std::sin(direction),
              random.between(0.0f, two_pi), 0.06f * length};
    }
  }

  [[nodiscard]] ss::Point at(float x, float y) const {
    float z = 0.0f;
    for (const Wave& wave : waves_) z += wave.height * std::sin(wave.x * x + wave.y * y + wave.phase);
    return {x, y, z};
  }

  /// One point at random in each square of 3 mm, about 1 mm off.
  [[nodiscard]] TestCloud scan(std::uint32_t number) const {
    Random random(1000 * seed_ + number);
    TestCloud cloud;
    for (int i = 0; i < 100; ++i) {
      for (int k = 0; k < 100; ++k) {
        const float x = 0.003f * (static_cast<float>(i) + random.between(0.0f, 1.0f));
        const float y = 0.003f * (static_cast<float>(k) + random.between(0.0f, 1.0f));
        const ss::Point p = at(x, y);
        float noise = 0.0f;  // a sum of four is close to a normal distribution
        for (int part = 0; part < 4; ++part) noise += random.between(-0.00087f, 0.00087f);
        cloud.add(p.x, p.y, p.z + noise);
      }
    }
    return cloud;
  }

 private:
  static constexpr float two_pi = 6.2831853f;
  struct Wave {
    float x, y, phase, height;
  };
  std::uint32_t seed_;
  Wave waves_[8];
};

}  // namespace unit
