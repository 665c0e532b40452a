// shortshot/color/srgb.hpp: sRGB's gamma undone, by a table of 1 KB or, where code shall be small, without: the same
// bits.
#ifndef SHORTSHOT_COLOR_SRGB_HPP
#define SHORTSHOT_COLOR_SRGB_HPP

#include <array>
#include <cstddef>
#include <cstdint>

#include "../base/math.hpp"
#include "../base/simd.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"
#include "fixed_power.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

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

/// A power of 2.4 with the existing codes' own roundings, because one bit more or less would move some ratios across a
/// step of their tables: the base is a float, and so is the exponent.
constexpr float srgb_power(float number) noexcept {
  const double base = static_cast<double>(number);
  const double excess = static_cast<double>(2.4f) - 2.4;
  return static_cast<float>(base * base * nth_root(base * base, 5) * (1.0 + excess * log_series(base)));
}

constexpr std::array<float, 256> make_srgb_to_linear() noexcept {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float c = static_cast<float>(i) / 255.0f;
    table[i] = c > 0.04045f ? srgb_power((c + 0.055f) / 1.055f) : c / 12.92f;
  }
  return table;
}

inline constexpr std::array<float, 256> srgb_to_linear = make_srgb_to_linear();

inline constexpr FixedPower srgb_root{
    {1717987336, -515393476, 275016773, -175895406, 155978275, 49167834, 531163086, 686271253, 616103588, 0},
    {406871906u, 536870735u, 708405228u, 934746364u, 1233405304u, 1627488163u, 2147483648u, 2833621849u}};

/// The same power of a number from 1/16 to 1 without double: the square of its mantissa times srgb_root of it, whose p
/// is 2.4 - 2. Of all 245 numbers that the gamma has, each has the table's bits.
[[nodiscard]] inline float small_srgb_power(float base) noexcept {
  const std::uint32_t bits = math::bits_of(base);
  const std::uint32_t mantissa = bits << 8 | 0x80000000u;
  const auto square = static_cast<std::uint32_t>((std::uint64_t{mantissa} * mantissa) >> 32);
  const std::uint64_t product = std::uint64_t{srgb_root.fixed(bits)} * square;  // in units of 2^-63
  const auto high = static_cast<std::uint32_t>(product >> 32);
  const int zeros = __builtin_clz(high);  // 1 to 4
  const auto digits = static_cast<float>(high << zeros | static_cast<std::uint32_t>(product) >> (32 - zeros));
  // Times 2^(2 e - zeros - 31), where base is less than 2^e.
  const int exponent = 2 * (static_cast<int>(bits >> 23) - 126) - zeros - 31;
  return unfused(digits * math::float_of(static_cast<std::uint32_t>(exponent + 127) << 23));
}

/// A byte without sRGB's gamma, 0 to 1.
[[nodiscard]] constexpr float linear_of_srgb(std::uint8_t byte) noexcept {
  if (!small_code || simd::lanes > 1 || __builtin_is_constant_evaluated()) return srgb_to_linear[byte];
  const float c = static_cast<float>(byte) / 255.0f;
  return c > 0.04045f ? small_srgb_power((c + 0.055f) / 1.055f) : c / 12.92f;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_COLOR_SRGB_HPP
