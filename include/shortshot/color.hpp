// shortshot/color.hpp: sRGB bytes -> CIELAB, and the colour distance of CSHOT and SCSH.
//
// Both existing codes quantise the CIE ratios to 1/4000 and look their cube root up in a table of 4000 entries; here
// the same quantised ratio goes through a computed root, so that 16 KB of tables are not needed and pure white, which
// reads past the end of both tables, is defined (in PclLab, too: as what PCL was seen to read there). sRGB
// linearisation keeps its 1 KB table, built at compile time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "cloud.hpp"
#include "config.hpp"
#include "math.hpp"
#include "rounded.hpp"
#include "simd.hpp"

namespace shortshot {

/// CIELAB colour: L in 0..100 (-16 for PclLab's white), a and b clamped to -120..120 as both existing codes do.
struct Lab {
  float L, a, b;
};

inline namespace SHORTSHOT_ISA {
namespace detail {

/// n-th root by Newton's iteration, for tables that are built while compiling; never called at run time.
constexpr double nth_root(double value, int n) noexcept {
  double root = 1.0;
  for (int step = 0; step < 100; ++step) {
    double power = 1.0;
    for (int k = 1; k < n; ++k) power *= root;
    const double next = ((n - 1) * root + value / power) / n;
    if (next == root) break;
    root = next;
  }
  return root;
}

/// Natural logarithm of 0.05 <= value <= 1 to 1e-6, likewise only while compiling: ln v = 2 artanh((v - 1) / (v + 1)).
constexpr double log_series(double value) noexcept {
  const double s = (value - 1.0) / (value + 1.0);
  double power = s;
  double sum = 0.0;
  for (int k = 1; k < 120; k += 2) {
    sum += power / k;
    power *= s * s;
  }
  return 2.0 * sum;
}

/// ((c + 0.055) / 1.055)^2.4 with the existing codes' own roundings, because one bit more or less would move some
/// ratios across a step of their tables: the base is a float, and so is the exponent.
constexpr float srgb_power(float c) noexcept {
  const double base = static_cast<double>((c + 0.055f) / 1.055f);
  const double excess = static_cast<double>(2.4f) - 2.4;
  return static_cast<float>(base * base * nth_root(base * base, 5) * (1.0 + excess * log_series(base)));
}

constexpr std::array<float, 256> make_srgb_to_linear() noexcept {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float c = static_cast<float>(i) / 255.0f;
    table[i] = c > 0.04045f ? srgb_power(c) : c / 12.92f;
  }
  return table;
}

inline constexpr std::array<float, 256> srgb_to_linear = make_srgb_to_linear();

}  // namespace detail

/// CIELAB as the published SSH / SCSH code computes it: t^0.3333 above the knee, 7.787 t + 16/116 below.
struct PublishedLab {
  [[nodiscard]] static float root(float t) noexcept {
    if (!(t > 0.008856f)) return rounded(7.787f * t) + 16.0f / 116.0f;
    // t^0.3333 = t^(1/3) exp(-ln t / 30000), and exp(e) = 1 + e + e^2 / 2 for |e| < 2e-4.
    const math::Sum2 cube_root = math::cbrt(t);
    const float e = rounded(math::log(t) * (-1.0f / 30000.0f));
    return cube_root.high + (cube_root.low + rounded((cube_root.high + cube_root.low) * (e + rounded(0.5f * e * e))));
  }
};

/// CIELAB by the formula of PCL's CSHOT: the cube root above the knee, 7.87 t + 16/116 below.
struct CshotLab {
  [[nodiscard]] static float root(float t) noexcept {
    if (!(t > 0.008856f)) return rounded(7.87f * t) + 16.0f / 116.0f;
    const math::Sum2 cube_root = math::cbrt(t);
    return cube_root.high + cube_root.low;
  }
};

/// The same as PCL's compiled code gives it: its table of roots ends before that of 1, where it reads a zero. White,
/// the only colour with such a ratio, becomes L = -16, a = 120, b = -120.
struct PclLab {
  [[nodiscard]] static float root(float t) noexcept { return t < 1.0f ? CshotLab::root(t) : 0.0f; }
};

namespace detail {

/// The CIE ratios X / Xn, Y / Yn and Z / Zn of a colour in whole steps of 1 / 4000: positions in the published tables.
struct RatioSteps {
  int x, y, z;
};

[[nodiscard]] constexpr RatioSteps ratio_steps(Rgb rgb) noexcept {
  const float r = srgb_to_linear[rgb.r];
  const float g = srgb_to_linear[rgb.g];
  const float b = srgb_to_linear[rgb.b];
  const float x = (rounded(r * 0.412453f) + rounded(g * 0.357580f) + rounded(b * 0.180423f)) / 0.95047f;
  const float y = rounded(r * 0.212671f) + rounded(g * 0.715160f) + rounded(b * 0.072169f);
  const float z = (rounded(r * 0.019334f) + rounded(g * 0.119193f) + rounded(b * 0.950227f)) / 1.08883f;
  return {static_cast<int>(x * 4000.0f), static_cast<int>(y * 4000.0f), static_cast<int>(z * 4000.0f)};
}

/// The last step that a colour can have. The ratios grow with each of the three bytes: no colour is beyond white.
inline constexpr int last_ratio_step = 4000;
static_assert(ratio_steps({255, 255, 255}).x <= last_ratio_step && ratio_steps({255, 255, 255}).y <= last_ratio_step &&
                  ratio_steps({255, 255, 255}).z <= last_ratio_step,
              "white has the largest ratios");

/// The root that `Rule` takes of a ratio of `step` / 4000.
template <class Rule>
[[nodiscard]] inline float root_of_step(int step) noexcept {
  return Rule::root(static_cast<float>(step) / 4000.0f);
}

/// CIELAB of a colour; root(step) is the root of a ratio, computed or from a table of them.
template <class Root>
[[nodiscard]] inline Lab lab_by(const Root& root, Rgb rgb) noexcept {
  const RatioSteps steps = ratio_steps(rgb);
  const float fx = root(steps.x);
  const float fy = root(steps.y);
  const float fz = root(steps.z);
  const auto clamped = [](float value) { return value > 120.0f ? 120.0f : value < -120.0f ? -120.0f : value; };
  const float lightness = rounded(116.0f * fy) - 16.0f;
  return {lightness > 100.0f ? 100.0f : lightness, clamped(500.0f * (fx - fy)), clamped(200.0f * (fy - fz))};
}

}  // namespace detail

/// sRGB bytes to CIELAB by `Rule` (PublishedLab, CshotLab or PclLab). Source: what the published SSH / SCSH code and
/// PCL 1.13 compute; within 1e-4 of either in L, a and b. No allocation, reentrant. LabTable (lab_table.hpp) gives the
/// same bits several times faster, for 16 KB.
template <class Rule>
[[nodiscard]] inline Lab to_lab(Rgb rgb) noexcept {
  return detail::lab_by(detail::root_of_step<Rule>, rgb);
}

/// Lanes of CIELAB colours.
struct LabLanes {
  simd::F32 L, a, b;
};

[[nodiscard]] inline LabLanes in_all_lanes(const Lab& color) noexcept {
  return {simd::all(color.L), simd::all(color.a), simd::all(color.b)};
}

/// CSHOT's colour distance in [0, 1]: (|dL| / 100 + (|da| / 120 + |db| / 120) / 2) / 3.
[[nodiscard]] inline simd::F32 color_distances(const LabLanes& p, const LabLanes& q) noexcept {
  using simd::all;
  const simd::F32 chroma = simd::abs(p.a - q.a) + simd::abs(p.b - q.b);
  const simd::F32 distance = simd::abs(p.L - q.L) * all(1.0f / 300.0f) + chroma * all(1.0f / 720.0f);
  return simd::min(distance, all(1.0f));  // 1 for somebody else's NaN, too
}

[[nodiscard]] inline float color_distance(const Lab& p, const Lab& q) noexcept {
  return simd::largest(color_distances(in_all_lanes(p), in_all_lanes(q)));
}

}  // namespace SHORTSHOT_ISA
}  // namespace shortshot
