// shortshot/color/color_source.hpp: where a descriptor's colors come from: the cloud's bytes, or an array converted
// before.
#ifndef SHORTSHOT_COLOR_COLOR_SOURCE_HPP
#define SHORTSHOT_COLOR_COLOR_SOURCE_HPP

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "../base/simd.hpp"
#include "../cloud/cloud.hpp"
#include "../cloud/keypoint.hpp"
#include "../cloud/read.hpp"
#include "../config.hpp"
#include "../status.hpp"
#include "lab.hpp"
#include "packed_lab.hpp"

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Where a source names the rule it converts by, is it this one?
template <class Rule, class Source>
constexpr bool has_rule(const typename Source::Rule*) noexcept {
  return std::is_same<typename Source::Rule, Rule>::value;
}
template <class Rule, class Source>
constexpr bool has_rule(...) noexcept {
  return true;
}

/// A key point where colors are compared with their mean: nobody asks for its own, which may be missing.
struct KeyWithoutColor : KeyPoint {
  explicit KeyWithoutColor(const KeyPoint& key) noexcept : KeyPoint(key) {}
};
template <class Rule>
[[nodiscard]] inline Lab reference_at(const KeyPoint& key) noexcept {
  return to_lab<Rule>(key.color);
}
template <class Rule>
[[nodiscard]] inline Lab reference_at(const KeyWithoutColor&) noexcept {
  return {0.0f, 0.0f, 0.0f};
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Colors of a cloud's points by index, and the key point's own: what a ColorDistance compares. This source converts
/// every neighbor's bytes when it is asked: no memory per point.
template <class LabRule>
struct RgbColors {
  static constexpr Channel channel = Channel::colors;  ///< of the cloud that it reads
  using Rule = LabRule;                                ///< by which it converts
  ColorChannel bytes;                                  ///< the cloud's
  Lab reference;                                       ///< the key point's
  /// Compares with `color`; a channel that is not there is missing_colors.
  RgbColors(const CloudView& cloud, const Rgb& color) noexcept : bytes(cloud.colors) {
    detail::put_lab<LabRule>(color, reference);
  }
  /// Compares with a reference that the kernel sets: for signals of the MeanColor.
  explicit RgbColors(const CloudView& cloud) noexcept : bytes(cloud.colors), reference{0.0f, 0.0f, 0.0f} {}
  /// ok or missing_colors.
  [[nodiscard]] Status status() const noexcept { return bytes.r != nullptr ? Status::ok : Status::missing_colors; }
  /// The color of point `index`, converted.
  [[nodiscard]] Lab operator()(std::uint32_t index) const noexcept {
    return to_lab<LabRule>(extend::read(bytes, index));
  }

  /// What a signal gets that the caller gives no source to.
  [[nodiscard]] static RgbColors at(const CloudView& cloud, const KeyPoint& key) noexcept {
    RgbColors colors(cloud, key.color);
    if (!key.has_color) colors.bytes.r = nullptr;
    return colors;
  }
  [[nodiscard]] static RgbColors at(const CloudView& cloud, const detail::KeyWithoutColor&) noexcept {
    return RgbColors(cloud);
  }
  /// May a source stand in for this one? StoredColors and whatever else gives a Lab by index may; if it says by which
  /// rule its colors were converted, it must be this one.
  template <class Source>
  [[nodiscard]] static constexpr bool accepts() noexcept {
    constexpr bool gives_colors = std::is_invocable_r<Lab, const Source&, std::uint32_t>::value;
    static_assert(!gives_colors || detail::has_rule<LabRule, Source>(nullptr),
                  "describe() supports colors converted by D's own rule");
    return gives_colors;
  }
};

/// The same from an array that holds each point's color, converted once for the whole cloud by convert_colors().
template <class Color>
struct StoredColors {
  const Color* lab;  ///< one per point of the cloud, borrowed
  Lab reference;     ///< the key point's
  /// ok or missing_colors.
  [[nodiscard]] Status status() const noexcept { return lab != nullptr ? Status::ok : Status::missing_colors; }
  /// The color of point `index`.
  [[nodiscard]] Lab operator()(std::uint32_t index) const noexcept { return lab[index]; }
};

using LabColors = StoredColors<Lab>;           ///< 12 bytes a point
using PackedColors = StoredColors<PackedLab>;  ///< 4 bytes a point; for its error see PackedLab

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

namespace shortshot::extend {
inline namespace SHORTSHOT_CODE {

/// One register of colors by index.
template <class Colors>
[[nodiscard]] SHORTSHOT_INLINE LabLanes colors_at(const Colors& colors, const std::uint32_t* index) noexcept {
  if constexpr (simd::lanes == 1) return in_all_lanes(colors(*index));
  float lanes[3][simd::lanes];
  for (std::size_t k = 0; k < simd::lanes; ++k) {
    const Lab color = colors(index[k]);
    lanes[0][k] = color.L;
    lanes[1][k] = color.a;
    lanes[2][k] = color.b;
  }
  return {simd::load(lanes[0]), simd::load(lanes[1]), simd::load(lanes[2])};
}

[[nodiscard]] SHORTSHOT_INLINE LabLanes colors_at(const LabColors& colors, const std::uint32_t* index) noexcept {
  LabLanes lab;
  simd::load_triples(&colors.lab->L, index, lab.L, lab.a, lab.b);
  return lab;
}

[[nodiscard]] SHORTSHOT_INLINE LabLanes colors_at(const PackedColors& colors, const std::uint32_t* index) noexcept {
  return PackedLab::at(colors.lab, index);
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::extend

namespace shortshot::detail {
inline namespace SHORTSHOT_CODE {

/// Colors [begin, end) of a cloud, each converted by convert(rgb).
template <class Convert, class Color>
inline void convert_range(const CloudView& cloud, std::size_t begin, std::size_t end, const Convert& convert,
                          Color* lab) noexcept {
  for (std::size_t i = begin; i < end; ++i) lab[i] = convert(color(cloud, i));
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot::detail

namespace shortshot {
inline namespace SHORTSHOT_CODE {

/// Convert all colors of a cloud into `lab`: cloud.size elements of the caller's, each a Lab or a PackedLab. Statuses:
/// empty_cloud, bad_view, missing_colors. No allocation.
template <class LabRule, class Color>
[[nodiscard]] inline Status convert_colors(const CloudView& cloud, Color* lab) noexcept {
  const Status usable = validate(cloud);
  if (usable != Status::ok) return usable;
  if (!has_colors(cloud)) return Status::missing_colors;
  detail::convert_range(cloud, 0, cloud.size, to_lab<LabRule>, lab);
  return Status::ok;
}

}  // namespace SHORTSHOT_CODE
}  // namespace shortshot

#endif  // SHORTSHOT_COLOR_COLOR_SOURCE_HPP
