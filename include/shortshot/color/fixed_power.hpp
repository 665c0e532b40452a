// shortshot/color/fixed_power.hpp: the roots of CIELAB, in integers: half the instructions of a float version that is
// as good, a fortieth where there is no FPU, and nothing that could round differently elsewhere.
#ifndef SHORTSHOT_COLOR_FIXED_POWER_HPP
#define SHORTSHOT_COLOR_FIXED_POWER_HPP

#include <cstdint>

#include "../base/fixed_point.hpp"
#include "../base/math.hpp"
#include "../base/unfused.hpp"
#include "../base/unroll.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// t^p of a fixed p below 1/2, for t from 2^-7 up to 2. With t = m 2^e, m from 1/2 to 1, and z = m - 1:
/// t^p = (1 + z (c0 + z (c1 + ... + z c9))) 2^(e p).
struct FixedPower {
  std::int32_t fit[10];     ///< c0 to c9 in units of 2^-32: ((1 + z)^p - 1) / z at Chebyshev nodes
  std::uint32_t octave[8];  ///< 2^(e p) in units of 2^-31, from e = -6 on

  /// In units of 2^-31, of the float that has these bits.
  [[nodiscard]] std::uint32_t fixed(std::uint32_t bits) const noexcept {
    const auto z = static_cast<std::int32_t>(bits << 8 | 0x80000000u);  // in units of 2^-32
    std::int32_t sum = fit[9];
    each<9>([&](auto k) SHORTSHOT_INLINE_LAMBDA { sum = add_high_product(fit[8 - k], sum, z); });
    const auto power =
        static_cast<std::uint32_t>(add_high_product(1, sum, z));  // modulo 1; rounded up, as the rest is down
    return static_cast<std::uint32_t>((std::uint64_t{power} * octave[(bits >> 23) - 120u]) >> 32);
  }

  /// Within 2e-9 before it is rounded to float, once: of the 3965 numbers k / 4000 that CIELAB asks for, all but 18 are
  /// the float that is closest, and those are the next one.
  [[nodiscard]] float operator()(float t) const noexcept {
    return unfused(static_cast<float>(fixed(math::bits_of(t))) * (1.0f / 2147483648.0f));
  }
};

inline constexpr FixedPower cube_root{
    {1431655764, -477219117, 265086957, -177611235, 118766867, -177798683, -243108994, -883031911, -1088405058,
     -784821837},
    {536870912u, 676414963u, 852229450u, 1073741824u, 1352829926u, 1704458901u, 2147483648u, 2705659852u}};

/// t^0.3333, as the published SSH / SCSH code has it.
inline constexpr FixedPower published_root{
    {1431512598, -477195254, 265079000, -177608167, 118765444, -177800906, -243118475, -883057088, -1088438257,
     -784843915},
    {536945343u, 676493110u, 852308217u, 1073816253u, 1352892442u, 1704498283u, 2147483648u, 2705597339u}};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

#endif  // SHORTSHOT_COLOR_FIXED_POWER_HPP
