// shortshot/descriptor/finish_rules.hpp: how the sums of a part's cells become its values, and what the part weighs
// beside the others. The whole descriptor has length 1 afterwards.
#ifndef SHORTSHOT_DESCRIPTOR_FINISH_RULES_HPP
#define SHORTSHOT_DESCRIPTOR_FINISH_RULES_HPP

#include "../base/simd.hpp"
#include "../config.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

[[nodiscard]] inline float root(float value) noexcept { return extend::simd::sqrt(value); }
[[nodiscard]] inline float positive(float value) noexcept { return value > 0.0f ? value : 0.0f; }
[[nodiscard]] inline float magnitude(float value) noexcept { return value < 0.0f ? -value : value; }

/// `values` holds sums of votes, which some rules make negative here and there: these count as 0.
inline void roots_of_shares(float* values, int size, float length) noexcept {
  float sum = 0.0f;
  for (int i = 0; i < size; ++i) sum += positive(values[i]);
  if (!(sum > 0.0f)) return;
  const float weight = length / root(sum);
  for (int i = 0; i < size; ++i) values[i] = weight * root(positive(values[i]));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_TYPES {

/// Sums as they are: parts weigh what votes they have. The published family's.
struct PlainSums {
  static constexpr const char* name = "";  ///< for layout_of()
};

/// Square roots of the shares of a part's votes: its length is the weight, `PerMille` / 1000, whatever it counts. Roots
/// keep a few crowded cells from deciding every distance (for histograms the L2 distance is then Hellinger's).
template <int PerMille = 1000>
struct RootOfShares {
  static_assert(PerMille >= 1 && PerMille <= 100000, "RootOfShares<PerMille> supports weights from 1 / 1000 to 100");
  static constexpr const char* name = "root of shares";
  static constexpr int per_mille = PerMille;  ///< the part's weight, times 1000

  /// Finishes the `size` values of a part, in place.
  static void apply(float* values, int size) noexcept {
    detail::roots_of_shares(values, size, static_cast<float>(PerMille) / 1000.0f);
  }
};

/// Square roots of signed values, their signs kept, over the root of (floor + sum of magnitudes): where there is little
/// to see, the part shrinks. A root is infinitely steep at 0, where it makes much of noise; so it is taken of more than
/// the value and begins at 0 all the same: sqrt(|v| + noise) - sqrt(noise). The part is never longer than its weight,
/// `PerMille` / 1000; the floor is `FloorPercent` / 100, the noise `NoisePerMille` / 1000.
template <int PerMille, int FloorPercent, int NoisePerMille = 0>
struct SignedRoots {
  static_assert(PerMille >= 1 && PerMille <= 100000,
                "SignedRoots<PerMille, Floor, Noise> supports weights from 1 / 1000 to 100");
  static_assert(FloorPercent >= 1, "SignedRoots<PerMille, Floor, Noise> supports floors of 1 percent or more");
  static_assert(NoisePerMille >= 0 && NoisePerMille <= 1000,
                "SignedRoots<PerMille, Floor, Noise> supports noise from 0 to 1");
  static constexpr const char* name = "signed roots";
  static constexpr int per_mille = PerMille;
  static constexpr int floor_percent = FloorPercent;     ///< times 100
  static constexpr int noise_per_mille = NoisePerMille;  ///< times 1000

  static void apply(float* values, int size) noexcept {
    constexpr float noise = static_cast<float>(NoisePerMille) / 1000.0f;
    float sum = static_cast<float>(FloorPercent) / 100.0f;
    for (int i = 0; i < size; ++i) sum += detail::magnitude(values[i]);
    const float weight = static_cast<float>(PerMille) / 1000.0f / detail::root(sum);
    const float start = detail::root(noise);
    for (int i = 0; i < size; ++i) {
      const float long_one = weight * (detail::root(detail::magnitude(values[i]) + noise) - start);
      values[i] = values[i] < 0.0f ? -long_one : long_one;
    }
  }
};

}  // namespace SHORTSHOT_TYPES
}  // namespace shortshot

#endif  // SHORTSHOT_DESCRIPTOR_FINISH_RULES_HPP
