// shortshot/cloud/intensity_source.hpp: where a descriptor's intensities come from.
#ifndef SHORTSHOT_CLOUD_INTENSITY_SOURCE_HPP
#define SHORTSHOT_CLOUD_INTENSITY_SOURCE_HPP

#include <cstddef>
#include <cstdint>

#include "../base/simd.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "cloud.hpp"
#include "keypoint.hpp"
#include "read.hpp"

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// The intensities of a cloud's own channel, and the key point's: the source of Intensity. A neighbor whose intensity
/// is not finite has none.
struct CloudIntensities {
  static constexpr Channel channel = Channel::intensities;  ///< of the cloud that it reads
  ScalarChannel intensities;                                ///< the cloud's
  float reference;                                          ///< the key point's
  /// What a signal gets that the caller gives no source to. Reads the key point's alone.
  [[nodiscard]] static CloudIntensities at(const CloudView& cloud, const KeyPoint& key) noexcept {
    const bool known = key.has_intensity && extend::math::is_finite(key.intensity);
    return {known ? cloud.intensities : ScalarChannel{}, key.intensity};
  }
  /// ok or missing_intensities.
  [[nodiscard]] Status status() const noexcept {
    return intensities.value != nullptr ? Status::ok : Status::missing_intensities;
  }
  /// One register of intensities by index.
  [[nodiscard]] extend::simd::F32 operator()(const std::uint32_t* index) const noexcept {
    float lanes[extend::simd::lanes];
    for (std::size_t k = 0; k < extend::simd::lanes; ++k) lanes[k] = extend::read(intensities, index[k]);
    return extend::simd::load(lanes);
  }
};

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_CLOUD_INTENSITY_SOURCE_HPP
