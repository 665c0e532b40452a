// shortshot/color/packed_lab.hpp: a CIELAB color in 32 bits, for arrays with one color per point.
#ifndef SHORTSHOT_COLOR_PACKED_LAB_HPP
#define SHORTSHOT_COLOR_PACKED_LAB_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../config.hpp"
#include "lab.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// A third of Lab's memory. L has 11 bits, a has 10 and b has 11, in steps that just cover what sRGB colors have (L
/// 0..100, a -86.3..98.3, b -108..94.6; anything else, as PclLab's white, is clamped to about that). 0 and 100 of L and
/// 0 of a and b are exact.
///
/// The color distance between an exact Lab and an sRGB color that went through here is wrong by at most 2.9e-4 of its
/// range 0..1 (half a step in each: 0.05 / 600 + 0.1875 / 1440 + 0.1015625 / 1440). In the generated scene (4 cm
/// radius) SCSH-336 differs by an L2 distance of 0.001 on average and 0.016 at most, SCSH-696 by 0.003 and 0.027.
/// Trivial type.
class PackedLab {
 public:
  PackedLab() = default;
  /// The nearest color that 4 bytes have.
  PackedLab(const Lab& color) noexcept  // NOLINT: converts like a number
      : bits_(code(extend::unfused(color.L * 20.0f), 2000.0f) |
              code(extend::unfused((color.a + 90.0f) * (1.0f / a_step)), 1023.0f) << 11 |
              code(extend::unfused((color.b + 108.875f) * (1.0f / b_step)), 2047.0f) << 21) {}

  /// Back, within half a step.
  operator Lab() const noexcept {  // NOLINT: converts like a number
    return {extend::unfused(static_cast<float>(bits_ & 2047u) * 0.05f),
            extend::unfused(static_cast<float>(bits_ >> 11 & 1023u) * a_step) - 90.0f,
            extend::unfused(static_cast<float>(bits_ >> 21) * b_step) - 108.875f};
  }

  /// The colors at lab[index[k]], for all lanes: what operator Lab gives.
  [[nodiscard]] static extend::LabLanes at(const PackedLab* lab, const std::uint32_t* index) noexcept {
    using extend::simd::all;
    using extend::simd::all_int;
    std::uint32_t packed[extend::simd::lanes];
    for (std::size_t k = 0; k < extend::simd::lanes; ++k) packed[k] = lab[index[k]].bits_;
    const extend::simd::I32 bits = extend::simd::load(packed);
    return {to_float(bits & all_int(2047)) * all(0.05f),
            to_float(shift_right(bits, 11) & all_int(1023)) * all(a_step) - all(90.0f),
            to_float(shift_right(bits, 21) & all_int(2047)) * all(b_step) - all(108.875f)};
  }

 private:
  static constexpr float a_step = 0.1875f;     // -90 is -480 steps
  static constexpr float b_step = 0.1015625f;  // -108.875 is -1072 steps

  /// The nearest of 0..last; 0 for NaN.
  [[nodiscard]] static std::uint32_t code(float steps, float last) noexcept {
    const float positive = steps > 0.0f ? steps : 0.0f;
    const float border = 0.5f + (positive < last ? positive : last);
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(border));
  }

  std::uint32_t bits_;
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_COLOR_PACKED_LAB_HPP
