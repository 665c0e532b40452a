// shortshot/color/lab.hpp: sRGB bytes -> CIELAB, and the color distance of CSHOT and SCSH.
//
// Both existing codes quantize the CIE ratios to 1/4000 and look their cube root up in a table of 4000 entries; here
// the same quantized ratio goes through a computed root, so that 16 KB of tables are not needed and pure white, which
// reads past the end of both tables, is defined (in PclLab, too: as what PCL was seen to read there).
#ifndef SHORTSHOT_COLOR_LAB_HPP
#define SHORTSHOT_COLOR_LAB_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../cloud/cloud.hpp"
#include "../config.hpp"
#include "fixed_power.hpp"
#include "srgb.hpp"

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// CIELAB color: L in 0..100 (-16 for PclLab's white), a and b clamped to -120..120 as both existing codes do.
struct Lab {
  float L, a, b;  ///< lightness; green to red; blue to yellow
};

/// CIELAB as the published SSH / SCSH code computes it: t^0.3333 above the knee, 7.787 t + 16/116 below.
struct PublishedLab {
  static constexpr const char* name = "published Lab";  ///< for layout_of()
  static constexpr bool leaves_gamut = false;           ///< are there sRGB colors beyond -120..120 in a or b?
  /// Of a CIE ratio, 0 to 1.
  [[nodiscard, gnu::always_inline]] static float root(float t) noexcept {
    return t > 0.008856f ? detail::published_root(t) : extend::unfused(7.787f * t) + 16.0f / 116.0f;
  }
};

/// CIELAB by the formula of PCL's CSHOT: the cube root above the knee, 7.87 t + 16/116 below.
struct CshotLab {
  static constexpr const char* name = "CSHOT Lab";
  static constexpr bool leaves_gamut = false;
  [[nodiscard, gnu::always_inline]] static float root(float t) noexcept {
    return t > 0.008856f ? detail::cube_root(t) : extend::unfused(7.87f * t) + 16.0f / 116.0f;
  }
};

/// The same as PCL's compiled code gives it: its table of roots ends before that of 1, where it reads a zero. White,
/// the only color with such a ratio, becomes L = -16, a = 120, b = -120.
struct PclLab {
  static constexpr const char* name = "PCL Lab";
  static constexpr bool leaves_gamut = true;
  [[nodiscard, gnu::always_inline]] static float root(float t) noexcept { return t < 1.0f ? CshotLab::root(t) : 0.0f; }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// A color without sRGB's gamma.
struct LinearRgb {
  float of[3];
};

[[nodiscard]] constexpr LinearRgb to_linear(const Rgb& rgb) noexcept {
  return {{linear_of_srgb(rgb.r), linear_of_srgb(rgb.g), linear_of_srgb(rgb.b)}};
}

/// Linear RGB to CIE XYZ, and the white point.
inline constexpr float xyz_of_rgb[3][3] = {
    {0.412453f, 0.357580f, 0.180423f}, {0.212671f, 0.715160f, 0.072169f}, {0.019334f, 0.119193f, 0.950227f}};
inline constexpr float white_xyz[3] = {0.95047f, 1.0f, 1.08883f};

/// A CIE ratio of a color (0: X / Xn, 1: Y / Yn, 2: Z / Zn) in whole steps of 1 / 4000: the position in the published
/// tables.
[[nodiscard]] constexpr int ratio_step(int ratio, const LinearRgb& rgb) noexcept {
  const float(&row)[3] = xyz_of_rgb[ratio];
  const float sum = unfused(rgb.of[0] * row[0]) + unfused(rgb.of[1] * row[1]) + unfused(rgb.of[2] * row[2]);
  return static_cast<int>(sum / white_xyz[ratio] * 4000.0f);
}

/// The last step that a color can have. The ratios grow with each of the three bytes: no color is beyond white.
inline constexpr int last_ratio_step = 4000;
inline constexpr LinearRgb white = to_linear({255, 255, 255});
static_assert(ratio_step(0, white) <= last_ratio_step && ratio_step(1, white) <= last_ratio_step &&
                  ratio_step(2, white) <= last_ratio_step,
              "white has the largest ratios");

/// The root that `Rule` takes of a ratio of `step` / 4000.
template <class Rule>
[[nodiscard]] inline float root_of_step(int step) noexcept {
  return Rule::root(static_cast<float>(step) / 4000.0f);
}

/// CIELAB of the roots of a color's three ratios. Both existing codes clamp a and b to -120..120 (and L to 100), which
/// is beyond what sRGB colors have but for PclLab's white.
template <class Rule>
[[gnu::always_inline]] inline void lab_of_roots(const float (&f)[3], Lab& lab) noexcept {
  lab = {unfused(116.0f * f[1]) - 16.0f, unfused(500.0f * (f[0] - f[1])), unfused(200.0f * (f[1] - f[2]))};
  if constexpr (Rule::leaves_gamut) {
    const auto clamp = [](float& value) { value = value > 120.0f ? 120.0f : value < -120.0f ? -120.0f : value; };
    clamp(lab.a);
    clamp(lab.b);
  }
}

/// to_lab(), written where it belongs: ARM's compilers copy a returned struct of three floats again and again.
template <class Rule>
inline void put_lab(const Rgb& rgb, Lab& lab) noexcept {
  const LinearRgb linear = to_linear(rgb);
  int steps[3];
  float f[3];
  each<3>([&](auto k) SHORTSHOT_INLINE_LAMBDA { steps[k] = ratio_step(k, linear); });
  each<3>([&](auto k) SHORTSHOT_INLINE_LAMBDA { f[k] = root_of_step<Rule>(steps[k]); });
  lab_of_roots<Rule>(f, lab);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// sRGB bytes to CIELAB by `Rule` (PublishedLab, CshotLab or PclLab). Source: what the published SSH / SCSH code and
/// PCL 1.13 compute; within 1e-4 of either in L, a and b. No allocation, reentrant. LabTable (lab_table.hpp) gives the
/// same bits several times faster, for 16 KB.
template <class Rule>
[[nodiscard]] inline Lab to_lab(const Rgb& rgb) noexcept {
  Lab lab;
  detail::put_lab<Rule>(rgb, lab);
  return lab;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// Lanes of CIELAB colors.
struct LabLanes {
  simd::F32 L, a, b;  ///< of each lane
};

/// The same color in all lanes.
[[nodiscard]] SHORTSHOT_INLINE LabLanes in_all_lanes(const Lab& color) noexcept {
  return {simd::all(color.L), simd::all(color.a), simd::all(color.b)};
}

/// CSHOT's color distance, 0 to 1 for colors that sRGB has: (|dL| / 100 + (|da| / 120 + |db| / 120) / 2) / 3. NaN for
/// somebody else's NaN.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 color_distances(const LabLanes& p, const LabLanes& q) noexcept {
  using simd::all;
  const simd::F32 chroma = simd::abs(p.a - q.a) + simd::abs(p.b - q.b);
  return simd::abs(p.L - q.L) * all(1.0f / 300.0f) + chroma * all(1.0f / 720.0f);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The same of two colors, cut off at 1.
[[nodiscard]] inline float color_distance(const Lab& p, const Lab& q) noexcept {
  const extend::simd::F32 distances = extend::color_distances(extend::in_all_lanes(p), extend::in_all_lanes(q));
  return extend::simd::largest(extend::simd::min(distances, extend::simd::all(1.0f)));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_COLOR_LAB_HPP
