// shortshot/base/math.hpp: the few functions the kernel needs beyond + - * / sqrt, with the same bits on every machine.
//
// libm's atan2f, acosf, cbrtf and logf differ from one libm to the next; these do not, and they work on lanes.
#ifndef SHORTSHOT_BASE_MATH_HPP
#define SHORTSHOT_BASE_MATH_HPP

#include <cstdint>
#include <cstring>

#include "simd.hpp"
#include "unfused.hpp"
#include "unroll.hpp"

namespace shortshot::extend::math {
inline namespace SHORTSHOT_CODE {

/// A number's bits, and the number that has these bits.
[[nodiscard]] inline std::uint32_t bits_of(float value) noexcept {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
[[nodiscard]] inline float float_of(std::uint32_t bits) noexcept {
  float value = 0.0f;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// True for finite numbers, by the exponent bits: holds under -ffast-math too, where comparisons with NaN do not.
[[nodiscard]] inline bool is_finite(float value) noexcept { return (bits_of(value) & 0x7F800000u) != 0x7F800000u; }

[[nodiscard]] inline bool is_finite(const float (&v)[3]) noexcept {
  for (const float component : v) {
    if (!is_finite(component)) return false;
  }
  return true;
}

/// The least number with all of a float's bits, 2^-126.
inline constexpr float least_normal = 1.17549435e-38f;

/// The angle of (far, near), both >= 0, in turns and less a quarter turn: -1/4 to 0, within 6e-8. A minimax fit with
/// both ends exact, because points on axes and diagonals lie on the borders of cells. Of (0, 0), or of what is not
/// finite: -1/4.
[[nodiscard]] inline simd::F32 angle_below_quarter(simd::F32 far, simd::F32 near) noexcept {
  using simd::all;
  constexpr float fit[] = {0.00106037291698158f, -0.00527749117463827f, 0.0125921480357647f, -0.0210182461887598f,
                           0.0315139554440975f,  -0.0530250333249569f,  0.159154295921326f};
  // The tangent of the angle minus an eighth of a turn; -1 of (0, 0), and nobody divides by zero.
  const simd::F32 f = simd::max(far, all(least_normal));
  const simd::F32 t = (near - f) / (near + f);
  const simd::F32 s = t * t;
  simd::F32 p = all(fit[0]);
  detail::each<6>([&](auto k) SHORTSHOT_INLINE_LAMBDA { p = p * s + all(fit[k + 1]); });
  return p * t - all(0.125f);
}

/// The angle from the z axis, 0 at z > 0 to 1 at z < 0 (theta / pi); rho >= 0 is the distance from the axis.
[[nodiscard]] inline simd::F32 elevation(simd::F32 rho, simd::F32 z) noexcept {
  const simd::F32 before_equator = angle_below_quarter(simd::abs(z), rho);
  return simd::all(0.5f) + simd::flip_sign(before_equator + before_equator, z);
}

/// (atan2(y, x) + pi) / 2 pi in [0, 1]: 1 for y = 0, x < 0.
[[nodiscard]] inline simd::F32 azimuth(simd::F32 x, simd::F32 y) noexcept {
  using simd::all;
  const simd::F32 before_quarter = angle_below_quarter(simd::abs(x), simd::abs(y));
  const simd::F32 half = all(0.25f) + simd::negate(x < all(0.0f), before_quarter);  // 0 to 1/2
  return all(0.5f) + simd::negate(y < all(0.0f), half);
}

/// Natural logarithm of a positive normal number, absolute error below 2e-7 near 1, relative below 2e-7 elsewhere.
[[nodiscard]] inline float log(float value) noexcept {
  const std::uint32_t bits = bits_of(value);
  // Exponent such that the mantissa m lies in [sqrt(1/2), sqrt(2)): the series below is symmetric about 1.
  const std::int32_t exponent = static_cast<std::int32_t>((bits + 0x004AFB0Du) >> 23) - 127;
  const float m = float_of(bits - (static_cast<std::uint32_t>(exponent) << 23));
  const float s = (m - 1.0f) / (m + 1.0f);  // ln m = 2 artanh s, |s| < 0.172
  const float s2 = s * s;
  const float artanh =
      s + unfused(s * s2 *
                  (0.333333333f + unfused(s2 * (0.2f + unfused(s2 * (0.142857143f + unfused(s2 * 0.111111111f)))))));
  return unfused(static_cast<float>(exponent) * 0.693147181f) + unfused(2.0f * artanh);
}

/// The largest power of two not above a positive normal number.
[[nodiscard]] inline float power_of_two_below(float value) noexcept { return float_of(bits_of(value) & 0x7F800000u); }

/// The nearest multiple of a quantum, of a number not above R for a splitter of 12288 R: products of two such numbers,
/// and sums of three products, are exact.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 coarse(simd::F32 value, float splitter) noexcept {
  return (value + simd::all(splitter)) - simd::all(splitter);
}

/// How much longer a vector is than `length`, which is about as long as it and given as the sum of a coarse() number
/// and a small rest: to some bits more than a float of the length itself has. Squares of coarse parts cancel exactly.
[[nodiscard]] SHORTSHOT_INLINE simd::F32 length_beyond(simd::F32 x, simd::F32 y, simd::F32 z, simd::F32 coarse_length,
                                                       simd::F32 rest, float splitter) noexcept {
  using simd::F32;
  const F32 of[3] = {x, y, z};
  F32 exact = simd::all(0.0f) - coarse_length * coarse_length;
  F32 small = simd::all(0.0f) - rest * (coarse_length + coarse_length + rest);
  detail::each<3>([&](auto k) SHORTSHOT_INLINE_LAMBDA {
    const F32 part = coarse(of[k], splitter);
    exact = exact + part * part;
    small = small + (of[k] - part) * (of[k] + part);
  });
  return (exact + small) / (coarse_length + coarse_length);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend::math

#endif  // SHORTSHOT_BASE_MATH_HPP
